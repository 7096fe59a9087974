"""Rotations, worlds and cameras: exponentials, quaternion products, and what a lens must do."""

from __future__ import annotations

import random
from fractions import Fraction
from itertools import permutations
from math import isclose

import mpmath
import pytest

from nmatrix.calculator.arithmetic.numbers import bounds, shown
from nmatrix.calculator.arithmetic.values import Value
from nmatrix.calculator.evaluate import calculate
from nmatrix.calculator.functions.camera import DEPTHS, HANDS, ORIGINS
from nmatrix.calculator.functions.maps import CONVENTIONS
from nmatrix.calculator.functions.rotations import ORDERS
from nmatrix.calculator.names import as_typed, names_of
from nmatrix.enums import ClipY, Convention
from nmatrix.errors import IllegalValueError, NoAnswerError
from nmatrix.linear.measured_lens import FilmBack, HorizontalField, Intrinsics, SideAngles
from nmatrix.linear.projection import NDC_DEPTH, ClipSpace, Window
from nmatrix.linear.rational import to_floats
from nmatrix.linear.viewport import Viewport
from nmatrix.scene.camera import FirstPerson, View
from nmatrix.scene.lens import Lens
from nmatrix.scene.setup import Setup
from nmatrix.scene.world import World


def value(expression, **names):
    return calculate(expression, names).value


def is_true(expression, **names):
    return value(expression, **names).entries is True


def floats(expression, **names):
    return [float(shown(x)) for x in value(expression, **names).numbers]


def vector(chance, size=3, largest=9):
    while True:
        found = [
            Fraction(chance.randint(-largest, largest), chance.randint(1, 3)) for _ in range(size)
        ]
        if any(found):
            return Value(tuple(found))


def holds(found, right, width=Fraction(1, 10**30)):
    """Tell whether the bounds of a number hold mpmath's, and are narrow."""
    low, high = bounds(found)
    near = Fraction(mpmath.nstr(right, 55))
    slack = Fraction(1, 10**50)
    return low - slack <= near <= high + slack and high - low < width


@pytest.mark.parametrize("seed", range(5))
def test_a_turn_about_an_axis_is_the_exponential_of_its_cross_matrix(seed):
    chance = random.Random(seed)
    axis, degrees = vector(chance), chance.randint(-400, 400)
    found = value(f"axis_angle(a, {degrees})", a=axis)
    with mpmath.workdps(60):
        x, y, z = (mpmath.mpf(one.numerator) / one.denominator for one in axis.vector)
        length = mpmath.sqrt(x * x + y * y + z * z)
        turn = mpmath.radians(degrees) / length
        crossed = mpmath.matrix([[0, -z, y], [z, 0, -x], [-y, x, 0]]) * turn
        right = mpmath.expm(crossed)
        for i in range(3):
            for j in range(3):
                assert holds(found.matrix[i][j], right[i, j])


@pytest.mark.parametrize("seed", range(5))
def test_a_quaternion_turns_as_its_product_does(seed):
    """Hamilton's product q v q⁻¹, component by component."""

    def times(p, q):
        (a, b, c, d), (e, f, g, h) = p, q  # the real part comes last
        return (
            d * e + a * h + b * g - c * f,
            d * f - a * g + b * h + c * e,
            d * g + a * f - b * e + c * h,
            d * h - a * e - b * f - c * g,
        )

    chance = random.Random(seed)
    q, v = vector(chance, 4), vector(chance)
    square = sum(x * x for x in q.vector)
    back = tuple(x / square for x in (*(-x for x in q.vector[:3]), q.vector[3]))
    right = times(times(q.vector, (*v.vector, Fraction(0))), back)
    assert right[3] == 0
    assert value("(quaternion(q) @ vector(v)).xyz", q=q, v=v).entries == right[:3]
    again = value("quaternion_of(quaternion(q))", q=q).vector
    assert again[3] >= 0
    factor = again[3] / q.vector[3] if q.vector[3] else None
    assert factor is None or tuple(x * factor for x in q.vector) == again
    assert sum(x * x for x in again) == 1
    assert is_true("quaternion(quaternion_of(quaternion(q))) == quaternion(q)", q=q)


