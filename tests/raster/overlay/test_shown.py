"""Marks over scenes and meshes: each is where the picture has what it stands for, or nowhere."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from nmatrix.canvas.marks import Box, Canvas, Polygon, Stroke, Text
from nmatrix.canvas.paint import pixels
from nmatrix.canvas.theme import PALETTES
from nmatrix.enums import DepthRange, NormalRule, Shading, Shown, Theme
from nmatrix.linear.projection import ClipSpace, Window
from nmatrix.linear.rational import to_floats
from nmatrix.raster.drawn_scene import DrawnScene, drawn_scene
from nmatrix.raster.loaded_scene import Body
from nmatrix.raster.overlay.hedgehog import LONGEST, MOST, SHORTEST, Hedgehog
from nmatrix.raster.overlay.labels import Labels
from nmatrix.raster.overlay.mesh_lines import edges_of
from nmatrix.raster.overlay.segments import in_view, seen_pieces
from nmatrix.raster.overlay.shown import BOUND, LEAST_SCALE, marked
from nmatrix.raster.overlay.stage import ARROW, DISC, Stage
from nmatrix.raster.shading.normals import unit
from nmatrix.raster.shading.space import world_face_normals, world_normals
from nmatrix.scene.camera import View
from nmatrix.scene.geometry import LoadedGeometry
from nmatrix.scene.lens import Lens
from nmatrix.scene.light import SceneLight
from nmatrix.scene.material import Material
from nmatrix.scene.meshes.mesh import Mesh
from nmatrix.scene.meshes.shapes import box, plane, sphere
from nmatrix.scene.scene import Scene, SceneObject, Settings
from nmatrix.scene.words import LightKind
from nmatrix.scene.world import World

EYE = (2.5, 1.8, 4.0)
VIEW = View(eye=EYE)
SIZE = (360, 240)
LENS = Lens(near=1, far=40, aspect=1.5)
LENSES = [replace(LENS, clip=ClipSpace(depth=one)) for one in DepthRange]
STRETCHED = World(scale=(0.6, 1.4, 0.9), rotate_degrees=(10, 30, 0))
SUN = SceneLight("sun", LightKind.DIRECTIONAL, direction=(-1, -1, -1))


def thing(mesh: Mesh, world: World = STRETCHED, name: str = "thing") -> SceneObject:
    return SceneObject(name, LoadedGeometry(mesh), world.world_from_object, Material())


def scene(*things: SceneObject, **settings: object) -> Scene:
    picture = Settings(size=SIZE, samples=1)
    return Scene(things, (SUN,), VIEW, LENS, replace(picture, **settings))  # type: ignore[arg-type]


def drawn(found: Scene) -> DrawnScene:
    return drawn_scene(found, keeps_depth=True)


def stage(found: Scene) -> Stage:
    size = found.settings.size
    canvas = Canvas(*size, PALETTES[Theme.LIGHT], 1.0)
    return Stage(canvas, Box(0, 0, *size), drawn(found))


def hedgehog(found: Scene) -> tuple[Hedgehog, list[str]]:
    remarks: list[str] = []
    place = stage(found)
    return Hedgehog.on(place, Labels(place.canvas), remarks), remarks


def marks(found: Scene, *shown: Shown, theme: Theme = Theme.LIGHT) -> tuple[Canvas, str]:
    canvas, remarks = marked(drawn(found), shown, theme)
    return canvas, " ".join(remarks)


def sine(u: np.ndarray, v: np.ndarray) -> float:
    """Return how far v reaches across u."""
    return float(u[0] * v[1] - u[1] * v[0]) / float(np.hypot(*u))


def texts(canvas: Canvas) -> list[str]:
    return [one.text for one in canvas.marks if isinstance(one, Text)]


@pytest.mark.parametrize("rule", NormalRule)
@pytest.mark.parametrize("shading", [Shading.PHONG, Shading.FLAT])
def test_each_normal_is_one_of_the_mesh_as_the_rule_carries_it(
    rule: NormalRule, shading: Shading
) -> None:
    mesh = sphere(8, 16)
    found, _ = hedgehog(scene(thing(mesh), normals=rule, shading=shading))
    (chosen,), loaded = found.chosen, found.stage.loaded
    body: Body = chosen.body
    carry = world_face_normals if shading is Shading.FLAT else world_normals
    points = body.positions_world
    if shading is Shading.FLAT:
        points = points[mesh.triangles].mean(axis=1)
    true, ruled = (carry(loaded, body, one).T for one in (NormalRule.EXACT, rule))
    assert 4 <= len(chosen.points) <= MOST
    for place, n, arrow in zip(chosen.points, chosen.true, chosen.ruled, strict=True):
        same = (np.abs(points - place) < 1e-12).all(axis=1)
        same &= (np.abs(unit(true) - n) < 1e-12).all(axis=1)
        assert same.any()
        assert (np.abs(ruled[same] - arrow) < 1e-12).all(axis=1).any()


def test_an_arrow_starts_at_its_vertex_and_ends_where_its_normal_does() -> None:
    found, _ = hedgehog(scene(thing(sphere(8, 16))))
    found.normals()
    (chosen,) = found.chosen
    strokes = [one for one in found.stage.canvas.marks if isinstance(one, Stroke)]
    heads = [one for one in found.stage.canvas.marks if isinstance(one, Polygon)]
    long = found._length(chosen)
    for place, normal in zip(chosen.points, chosen.ruled, strict=True):
        a, b = found.stage.place(place), found.stage.place(place + long * normal)
        if np.hypot(b[0] - a[0], b[1] - a[1]) < 8:  # it points at the eye
            continue
        assert any(np.allclose(one.points[0], a) for one in strokes)
        assert any(np.allclose(one.loops[0][-1], b) for one in heads if len(one.loops[0]) == 3)


def test_discs_and_arrows_have_a_length_that_can_be_seen_however_large_the_body_is() -> None:
    for size in (0.05, 1.0, 30.0):
        world = World(scale=(size,) * 3)
        far = View(eye=tuple(size * one for one in EYE))
        lens = replace(LENS, near=size, far=40 * size)
        found, _ = hedgehog(replace(scene(thing(sphere(8, 16), world)), view=far, lens=lens))
        (chosen,) = found.chosen
        across = found.stage.across * found._length(chosen)
        ends = (found.stage.window(p)[:, :2] for p in (chosen.points, chosen.points + across))
        a, b = ends
        shown = np.median(np.sqrt(((b - a) ** 2).sum(axis=1)))
        assert SHORTEST * 0.99 <= shown <= LONGEST * 1.01
        assert DISC < ARROW


def test_a_wrong_rule_leans_and_is_told_by_its_dashes() -> None:
    for rule, is_dashed in ((NormalRule.EXACT, False), (NormalRule.NONE, True)):
        canvas, _ = marks(scene(thing(sphere(8, 16)), normals=rule), Shown.NORMALS)
        dashed = [one for one in canvas.marks if isinstance(one, Stroke) and one.dash]
        assert bool(dashed) is is_dashed


def test_a_normal_that_the_rule_makes_zero_has_no_arrow_and_a_remark() -> None:
    flat = thing(sphere(8, 16), World(scale=(1, 0, 1), rotate_degrees=(60, 0, 0)))
    found, _ = hedgehog(scene(flat, normals=NormalRule.INVERSE))
    (chosen,) = found.chosen
    assert len(chosen.points)
    assert not chosen.ruled.any()
    canvas, remarks = marks(scene(flat, normals=NormalRule.INVERSE), Shown.NORMALS)
    assert "Zero by this rule, a 0 on the disc: 7 of 7 normals drawn." in remarks
    assert not [m for m in canvas.marks if isinstance(m, Polygon) and len(m.loops[0]) == 3]
    right, _ = hedgehog(scene(flat))
    (both_sides,) = right.chosen
    towards = np.array(EYE) - both_sides.points
    assert ((both_sides.true * towards).sum(axis=1) > 0).all()


def test_only_normals_that_are_seen_are_drawn() -> None:
    wall = thing(box(8), World(scale=(4, 4, 0.1), translate=(0, 0, 1.5)), "wall")
    ball = thing(sphere(8, 16), World(), "ball")
    found, _ = hedgehog(scene(ball, wall))
    shown = {one.body.name: len(one.points) for one in found.chosen}
    assert shown["ball"] == 0
    assert shown["wall"] > 0
    alone, _ = hedgehog(scene(ball))
    (chosen,) = alone.chosen
    towards = unit(np.array(EYE) - chosen.points)
    assert ((chosen.true * towards).sum(axis=1) > -0.25).all(), "none is on the far side"


def test_a_corner_shows_the_normal_of_each_face_that_is_seen() -> None:
    found, _ = hedgehog(scene(thing(box(1), World()), size=(1200, 800)))
    (chosen,) = found.chosen
    nearest = chosen.points[((chosen.points - EYE) ** 2).sum(axis=1).argmin()]
    there = chosen.true[(chosen.points == nearest).all(axis=1)]
    assert sorted(there.tolist()) == [[0, 0, 1], [0, 1, 0], [1, 0, 0]]


def test_a_remark_says_how_many_normals_of_how_many_are_drawn() -> None:
    found, _ = hedgehog(scene(thing(sphere(48, 96))))
    (chosen,) = found.chosen
    _, remarks = marks(scene(thing(sphere(48, 96))), Shown.NORMALS)
    assert "Normals are drawn at" in remarks
    assert "vertices that are seen" in remarks
    apart = found.stage.window(chosen.points)[:, :2]
    near = [np.sort(np.sqrt(((apart - one) ** 2).sum(axis=1)))[1] for one in apart]
    assert min(near) > 20
    few = Mesh(
        np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]), np.eye(3)[[2, 2, 2]], np.array([[0, 1, 2]])
    )
    assert "drawn at" not in marks(scene(thing(few, World())), Shown.NORMALS)[1]


def test_tangents_lie_in_the_surface_that_the_map_makes() -> None:
    for shading in (Shading.PHONG, Shading.FLAT):
        found, _ = hedgehog(scene(thing(sphere(8, 16)), shading=shading))
        (chosen,) = found.chosen
        assert np.abs((chosen.tangents * chosen.true).sum(axis=1)).max() < 1e-9
        assert np.allclose((chosen.tangents**2).sum(axis=1), 1)


def test_the_tangents_of_a_mesh_are_carried_by_the_map_itself() -> None:
    mesh = plane()
    along = np.tile([1.0, 0.0, 0.0, 1.0], (len(mesh.positions), 1))
    with_own = replace(mesh, tangents=along)
    world = World(scale=(2, 1, 1), shear=(0.5, 0, 0), rotate_degrees=(30, 0, 0))
    found, remarks = hedgehog(scene(thing(with_own, world)))
    (chosen,) = found.chosen
    carried = unit(np.array(to_floats(world.world_from_object))[:3, :1].T)
    assert np.allclose(chosen.tangents, carried)
    found.tangents()
    assert not [one for one in remarks if "level" in one]


@pytest.mark.parametrize("lens", LENSES)
def test_lines_are_cut_where_they_leave_the_picture_and_at_the_eye(lens: Lens) -> None:
    place = stage(replace(scene(thing(sphere(8, 16))), lens=lens))
    behind, ahead = 2 * np.array(EYE), -np.array(EYE)
    a, b = in_view(place, np.array([behind, [50.0, 60, -9]]), np.array([ahead, [60.0, 60, -9]]))
    assert len(a) == 1, "what is outside is left out"
    window = place.window(np.concatenate([a, b]))
    assert np.isfinite(window).all()
    assert (window[:, 2] > -1e-9).all()
    assert np.allclose(b[0], ahead)
    wide, _ = in_view(place, np.array([[-99.0, 0, 0]]), np.array([[99.0, 0, 0]]))
    assert np.allclose(place.window(wide)[0, 0], 0.0, atol=1e-6)


@pytest.mark.parametrize("lens", LENSES)
def test_edges_are_drawn_where_edges_are_and_hidden_ones_left_out(lens: Lens) -> None:
    place = stage(replace(scene(thing(box(1), World())), lens=lens))
    (body,) = place.loaded.bodies
    edges, points = edges_of(body.mesh), body.positions_world
    a, b = (points[edges.vertex[edges.ends[:, i]]] for i in (0, 1))
    pieces = seen_pieces(place, a, b)
    ends = [place.window(one)[:, :2] for one in (a, b)]
    for p, q in pieces:
        away = [
            abs(sine(v - u, one - u)) for u, v in zip(*ends, strict=True) for one in ((p + q) / 2,)
        ]
        assert min(away) < 0.5
    turned_away = (((a + b) / 2) < -0.9).sum(axis=1) == 2  # edges of two faces that are hidden
    assert turned_away.sum() == 3
    for one, other in zip(a[turned_away], b[turned_away], strict=True):
        seen = seen_pieces(place, one[None], other[None])
        assert np.abs(seen[:, 1] - seen[:, 0]).sum() < 4, "but for the pixels at the rim"


def test_the_wireframe_of_a_fine_mesh_is_its_outline_and_says_so() -> None:
    coarse, fine = (scene(thing(sphere(n, 2 * n))) for n in (6, 96))
    drawn_coarse, told_coarse = marks(coarse, Shown.WIREFRAME)
    drawn_fine, told_fine = marks(fine, Shown.WIREFRAME)
    lines = [
        sum(len(one.loops) for one in canvas.marks if isinstance(one, Polygon))
        for canvas in (drawn_coarse, drawn_fine)
    ]
    assert "Wireframe" not in told_coarse
    assert "outline" in told_fine
    assert "36,480 triangles" in told_fine
    assert lines[0] > 60
    assert 0 < lines[1] < 400


def test_a_box_has_the_corners_of_its_object() -> None:
    world = World(scale=(1, 1.5, 0.7), shear=(0.6, 0, 0), rotate_degrees=(0, 25, 0))
    found = scene(thing(sphere(12, 24), world))
    canvas, _ = marks(found, Shown.BOUNDS)
    place = Stage(canvas, Box(0, 0, canvas.width, canvas.height), drawn(found))
    M = np.array(to_floats(world.world_from_object))
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
    expected = place.window(corners @ M[:3, :3].T + M[:3, 3])[:, :2]
    (ink,) = (one for one in canvas.marks if isinstance(one, Polygon) and one.width == BOUND)
    ends = np.array(ink.loops).reshape(-1, 2)
    at_corner = [np.sqrt(((ends - one) ** 2).sum(axis=1)).min() < 2 for one in expected]
    assert sum(at_corner) >= 7, "one may be behind the ball"
    assert "thing" in texts(canvas)


def test_axes_begin_at_the_origin_and_go_along_x_y_and_z() -> None:
    found = replace(scene(thing(sphere(12, 24), World(scale=(0.3,) * 3))), view=View(eye=(3, 2, 4)))
    canvas, _ = marks(found, Shown.AXES)
    place = Stage(canvas, Box(0, 0, canvas.width, canvas.height), drawn(found))
    origin = np.array(place.place((0, 0, 0)))
    letters = [one for one in canvas.marks if isinstance(one, Text)]
    for name, axis in zip("xyz", np.eye(3), strict=True):
        (letter, *_) = (one for one in letters if one.text == name)
        towards = np.array(place.place(0.5 * axis)) - origin
        there = np.array([letter.box.middle[0], letter.box.middle[1]]) - origin
        cosine = there @ towards / np.hypot(*there) / np.hypot(*towards)
        assert cosine > 0.98, name


LAMPS = {
    "in the picture": ((1.0, 1.0, 1.0), None),
    "outside of the picture": ((40.0, 0.0, -30.0), "outside of the picture"),
    "behind the eye": ((6.0, 9.0, 12.0), "behind the eye"),
    "where the eye is": (EYE, "where the eye is"),
}


@pytest.mark.parametrize("place", LAMPS)
def test_a_lamp_is_where_it_is_or_at_the_edge_towards_it(place: str) -> None:
    position, told = LAMPS[place]
    lamp = SceneLight("lamp", LightKind.POINT, position=position)
    found = replace(scene(thing(sphere(8, 16), World(scale=(0.3,) * 3))), lights=(lamp,))
    canvas, remarks = marks(found, Shown.LIGHTS)
    light = PALETTES[Theme.LIGHT].light
    (disc,) = (one for one in canvas.marks if isinstance(one, Polygon) and one.fill == light)
    middle = np.mean(disc.loops[0], axis=0)
    assert Box(0, 0, canvas.width, canvas.height).holds(tuple(middle))
    assert "lamp" in texts(canvas)
    stage_there = Stage(canvas, Box(0, 0, canvas.width, canvas.height), drawn(found))
    if told is None:
        assert np.allclose(middle, stage_there.place(position))
        assert "lamp" not in remarks
        return
    assert told in remarks
    if told == "outside of the picture":
        away = np.array(stage_there.place(position)) - [canvas.width / 2, canvas.height / 2]
        u = (middle - [canvas.width / 2, canvas.height / 2]) / np.hypot(*away)
        assert u @ away > 0
        assert abs(sine(u, away)) < 1e-6


def test_the_eye_is_on_a_map_from_above() -> None:
    canvas, _ = marks(scene(thing(sphere(8, 16), World())), Shown.EYE)
    palette = PALETTES[Theme.LIGHT]
    (body,) = (one for one in canvas.marks if isinstance(one, Polygon) and one.fill == palette.body)
    eye = [one for one in canvas.marks if isinstance(one, Polygon) and one.edge == palette.eye]
    ball, lens = (np.mean(one.loops[0], axis=0) for one in (body, eye[0]))
    scale = np.ptp(np.array(body.loops[0])[:, 0]) / 2
    assert np.allclose((lens - ball) / scale, [EYE[0], EYE[2]], atol=0.35)
    assert "from above" in texts(canvas)


def test_names_that_the_font_cannot_set_are_replaced_and_said() -> None:
    found = scene(thing(box(1), World(), "椅子"), thing(box(1), World(translate=(2, 0, 0)), "כדור"))
    canvas, remarks = marks(found, Shown.BOUNDS)
    assert {"object 1", "object 2"} <= set(texts(canvas))
    assert "椅子" in remarks
    assert not any(ord(letter) > 0x2FFF for one in texts(canvas) for letter in one)


def test_a_name_is_no_markup_and_no_control_character_is_set() -> None:
    canvas, _ = marks(scene(thing(box(1), World(), "a*b*^{2}")), Shown.BOUNDS)
    (name,) = texts(canvas)
    assert "*" not in name
    assert "{" not in name


@pytest.mark.parametrize("size", [(64, 64), (97, 31), (1, 1), (640, 480), (2048, 16)])
@pytest.mark.parametrize("theme", Theme)
def test_a_picture_of_any_size_keeps_its_pixels_under_the_marks(
    size: tuple[int, int], theme: Theme
) -> None:
    found = drawn(scene(thing(sphere(8, 16)), size=size))
    canvas, _ = marked(found, (), theme)
    assert canvas.scale >= LEAST_SCALE
    assert np.array_equal(pixels(canvas), found.levels)
    everything, _ = marked(found, Shown, theme)
    assert pixels(everything).shape == found.levels.shape


def test_what_shows_nothing_is_no_error() -> None:
    away = replace(scene(thing(sphere(8, 16))), view=View(eye=(0, 0, 9), target=(0, 0, 20)))
    _, remarks = marks(away, *Shown)
    assert "outside of the picture" in remarks
    point = Mesh(np.zeros((3, 3)), np.eye(3)[[2, 2, 2]], np.array([[0, 1, 2]]))
    marks(scene(thing(point, World())), *Shown)


def test_glass_hides_no_line() -> None:
    pane = replace(thing(box(1), World()), material=Material(opacity=0.5))
    place = stage(scene(pane))
    (body,) = place.loaded.bodies
    edges, points = edges_of(body.mesh), body.positions_world
    a, b = (points[edges.vertex[edges.ends[:, i]]] for i in (0, 1))
    pieces = seen_pieces(place, a, b)
    assert len(pieces) == len(a)


def test_a_body_that_is_seen_without_its_vertices_is_named() -> None:
    floor = thing(plane(), World(scale=(500, 1, 500)), "floor")
    ball = thing(sphere(8, 16), World(), "ball")
    for shown, kind in ((Shown.NORMALS, "normals"), (Shown.TANGENTS, "tangents")):
        _, remarks = marks(scene(floor, ball), shown)
        assert (
            f"No vertex of floor that has a normal is seen: no {kind} are drawn there." in remarks
        )
    assert "No vertex" not in marks(scene(ball), Shown.NORMALS)[1]


@pytest.mark.parametrize("depth", DepthRange)
@pytest.mark.parametrize("is_parallel", [False, True])
def test_no_normal_stands_where_the_near_or_the_far_plane_cuts(
    depth: DepthRange, is_parallel: bool
) -> None:
    window = Window(-1.5, 1.5, -1.0, 1.0) if is_parallel else None
    lens = Lens(near=3.5, far=4.3, aspect=1.5, ortho=window, clip=ClipSpace(depth=depth))
    ball = thing(sphere(24, 48), World())
    found, _ = hedgehog(replace(scene(ball), view=View(eye=(0, 0, 4)), lens=lens))
    (chosen,) = found.chosen
    away = 4 - chosen.points[:, 2]
    assert len(away)
    assert away.min() > 3.5 - 1e-6
    assert away.max() < 4.3 + 1e-6


def test_tangents_of_faces_are_level_as_the_remark_says() -> None:
    found, remarks = hedgehog(scene(thing(sphere(8, 16), World()), shading=Shading.FLAT))
    (chosen,) = found.chosen
    assert np.abs(chosen.tangents[:, 1]).max() < 1e-9
    found.tangents()
    assert "Tangents of faces are level: across the object's y axis." in remarks


def test_axes_that_are_not_drawn_are_not_spoken_of() -> None:
    far = World(translate=(300, 0, 0))
    near = thing(sphere(8, 16), World(), "near")
    _, remarks = marks(scene(near, thing(sphere(8, 16), far, "away")), Shown.AXES)
    assert "thin" not in remarks
    moved = thing(sphere(8, 16), World(translate=(0.5, 0, 0)), "moved")
    _, remarks = marks(scene(moved, thing(sphere(8, 16), far, "away")), Shown.AXES)
    assert "the thin ones those of moved." in remarks


@pytest.mark.parametrize(
    ("aside", "told"),
    [((3, 0, 0), "beside the eye"), ((0, 0, 3), "behind the eye"), ((0, 0, 0), "where the eye is")],
)
def test_a_lamp_that_the_eye_does_not_face_is_told_where_it_is(
    aside: tuple[float, float, float], told: str
) -> None:
    lamp = SceneLight("lamp", LightKind.POINT, position=tuple(np.add((0, 0, 4), aside).tolist()))
    found = replace(scene(thing(box(1), World())), lights=(lamp,), view=View(eye=(0, 0, 4)))
    assert f"The light lamp is {told}." in marks(found, Shown.LIGHTS)[1]


@pytest.mark.parametrize("depth", DepthRange)
def test_the_map_shows_what_the_eye_sees_between_near_and_far(depth: DepthRange) -> None:
    lens = Lens(fov_degrees=40, near=1, far=2.5, aspect=1.5, clip=ClipSpace(depth=depth))
    shown = replace(scene(thing(sphere(24, 48), World())), view=View(eye=(0, 0, 4)), lens=lens)
    canvas, _ = marks(shown, Shown.EYE)
    palette = PALETTES[Theme.LIGHT]
    polygons = [one for one in canvas.marks if isinstance(one, Polygon)]
    (ball,) = (np.array(one.loops[0]) for one in polygons if one.fill == palette.body)
    sight = next(np.array(one.loops[0]) for one in polygons if one.fill == palette.eye)
    radius = np.ptp(ball[:, 1]) / 2
    found = (sight - [ball[:, 0].mean(), (ball[:, 1].min() + ball[:, 1].max()) / 2]) / radius
    slope = 1.5 * np.tan(np.radians(20))
    assert found[:, 1].min() == pytest.approx(4 - 2.5, abs=0.02)
    assert found[:, 1].max() == pytest.approx(4 - 1, abs=0.02)
    assert np.ptp(found[:, 0]) == pytest.approx(2 * 2.5 * slope, abs=0.04)


def test_an_eye_that_looks_down_sees_an_area_of_the_map() -> None:
    shown = replace(scene(thing(sphere(8, 16), World())), view=View(eye=(0, 9, 0.01)))
    canvas, _ = marks(shown, Shown.EYE)
    palette = PALETTES[Theme.LIGHT]
    polygons = [one for one in canvas.marks if isinstance(one, Polygon)]
    sight = next(np.array(one.loops[0]) for one in polygons if one.fill == palette.eye)
    ball = next(np.array(one.loops[0]) for one in polygons if one.fill == palette.body)
    assert (sight.min(axis=0) < ball.min(axis=0)).all()
    assert (sight.max(axis=0) > ball.max(axis=0)).all()


@pytest.mark.parametrize("way", [(1, -1, -1), (-1, -1, -1), (1, 1, -1), (-1, 1, -1)])
@pytest.mark.parametrize("others", [(), (Shown.EYE,)])
def test_a_sun_stands_in_the_corner_that_it_comes_from(
    way: tuple[float, float, float], others: tuple[Shown, ...]
) -> None:
    sun = SceneLight("sun", LightKind.DIRECTIONAL, direction=way)
    shown = replace(scene(thing(sphere(8, 16), World())), lights=(sun,), view=View(eye=(0, 0, 4)))
    canvas, _ = marks(shown, Shown.LIGHTS, *others)
    palette = PALETTES[Theme.LIGHT]
    lit = [one for one in canvas.marks if isinstance(one, Polygon) and one.fill == palette.light]
    places = np.concatenate([np.array(one.loops[0]) for one in lit])
    disc = np.array(lit[0].loops[0]).mean(axis=0)
    assert (disc[0] < canvas.width / 2) == (way[0] > 0)
    assert (disc[1] < canvas.height / 2) == (way[1] < 0)
    assert (places > 0).all()
    assert (places < [canvas.width, canvas.height]).all(), "its arrows are in the picture"
    edges = [one for one in canvas.marks if isinstance(one, Polygon) and one.fill == palette.paper]
    assert not [one for one in edges if Box(*one.loops[0][0], 60, 60).holds(tuple(disc))]
