"""Every number that the explorer's scripts compute, entry by entry against the package's.

u = 2⁻⁵³ bounds one rounding, relatively. Sines and cosines are off by at most 5 u, since their
angle is rounded twice. A is the exact product of such floats, rounded once, and so are C, det A,
A⁻¹ and A⁻ᵀ: they have to be equal, and so have fractions. Against the package's own sines A is off
by at most 16 u times the sum of the sizes that meet in an entry: 5 u a turn, and its rounding.
Unit rows of cameras are a division by a root of squares: 8 u of the entry itself.
"""

from __future__ import annotations

import json
import random
from dataclasses import replace
from fractions import Fraction
from math import degrees, inf, isfinite, nextafter

import pytest
from browser.inside import inside

from nmatrix.enums import DepthRange, Frame, Handedness, NormalRule, Space
from nmatrix.errors import IllegalValueError
from nmatrix.linear.angle import Angle, exact_angle_between
from nmatrix.linear.classify import classify
from nmatrix.linear.exact import LinearMap
from nmatrix.linear.projection import ClipSpace, Window
from nmatrix.linear.rational import apply, linear_part, rational_matrix, transpose
from nmatrix.linear.rounding import integers, nearest
from nmatrix.linear.rules import RULES
from nmatrix.linear.view import look_at
from nmatrix.linear.viewport import window_from_ndc
from nmatrix.output.explorer.page import OTHER_SPACE, WINDOW, module, page_data
from nmatrix.scene.camera import View
from nmatrix.scene.lens import Lens
from nmatrix.scene.setup import Light, Setup
from nmatrix.scene.world import World
from nmatrix.spaces.transform import Transform

pytestmark = pytest.mark.slow  # a browser draws by software

U = Fraction(1, 2**53)
TINY = Fraction(1, 2**1060)  # below it floats have fewer digits
AXES, SHEARS = "xyz", ("xy", "xz", "yz")
STRETCH = World(scale=(1, 2, 1))
SETUPS = {
    "perspective": Setup(STRETCH, View(eye=(1.5, 1.75, 3.25)), light=Light((-1, -2, -1))),
    "reversed, from below": Setup(
        STRETCH,
        View(eye=(0.1, -6.3, 0.2), target=(0.1, 0.7, 0.2)),
        Lens(far=inf, clip=ClipSpace(depth=DepthRange.REVERSED)),
        Light(position=(2, 2.1, -3)),
    ),
    "orthographic, left-handed": Setup(
        STRETCH,
        View(eye=(2, 1, -7), handed=Handedness.LEFT),
        Lens(ortho=Window(-3, 3, -2, 2), near=1, clip=ClipSpace(handed=Handedness.LEFT)),
        Light((0, -3, 0)),
    ),
}
HOSTILE = {
    "a mirror": {"sx": 1, "mx": 1},
    "rank 2": {"sx": 1, "sy": 0, "sz": 3, "hxy": 0.3, "rx": 33},
    "rank 1": {"sx": 0, "sy": 0, "sz": 3},
    "rank 0": {"sx": 0, "sy": 0, "sz": 0},
    "1e-150": {f"s{a}": 1e-150 for a in AXES},
    "1e-150, mirrored and turned": {f"s{a}": 1e-150 for a in AXES} | {"mz": 1, "ry": 12},
    "1e150": {f"s{a}": 1e150 for a in AXES} | {"hxz": 0.1, "rz": -77},
    "1e150 beside 1e-150": {"sx": 1e150, "sy": 1e-150, "sz": 1e-150, "mx": 1},
    "nearly flat": {"sy": 1e-16, "hxy": 1, "rx": 45, "rz": 30},
    "a shear without measure": {"hxy": 1e12, "hyz": -1e12},
    "a long way off": {"tx": 1e15, "ty": -1e-15, "tz": 7, "ry": 20},
    "nearly a quarter turn": {"rz": nextafter(90, 0), "hxy": 1},
    "beyond a turn": {"rx": 810, "ry": -1170, "rz": 360},
    "many turns": {"rx": 123456.7, "ry": -98765.4, "rz": 1e-7},
}