@pytest.mark.parametrize("turn", [0, 15, 30, 36, 45, 60, 72, 90, 120, 150, 180])
def test_exact_turns_have_exact_quaternions_and_angles(turn):
    for name, place in (("x", 0), ("y", 1), ("z", 2)):
        if turn not in (36, 72):
            found = value(f"quaternion_of(rotate_{name}({turn}))")
            half = value(f"sin({Fraction(turn, 2)})").entries
            assert found.exact or turn in (15, 45), turn
            if found.exact:
                assert found.vector[place] == half
        angles = value(
            f'euler(rotate_{name}({turn}), "{"XYZ".replace(name.upper(), "")}{name.upper()}")'
        )
        if turn not in (36, 72):
            assert angles.entries == tuple(turn if i == place else 0 for i in range(3))


def test_orders_are_all_permutations():
    assert sorted(ORDERS) == sorted(
        "".join(p) for axes in ("XYZ", "xyz") for p in permutations(axes)
    )


@pytest.mark.parametrize("order", ORDERS)
def test_euler_angles_of_every_order_turn_back_to_the_matrix(order):
    sequence = order if order.isupper() else order[::-1].upper()
    chance = random.Random(order)
    for _ in range(3):
        q = vector(chance, 4)
        angles = value(f'euler(quaternion(q), "{order}")', q=q)
        turns = [f"rotate_{axis.lower()}(a[{'XYZ'.index(axis)}])" for axis in sequence]
        names = {
            "a": angles,
            "q": q,
        }
        off = value(f"{' @ '.join(turns)} - quaternion(q)", **names)
        assert max(max(abs(end) for end in bounds(x)) for x in off.numbers) < Fraction(1, 10**30)


@pytest.mark.parametrize("order", ORDERS)
def test_a_gimbal_lock_is_told_and_the_angles_still_turn_alike(order):
    sequence = order if order.isupper() else order[::-1].upper()
    first, middle, last = (axis.lower() for axis in sequence)
    for quarter in (90, -90):
        R = f"rotate_{first}(30) @ rotate_{middle}({quarter}) @ rotate_{last}(45)"
        calculation = calculate(f'euler({R}, "{order}")', {})
        assert "gimbal lock" in calculation.remarks[0]
        a = calculation.value
        assert a.vector["xyz".index(last)] == 0
        assert a.vector["xyz".index(middle)] == quarter
        again = f"rotate_{first}(a[{'xyz'.index(first)}]) @ rotate_{middle}({quarter})"
        assert is_true(f"{again} == {R}", a=a)


@pytest.mark.parametrize("turns", [(20, 30, 0), (0, 33, 7), (20, 0, 0), (11, 0, -50)])
def test_turns_that_no_roots_tell_are_found_and_zeros_among_them_are_zeros(turns):
    for M in (
        "world(rotate=t)",
        "world([1, 2, 3], t, [2, 3, 1/2])",
        "rotate_x(t[0]) @ rotate_y(t[1]) @ rotate_z(t[2])",
    ):
        found = value(f"euler({M})", t=Value(tuple(map(Fraction, turns))))
        for one, right in zip(found.numbers, turns, strict=True):
            low, high = bounds(one)
            assert low <= right <= high
            assert high - low < Fraction(1, 10**35)
            assert right or one == 0


def test_scale_shear_and_mirror_leave_the_rotation():
    R = "rotate_z(30) @ rotate_x(45)"
    for rest in ("scale(2, 3, 5)", "scale(2, 3, 5) @ shear(1, 2, 3)", "scale(4, 4, 4)"):
        assert is_true(f"quaternion(quaternion_of({R} @ {rest})) ≈ {R}")
        assert is_true(f'euler({R} @ {rest}, "ZYX") ≈ [45, 0, 30]')
    assert is_true("quaternion_of(scale(1, -1, 1)) == [0, 0, 0, 1]")
    with pytest.raises(NoAnswerError, match="singular"):
        value("euler(scale(1, 0, 1))")


@pytest.mark.parametrize("convention", CONVENTIONS.values())
def test_a_world_is_the_product_that_its_convention_says(convention):
    word = next(key for key, one in CONVENTIONS.items() if one is convention)
    product = {
        Convention.STANDARD: "rotate_x(a) @ rotate_y(b) @ rotate_z(c)",
        Convention.POLIMI: "rotate_x(b) @ rotate_y(-a) @ rotate_z(-c)",
        Convention.POLIMI_ASSIGNMENTS: "rotate_x(b) @ rotate_y(a) @ rotate_z(c)",
    }[convention]
    chance = random.Random(word)
    turns = chance.sample([0, 15, 30, 45, 60, 90, 120, 135, 180, -30, 210], 3)
    names = {key: Value(Fraction(turn)) for key, turn in zip("abc", turns, strict=True)}
    names |= {"t": vector(chance), "s": vector(chance), "h": vector(chance)}
    built = f"translate(t) @ {product} @ scale(s) @ shear(h)"
    call = f'world(t, [a, b, c], s, h, convention="{word}")'
    assert is_true(f"{call} == {built}", **names)


def test_a_world_takes_each_rotation_and_one_scale_for_three():
    built = "translate(1, 2, 3) @ {} @ scale(2, 2, 2)"
    for words, turned in (
        ('rotate=[30, 45, 60], order="zxy"', "rotate_y(45) @ rotate_x(30) @ rotate_z(60)"),
        ("quaternion=[0, 0, 1, √3]", "rotate_z(60)"),
        ("axis_angle=[0, 5, 0, 45]", "rotate_y(45)"),
        ("shear=[0, 0, 0]", "identity(4)"),
    ):
        call = f"world(translate=[1, 2, 3], scale=2, {words})"
        assert is_true(f"{call} == {built.format(turned)}"), words
    for words in (
        "quaternion=[0, 0, 0, 1], axis_angle=[1, 0, 0, 0]",
        'rotate=[1, 2, 3], order="XYZ", convention="polimi"',
        'quaternion=[0, 0, 0, 1], order="XYZ"',
        'order="XXZ"',
    ):
        with pytest.raises(IllegalValueError):
            value(f"world({words})")


@pytest.mark.parametrize("handed", HANDS)
@pytest.mark.parametrize("seed", range(4))
def test_a_camera_sees_its_target_on_the_axis_and_up_upwards(handed, seed):
    chance = random.Random(seed)
    eye, target, up = vector(chance), vector(chance), vector(chance)
    V = value(f'look_at(e, t, u, handed="{handed}")', e=eye, t=target, u=up)
    names = {"V": V, "e": eye, "t": target, "u": up}
    assert value("(V @ point(e)).xyz", **names).entries == (0, 0, 0)
    x, y, z = value("(V @ point(t)).xyz", **names).vector
    assert (x, y) == (0, 0)
    assert z * z == value("dot(t - e, t - e)", **names).scalar
    assert (z < 0) == (handed == "right")
    x, y, _ = value("(V @ vector(u)).xyz", **names).vector
    assert x == 0
    assert y > 0
    assert is_true("linear(V) @ linear(V).T == identity(3)", **names)
    assert value("det(V)", **names).entries == 1


@pytest.mark.parametrize(
    ("eye", "instead"), [("[0, 5, 0]", "[0, 0, -1]"), ("[0, -5, 0]", "[0, 0, 1]")]
)
def test_an_up_along_the_view_is_replaced_and_told(eye, instead):
    found = calculate(f"look_at({eye}, [0, 0, 0])", {})
    assert instead in found.remarks[0]
    assert is_true(f"V == look_at({eye}, [0, 0, 0], {instead})", V=found.value)


LENSES = [(depth, hand, y) for depth in DEPTHS for hand in HANDS for y in map(str, ClipY)]