def states() -> list[dict]:
    draw = random.Random(19)
    usual = {f"{letter}{a}": 0 for letter in "mrt" for a in AXES}
    usual |= {f"s{a}": 1 for a in AXES} | {f"h{pair}": 0 for pair in SHEARS}
    found = [usual | one for one in HOSTILE.values()]
    scales = [0.05, 0.1, 0.3, 1, 1.15, 2, 3.7, 4, 1e-9, 1e9]
    for index in range(240):
        one = {f"s{a}": draw.choice(scales) for a in AXES}
        one |= {f"m{a}": int(draw.random() < 0.3) for a in AXES}
        turns = [0, 90, -90, 180, 270, -360, 450] if index % 3 else [30, -71.5, 1e-4, 179, -135.3]
        one |= {f"r{a}": draw.choice(turns) for a in AXES}
        one |= {f"h{pair}": draw.choice([0, 0, 0.5, -1.25, 0.1, 1e-3]) for pair in SHEARS}
        one |= {f"t{a}": draw.choice([0, 0, 0.1, -2.5]) for a in AXES}
        if draw.random() < 0.1:
            one[f"s{draw.choice(AXES)}"] = 0
        found.append(usual | one)
    return found


STATES = states()
RULE_NAMES = ["none", "cofactor", "not-inverted", "not-transposed", "exact"]
ASK = """states => states.map((given, i) => {
  const s = { ...START, ...given, shape: i % 4 ? "R" : "egg" };
  const found = { ...meaning(s, 1) }, exact = exactLinear(s);
  found.clip_from_world = times(data.clip_from_camera, found.camera);
  const text = (A) => A && A.map((row) => row.map((x) => `${x.top}/${x.bottom}`));
  return {
    turns: AXES.map((axis) => turn(s[`r${axis}`])),
    back: inverse3(linear(found.M)), M: found.M, C: found.C, det: found.det, N: found.N,
    right: found.right, rank: found.rank, sign: found.sign,
    camera: found.camera, eye: found.eye, light: found.light, lamp: found.lamp,
    inverse: found.isFlat ? null : inverse4(found.M, found.whole), largest: found.largest,
    clip_from_world: found.clip_from_world,
    rules: Object.fromEntries(RULES.map((r) => [r, ruleMatrix(r, found.whole, found.isFlat)])),
    worst: Object.fromEntries(RULES.map((r) => {
      const W = found.rank < 2 || !(i % 4) ? null : ruleMatrix(r, found.whole, found.isFlat);
      return [r, W && worstAngle(W, found.right, found.mesh.directions, false, found.isFlat)];
    })),
    spaces: Object.fromEntries(Object.keys(data.shaders).map((x) => [x, spaceFromWorld(x, found)])),
    way: [0, 0.37, 1].map((v) => journey({ ...s, v }, found).map(([key, , at]) => [key, at])),
    fractions: exact && Object.fromEntries(RULES.map((r) => [r, text(exactRule(r, exact))])),
    determinant: exact && text([[exactDeterminant(exact)]])[0][0],
  };
})""".replace("RULES", json.dumps(RULE_NAMES))


@pytest.fixture(scope="module")
def mounted(browser, tmp_path_factory):
    """One page with an explorer of each setup."""
    path = tmp_path_factory.mktemp("module") / "several.html"
    given = {
        name: page_data(replace(one, space_matrix=OTHER_SPACE)) for name, one in SETUPS.items()
    }
    text = json.dumps(given, ensure_ascii=False).replace("<", "\\u003c")
    path.write_text(
        f"""<!doctype html><meta charset="utf-8"><script type="module">{module()}
        const keeper = (house) => ({{ house, read: () => ({{}}), write() {{}}, listen() {{}} }});
        for (const [name, data] of Object.entries({text})) {{
          const place = document.body.appendChild(document.createElement("div"));
          place.id = name; mount(place, data, keeper(place));
        }}</script>""",
        encoding="utf-8",
    )
    page = browser.new_page()
    page.goto(f"file://{path}")
    page.wait_for_function(
        "document.body.children.length === 3 && document.body.lastElementChild.explorer"
    )
    yield page
    page.close()