@pytest.mark.parametrize(("depth", "hand", "y"), LENSES)
def test_a_lens_takes_its_corners_to_those_of_the_cube(depth, hand, y):
    """A point at a corner of the near or far plane has x, y = ±1 and its end of the depth range."""
    words = f'depth="{depth}", handed="{hand}", clip_y="{y}"'
    forward, up = (-1 if hand == "right" else 1), (1 if y == "up" else -1)
    near, far, (left, right, bottom, top) = 2, 7, (-1, 3, -2, 5)
    frustum = value(f"frustum({left}, {right}, {bottom}, {top}, {near}, {far}, {words})")
    ortho = value(f"ortho({left}, {right}, {bottom}, {top}, {near}, {far}, {words})")
    ends = zip((near, far), NDC_DEPTH[DEPTHS[depth]], strict=True)
    for distance, z in ends:
        for x, ndc_x in ((left, -1), (right, 1)):
            for v, ndc_y in ((bottom, -up), (top, up)):
                wide = Fraction(distance, near)
                p = Value((x * wide, v * wide, Fraction(forward * distance)))
                assert value("project(P @ point(p))", P=frustum, p=p).entries == (ndc_x, ndc_y, z)
                p = Value((Fraction(x), Fraction(v), Fraction(forward * distance)))
                assert value("project(P @ point(p))", P=ortho, p=p).entries == (ndc_x, ndc_y, z)
                back = value("unproject(project(P @ point(p)), P)", P=frustum, p=p)
                assert back.entries == p.entries
    half = "sqrt(3)"  # tan 60°
    square = value(f"perspective(120, 2, {near}, {far}, {words})")
    sides = f"-2*{near}*{half}, 2*{near}*{half}, -{near}*{half}, {near}*{half}"
    assert is_true(f"P == frustum({sides}, {near}, {far}, {words})", P=square)


def test_an_infinite_far_plane_is_the_limit():
    for name, before in (("perspective", "60, 16/9"), ("frustum", "-1, 2, -1, 3")):
        for depth in DEPTHS:
            words = f'depth="{depth}"'
            end = value(f'{name}({before}, √2, "inf", {words})')
            huge = value(f"{name}({before}, √2, 1e40, {words})")
            off = max(
                max(abs(e) for e in bounds(x - y))
                for x, y in zip(end.numbers, huge.numbers, strict=True)
            )
            assert off < Fraction(1, 10**38)
    with pytest.raises(IllegalValueError):
        value('ortho(-1, 1, -1, 1, 0, "inf")')


@pytest.mark.parametrize("origin", ORIGINS)
@pytest.mark.parametrize("depth", DEPTHS)
def test_a_viewport_takes_the_corners_of_the_cube_to_those_of_the_window(origin, depth):
    words = f'depth="{depth}", origin="{origin}"'
    at_near, at_far = NDC_DEPTH[DEPTHS[depth]]
    flip = 1 if origin == "lower_left" else -1
    window = value(f"viewport(640, 480, {words})")
    for z, right in (
        (at_near, 0 if depth != "reversed" else 1),
        (at_far, 1 if depth != "reversed" else 0),
    ):
        for x, y in ((-1, -1), (1, 1), (0, 0)):
            ndc = Value((Fraction(x), Fraction(y), Fraction(z)))
            found = value("(W @ point(p)).xyz", W=window, p=ndc).entries
            assert found == (320 * (x + 1), 240 * (flip * y + 1), right)
    back = (
        "unproject([160, 120, 1/4], P, W) == unproject(project(inverse(W) @ [160, 120, 1/4, 1]), P)"
    )
    assert is_true(back, W=window, P=value("perspective(90, 4/3, 1, 9)"))


def test_normals_and_planes_stay_with_their_surfaces():
    chance = random.Random(7)
    for _ in range(5):
        M = value(
            "world(t, [30, 45, 60], s, h)",
            t=vector(chance),
            s=Value((Fraction(2), Fraction(-3), Fraction(1, 2))),
            h=vector(chance),
        )
        n, along, p = vector(chance), vector(chance), vector(chance)
        names = {"M": M, "n": n, "p": p, "t": value("cross(n, a)", n=n, a=along)}
        assert value("dot(normal_matrix(M) @ n, linear(M) @ t)", **names).entries == 0
        plane = value("[n.x, n.y, n.z, -dot(n, p)]", **names)
        names["plane"] = plane
        assert value("dot(transform_plane(M, plane), M @ point(p))", **names).entries == 0
        assert value("dot(transform_plane(M, plane), M @ point(p + n))", **names).entries != 0
    with pytest.raises(NoAnswerError, match="cofactor"):
        value("normal_matrix(scale(1, 0, 1))")


def test_ways_between_two_directions():
    chance = random.Random(3)
    for _ in range(5):
        a, b = vector(chance), vector(chance)
        t = Fraction(chance.randint(1, 9), 10)
        names = {"a": a, "b": b, "t": Value(t)}
        assert value("lerp(a, b, t)", **names).entries == tuple(
            x + t * (y - x) for x, y in zip(a.vector, b.vector, strict=True)
        )
        names["c"] = value("slerp(a, b, t)", **names)
        assert isclose(floats("length(c)", **names)[0], 1, rel_tol=1e-15)
        whole, part = floats("angle(a, b)", **names)[0], floats("angle(a, c)", **names)[0]
        assert isclose(part, whole * t, rel_tol=1e-12, abs_tol=1e-12)
        rest = floats("angle(c, b)", **names)[0]
        assert isclose(part + rest, whole, rel_tol=1e-12, abs_tol=1e-12)
    assert is_true("slerp([1, 0, 0], [0, 2, 0], 1/2) == normalize([1, 1, 0])")
    assert is_true("slerp([1, 0], [1, 0], 1/3) == [1, 0]")
    assert is_true("slerp([0, 0, 0, 1], [0, 0, 0, -1], 1/3) == [0, 0, 0, 1]")
    half = "slerp(quaternion_of(rotate_z(0)), -1 * quaternion_of(rotate_z(120)), 1/2)"
    assert is_true(f"quaternion({half}) == rotate_z(60)")


def test_a_mirror_keeps_lengths_and_turns_the_normal_round():
    chance = random.Random(5)
    for _ in range(5):
        v, n = vector(chance), vector(chance)
        names = {"v": v, "n": n, "r": value("reflect(v, n)", v=v, n=n)}
        assert is_true("dot(r, r) == dot(v, v)", **names)
        assert is_true("dot(r, n) == -dot(v, n)", **names)
        assert is_true("cross(r - v, n) == [0, 0, 0]", **names)
        assert is_true("reflect(v, 3 * n) == r", **names)
        assert is_true("cross_matrix(v) @ n == cross(v, n)", **names)
        assert is_true("trace(outer(v, n)) == dot(v, n)", **names)


VIEWS = [
    View(),
    View(eye=(1, 2, 3), target=(0.5, -1, 2), up=(0, 0, 1)),
    View(eye=(0, 5, 0)),
    View(eye=(1, 2, 3), handed="left"),
    View(eye=(3, 3, 2.5), angles=FirstPerson(-45, -40, 10), convention="polimi"),
    View(eye=(0.1, 0.2, 0.3), angles=FirstPerson(30, 60)),
    View(matrix=[[0, 0, 1, 2], [1, 0, 0, 3], [0, 1, 0, 4], [0, 0, 0, 1]]),
]
WINDOWS = {"viewport": Viewport(640, 480)}
LENSES_OF_OPTIONS = [
    Lens(),
    Lens(fov_degrees=90, aspect=16 / 9, near=0.5, far=float("inf")),
    Lens(ortho=Window(-1.1, 2, -1, 1), clip=ClipSpace(depth="reversed")),
    Lens(frustum=Window(-0.1, 0.2, -0.1, 0.3), clip=ClipSpace(handed="left")),
    Lens(measured=HorizontalField(75), aspect=1.5),
    Lens(measured=FilmBack(50, (36, 24))),
    Lens(measured=Intrinsics(500.5, 500, 320, 240), **WINDOWS),
    Lens(measured=SideAngles(-45, 40, -30, 35), clip=ClipSpace(depth="zero-to-one")),
]