@pytest.fixture(scope="module")
def told(mounted) -> dict[str, list[dict]]:
    """What the scripts compute of every state, in one evaluation for each setup."""
    return {
        name: floats(
            mounted.evaluate(inside(ASK, f"document.getElementById({name!r}).explorer"), of(name))
        )
        for name in SETUPS
    }


def floats(told):
    """A whole number comes as the digits that tell a float, which are not the float."""
    if isinstance(told, dict):
        return {key: floats(one) for key, one in told.items()}
    if isinstance(told, list):
        return [floats(one) for one in told]
    return float(told) if isinstance(told, int) and not isinstance(told, bool) else told


def scale_of(one: dict) -> tuple:
    return tuple(one[f"s{a}"] * (-1 if one[f"m{a}"] else 1) for a in AXES)


def parts_of(one: dict) -> dict:
    return {
        "rotate_degrees": tuple(one[f"r{a}"] for a in AXES),
        "scale": scale_of(one),
        "shear": tuple(one[f"h{pair}"] for pair in SHEARS),
        "translate": tuple(one[f"t{a}"] for a in AXES),
    }


def of(name: str) -> list[dict]:
    """The states that are asked for: all in one setup, a third in each of the others."""
    return STATES if name == "perspective" else STATES[: len(STATES) // 3]


def pairs(told: dict, name: str = "perspective"):
    return zip(of(name), told[name], strict=True)


def rounded(value: Fraction) -> float:
    try:
        return nearest(value)
    except IllegalValueError:
        return inf if value > 0 else -inf


def rounded_all(matrix) -> list[list[float]]:
    return [[rounded(Fraction(x)) for x in row] for row in matrix]


def exactly(one: dict, numbers: dict) -> LinearMap:
    """Multiply the floats that the scripts make A of: Rx Ry Rz S H."""
    (sx, cx), (sy, cy), (sz, cz) = numbers["turns"]
    x, y, z = scale_of(one)
    found = fractions([[1, 0, 0], [0, cx, -sx], [0, sx, cx]])
    for factor in (
        [[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]],
        [[cz, -sz, 0], [sz, cz, 0], [0, 0, 1]],
        [[x, 0, 0], [0, y, 0], [0, 0, z]],
        [[1, one["hxy"], one["hxz"]], [0, 1, one["hyz"]], [0, 0, 1]],
    ):
        found = product(found, fractions(factor))
    return LinearMap.of(found)


def placed(one: dict, exact: LinearMap) -> list[list[Fraction]]:
    """M, exactly: A with the translation beside it."""
    rows = [[Fraction(x, exact.denominator) for x in row] for row in exact.entries]
    place = map(Fraction, parts_of(one)["translate"])
    return [[*row, t] for row, t in zip(rows, place, strict=True)] + [fractions([[0, 0, 0, 1]])[0]]


def fractions(matrix) -> list[list[Fraction]]:
    return [[Fraction(x) for x in row] for row in matrix]


def absolute(matrix) -> list[list[Fraction]]:
    return [[abs(Fraction(x)) for x in row] for row in matrix]


def product(A, B) -> list[list[Fraction]]:
    return [
        [sum(x * y for x, y in zip(row, column, strict=True)) for column in zip(*B, strict=True)]
        for row in A
    ]


def sizes_that_meet(one: dict) -> list[list[Fraction]]:
    """|Rx| |Ry| |Rz| |S| |H|: what the entries of A would be if nothing cancelled."""
    found = None
    for axis in AXES:
        alone = World(rotate_degrees=tuple(one[f"r{axis}"] if a == axis else 0 for a in AXES))
        turned = absolute(linear_part(alone.exact))
        found = turned if found is None else product(found, turned)
    for name in ("scale", "shear"):
        found = product(found, absolute(linear_part(World(**{name: parts_of(one)[name]}).exact)))
    return found


def test_the_world_matrix_is_the_packages(told) -> None:
    for one, numbers in pairs(told):
        exact, sizes = World(**parts_of(one)).exact, sizes_that_meet(one)
        assert numbers["M"] == rounded_all(placed(one, exactly(one, numbers))), one
        for axis, found in zip(AXES, numbers["turns"], strict=True):
            angle = Angle.degrees(one[f"r{axis}"])
            for x, true in zip(found, (angle.sine, angle.cosine), strict=True):
                assert abs(Fraction(x) - true) <= 5 * U * abs(true), (one, axis)
        quarters = all(one[f"r{a}"] % 90 == 0 for a in AXES)
        for i in range(3):
            for j in range(3):
                off = abs(Fraction(numbers["M"][i][j]) - exact[i][j])
                bound = U * abs(exact[i][j]) if quarters else 16 * U * sizes[i][j]
                assert off <= bound + TINY, (one, i, j)


def test_cofactors_determinants_and_inverses_are_rounded_once(told) -> None:
    for one, numbers in pairs(told):
        exact = exactly(one, numbers)
        assert numbers["C"] == rounded_all(exact.cofactor_matrix), one
        rank = sum(x != 0 for x in scale_of(one))
        assert numbers["rank"] == rank
        assert (numbers["N"] is None) == (numbers["inverse"] is None) == (rank < 3)
        if rank == 3:
            assert numbers["det"] == rounded(exact.determinant), one
            assert numbers["sign"] == exact.determinant_sign, one
            assert numbers["N"] == rounded_all(exact.inverse_transpose), one
            back = transpose(exact.inverse_transpose)
            moved = apply(back, [-Fraction(x) for x in parts_of(one)["translate"]])
            whole = [[*row, x] for row, x in zip(back, moved, strict=True)]
            assert numbers["inverse"][:3] == rounded_all(whole), one


HALFWAY = [
    (2**53 + 1, 1),
    (2**53 + 3, 1),
    (-(2**54) - 2, 2),
    (3, 2**1075),
    (1, 2**1075),
    (5, 2**1075),
    (2**1024 - 2**970, 1),
    (2**1024 - 2**970 - 1, 1),
    (1, 3),
    (10**400, 10**401 + 7),
    (-(2**60) - 129, 2**1100),
    (0, 7),
]


def test_a_fraction_halfway_between_two_floats_goes_to_the_even_one(mounted) -> None:
    script = inside(
        "all => all.map(([a, b]) => nearest(BigInt(a), BigInt(b)))",
        "document.getElementById('perspective').explorer",
    )
    found = floats(mounted.evaluate(script, [[str(a), str(b)] for a, b in HALFWAY]))
    assert found == [rounded(Fraction(a, b)) for a, b in HALFWAY]


def test_the_inverse_of_floats_is_rounded_once(told) -> None:
    for one, numbers in pairs(told):
        A = LinearMap.of([row[:3] for row in numbers["M"][:3]])
        if A.rank == 3:
            assert numbers["back"] == rounded_all(transpose(A.inverse_transpose)), one


def test_every_rule_makes_the_packages_normal_matrix(told) -> None:
    for one, numbers in pairs(told):
        exact = exactly(one, numbers)
        M = tuple(map(tuple, placed(one, exact)))
        for name, found in numbers["rules"].items():
            if numbers["rank"] < 3 and name == "not-transposed":
                assert found is None
            elif name == "exact":
                N = exact.inverse_transpose if numbers["rank"] == 3 else exact.cofactor_matrix
                assert found == rounded_all(N), one
            else:
                theirs = RULES[NormalRule(name)].transform(M).matrix
                assert found == rounded_all(linear_part(theirs)), (one, name)


def test_the_right_directions_are_the_cofactors_with_the_sign(told) -> None:
    for one, numbers in pairs(told):
        exact = exactly(one, numbers)
        signed = [[int(numbers["sign"]) * x for x in row] for row in exact.cofactors]
        largest = max(abs(x) for row in signed for x in row)
        near = Fraction(1, 2 ** largest.bit_length()) if largest else Fraction(1)
        assert numbers["right"] == rounded_all([[x * near for x in row] for row in signed]), one
        if numbers["rank"] == 3:
            assert numbers["sign"] == (-1 if sum(one[f"m{a}"] for a in AXES) % 2 else 1), one


def decimal(value: float) -> Fraction:
    return Fraction(repr(value))


def test_fractions_are_the_packages_for_the_decimals_that_stand_there(told) -> None:
    counted = 0
    for one, numbers in pairs(told):
        if any(one[f"r{a}"] % 90 for a in AXES):
            assert numbers["fractions"] is None
            continue
        counted += 1
        parts = parts_of(one)
        given = {name: tuple(map(decimal, parts[name])) for name in ("scale", "shear")}
        exact = World(rotate_degrees=parts["rotate_degrees"], **given).exact
        A = LinearMap.of([row[:3] for row in exact[:3]])
        assert Fraction(numbers["determinant"]) == A.determinant, one
        inverse = A.inverse_transpose if A.rank == 3 else None
        theirs = {
            "none": linear_part(exact),
            "cofactor": A.cofactor_matrix,
            "not-inverted": transpose(linear_part(exact)),
            "not-transposed": inverse and transpose(inverse),
            "exact": inverse,
        }
        for name, found in numbers["fractions"].items():
            ours = found and [[Fraction(x) for x in row] for row in found]
            assert ours == (theirs[name] and [list(row) for row in theirs[name]]), (one, name)
    assert counted > 100


def assert_is_near(found, exact, bound: Fraction, what: object) -> None:
    for row, true in zip(found, exact, strict=True):
        for x, y in zip(row, true, strict=True):
            assert abs(Fraction(x) - y) <= bound * abs(y) + TINY, (what, x, float(y))


@pytest.mark.parametrize("name", SETUPS)
def test_each_space_is_the_packages(told, name) -> None:
    for one, numbers in pairs(told, name):
        setup = SETUPS[name]
        at = Setup(setup.world, setup.view, setup.lens, setup.light)
        if setup.view.handed is Handedness.RIGHT:
            at = replace(at, view=replace(at.view, eye=tuple(numbers["eye"])))
        M = Transform(
            Frame.WORLD, Frame.OBJECT, rational_matrix(placed(one, exactly(one, numbers)))
        )
        maps = replace(replace(at, space_matrix=OTHER_SPACE).maps, world_from_object=M)
        for space in Space:
            found = numbers["spaces"][space.value]
            if space is Space.OBJECT and numbers["rank"] < 3:
                assert found is None
                continue
            if space is Space.OBJECT:
                assert found == rounded_all(maps.space_from_world(space).exact), one
            else:
                assert_is_near(found, maps.space_from_world(space).exact, 8 * U, (one, space))


def views() -> list[tuple]:
    draw = random.Random(7)
    found = [
        ((0, 5, 0), (0, 0, 0), (0, 1, 0)),
        ((0, -5, 0), (0, 0, 0), (0, 3, 0)),
        ((0, 0, 4), (0, 0, -1), (0, 0, 2)),
        ((0.1, 0.2, 0.3), (0.3, 0.6, 0.9), (0.1, 0.2, 0.3)),
        ((0, 0, 0), (0.1, 0.2, 0.3), (0.2, 0.4, 0.6)),
        ((0, 0, 0), (1, 1e-16, 0), (1, 0, 0)),
        ((1e15, 1, 1), (1e15 + 1, 1, 1), (0, 1e-150, 0)),
        ((0, 0, 0), (1e150, 2e150, 1e149), (1e-150, 1e-150, 0)),
        ((3, 0, 0), (0, 0, 0), (1, 0, 0)),
    ]
    for _ in range(200):
        eye, target, up = (
            [draw.choice([0, 0, 1, -2, 0.1, draw.uniform(-9, 9)]) for _ in AXES] for _ in range(3)
        )
        if eye != target and any(up):
            found.append((eye, target, up))
    return found


def test_a_camera_is_the_packages_also_where_up_lies_along_the_sight(mounted) -> None:
    script = """all => all.map(([eye, target, up]) =>
        lookingAlong(eye, wholeDifference(target, eye), up))"""
    place = "document.getElementById('perspective').explorer"
    for one, found in zip(
        views(), floats(mounted.evaluate(inside(script, place), views())), strict=True
    ):
        assert_is_near(found, look_at(*one).camera_from_world, 8 * U, one)


@pytest.mark.parametrize("name", SETUPS)
def test_a_vertexs_way_is_the_packages(told, name) -> None:
    """Each step is a sum of products: 8 u of the sizes that meet, carried on by the next matrix."""
    lens = SETUPS[name].lens
    P, window = SETUPS[name].maps.clip_from_camera, window_from_ndc(*WINDOW, lens.clip)
    for one, numbers in pairs(told, name):
        for way in numbers["way"]:
            steps = dict(way)
            place = [Fraction(x) for x in (*steps["object"], 1)]
            size = [abs(x) for x in place]
            for key, matrix in (
                ("world", numbers["M"]),
                ("camera", numbers["camera"]),
                ("clip", P),
            ):
                place = apply(rational_matrix(matrix), place)
                size = apply(tuple(map(tuple, absolute(matrix))), size)
                assert len(steps[key]) in (3, 4)
                for x, true, most in zip(steps[key], place, size, strict=False):
                    assert abs(Fraction(x) - true) <= 16 * U * most + TINY, (one, key)
            if not steps["ndc"]:
                assert place[3] <= 16 * U * size[3]
                continue
            w = Fraction(steps["clip"][3])
            assert steps["ndc"] == [rounded(Fraction(x) / w) for x in steps["clip"][:3]]
            there = apply(window, (*map(Fraction, steps["ndc"]), Fraction(1)))
            most = apply(
                tuple(map(tuple, absolute(window))),
                (*map(abs, map(Fraction, steps["ndc"])), Fraction(1)),
            )
            for x, true, size_here in zip(steps["window"], there, most, strict=False):
                assert abs(Fraction(x) - true) <= 8 * U * size_here + TINY, one


def test_the_projection_is_the_packages_and_meets_the_camera(mounted, told) -> None:
    for name, setup in SETUPS.items():
        script = inside(
            "() => data.clip_from_camera", f"document.getElementById({name!r}).explorer"
        )
        P = setup.maps.clip_from_camera
        assert mounted.evaluate(script) == rounded_all(P)
        for numbers in told[name][:40]:
            exact = product(P, [[Fraction(x) for x in row] for row in numbers["camera"]])
            most = product(absolute(P), absolute(numbers["camera"]))
            for found, true, size in zip(numbers["clip_from_world"], exact, most, strict=True):
                for x, y, s in zip(found, true, size, strict=True):
                    assert abs(Fraction(x) - y) <= 8 * U * s + TINY


def test_the_worst_angle_of_a_ball_is_the_packages(told) -> None:
    """The climb ends on the hill's top: 1e-6 degrees are 1e-8 of where it stands, squared twice."""
    for index, (one, numbers) in enumerate(pairs(told)):
        if index % 4 or numbers["rank"] < 3:
            continue
        theirs = classify(rational_matrix(numbers["M"])).worst_angle_deg
        assert numbers["largest"] == pytest.approx(theirs, abs=1e-6), one


def test_the_worst_angle_over_directions_is_the_packages(told, mounted) -> None:
    """a = W n and b = K n are off by u of the sizes that meet: their angle by 8 u of them."""
    place = "document.getElementById('perspective').explorer"
    normals = floats(mounted.evaluate(inside("() => meshOf('R').directions", place)))
    for index, (one, numbers) in enumerate(pairs(told)):
        if not index % 4 or numbers["rank"] < 3:
            continue
        K = LinearMap.of(numbers["right"])
        for name, worst in numbers["worst"].items():
            W = LinearMap.of(numbers["rules"][name])
            theirs, slack = 0.0, 0.0
            for n in {tuple(n) for n in normals}:
                a, b = (apply(rational_matrix(m.entries), list(map(Fraction, n))) for m in (W, K))
                angle = exact_angle_between(*(integers(v)[0] for v in (a, b)))
                theirs = max(theirs, degrees(angle))
                for m, v in ((W, a), (K, b)):
                    most = max(abs(x) for row in m.entries for x in row)
                    slack = max(slack, float(16 * U * most / max(map(abs, v))))
            assert isfinite(worst)
            assert abs(worst - theirs) <= degrees(slack) + 1e-9, (one, name)