@pytest.mark.parametrize("view", VIEWS)
def test_v_is_the_view_matrix_before_any_rounding(view):
    found = names_of(Setup(view=view), "V")["V"]
    right = to_floats(view.placed().camera_from_world)
    assert floats("V", V=found) == pytest.approx([x for row in right for x in row], abs=1e-15)
    if view.is_aimed:
        assert is_true("linear(V) @ linear(V).T == identity(3)", V=found)


@pytest.mark.parametrize("lens", LENSES_OF_OPTIONS)
def test_p_is_the_projection_before_any_rounding_and_knows_its_depth(lens):
    names = names_of(Setup(lens=lens), "depth_of(d)")
    right = to_floats(lens.clip_from_camera)
    assert floats("P", **names) == pytest.approx([x for row in right for x in row], rel=1e-15)
    forward = lens.clip.forward_z
    word = next(key for key, one in DEPTHS.items() if one is lens.clip.depth)
    for distance in ("0.7", "3", "42"):
        camera = f"point([1/3, 1/5, {forward * Fraction(distance)}])"
        depth = f'(viewport(8, 8, depth="{word}") @ point(project(P @ {camera}))).z'
        assert is_true(f"depth_of({distance}) == {depth}", **names)
        assert is_true(f"distance_of(depth_of({distance})) == {distance}", **names)
    assert "P" not in names_of(Setup(lens=lens), "M @ V")


def test_exact_lenses_have_roots():
    P = names_of(Setup(lens=Lens(aspect=16 / 9)), "P")["P"].matrix
    assert [str(P[0][0]), str(P[1][1])] == ["9√3/16", "√3"]
    wide = names_of(Setup(lens=Lens(measured=HorizontalField(90), aspect=1.6)), "P")["P"].matrix
    assert (wide[0][0], wide[1][1]) == (1, Fraction(8, 5))


@pytest.mark.parametrize("lens", ["near=1", "far=3", 'depth="reversed"', ""])
def test_a_depth_without_a_lens_asks_for_near_and_far(lens):
    with pytest.raises(IllegalValueError, match="near and far"):
        value(f"depth_of(2{', ' if lens else ''}{lens})")


def test_a_depth_of_another_lens_than_p():
    names = names_of(Setup(), "depth_of(2)")
    for depth, (at_near, at_far) in (("zero_to_one", (0, 1)), ("reversed", (1, 0))):
        words = f'near=1, far=3, depth="{depth}"'
        assert value(f"depth_of(1, {words})", **names).entries == at_near
        assert value(f"depth_of(3, {words})", **names).entries == at_far
    assert is_true('distance_of(1/2, near=1, far="inf", depth="reversed") == 2', **names)


def test_m_with_an_axis_is_the_turn_of_the_calculator():
    world = World(axis_angle=(1, 1, 1, 20), translate=(0.1, 0, 0), scale=(2, 2, 2))
    M = names_of(Setup(world), "M")["M"]
    built = value("translate(1/10, 0, 0) @ axis_angle([1, 1, 1], 20) @ scale(2)")
    for x, y in zip(M.numbers, built.numbers, strict=True):
        low, high = bounds(x - y)
        assert low <= 0 <= high
        assert high - low < Fraction(1, 10**35)
    tilted = names_of(Setup(World(axis_angle=(1, 1, 1, 120))), "M")["M"]
    assert tilted.entries == value("[0 0 1 0; 1 0 0 0; 0 1 0 0; 0 0 0 1]").entries


@pytest.mark.parametrize(
    "text", ["0.1", "-2.5", "1e-7", "123456.789", "16/9", "1/3", "-7/11", "0", "1e300", "5e-324"]
)
def test_a_number_is_the_one_that_was_typed(text):
    assert as_typed(float(Fraction(text))) == Fraction(text)


def test_typed_numbers_of_many_digits_are_their_decimals():
    chance = random.Random(2)
    for _ in range(200):
        x = chance.uniform(-5, 5)
        assert float(as_typed(x)) == x
        assert as_typed(x) == Fraction(repr(x))
