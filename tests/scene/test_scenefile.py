"""Scene files: what each key makes, and one line for every fault."""

from __future__ import annotations

import re
import subprocess
import sys
from fractions import Fraction
from math import inf
from pathlib import Path

import msgspec
import pytest

from nmatrix.enums import DepthRange, Handedness, Space
from nmatrix.errors import IllegalValueError
from nmatrix.linear.rational import inverse_transpose, linear_part, product, to_floats
from nmatrix.linear.rounding import normalize
from nmatrix.scene.camera import FirstPerson
from nmatrix.scene.geometry import FileGeometry, ShapeGeometry, TangentGeometry
from nmatrix.scene.material import CHECKER, Texture
from nmatrix.scene.scene import Fog, Scene
from nmatrix.scene.toml.file import read_scene
from nmatrix.scene.toml.records import (
    CameraRecord,
    FogRecord,
    Level,
    LightRecord,
    MaterialRecord,
    ObjectRecord,
    RenderRecord,
)
from nmatrix.scene.words import DepthBuffer, LightKind, Pattern, Shape, Wrap
from nmatrix.scene.world import World

SCENES = Path(__file__).parents[2] / "docs" / "scenes"
BALL = '[[object]]\nname = "ball"\nshape = "sphere"\n'


def read(folder: Path, text: str) -> Scene:
    path = folder / "scene.toml"
    path.write_text(text, encoding="utf-8")
    return read_scene(path)


def refusal(folder: Path, text: str) -> str:
    with pytest.raises(IllegalValueError) as caught:
        read(folder, text)
    message = str(caught.value)
    assert "\n" not in message
    assert message.startswith(str(folder / "scene.toml"))
    return message.removeprefix(str(folder / "scene.toml"))


def test_one_shape_is_a_scene_without_a_light_and_without_a_camera(tmp_path: Path) -> None:
    scene = read(tmp_path, BALL)
    (ball,) = scene.objects
    assert ball.geometry == ShapeGeometry(Shape.SPHERE)
    assert not scene.has_camera
    assert scene.lights == ()
    (light,) = read(tmp_path, f"{BALL}[[light]]\n").lights
    assert light.kind is LightKind.DIRECTIONAL
    assert light.direction == normalize((-1, -1, -1))


def test_the_place_of_an_object_is_the_world_of_its_parts(tmp_path: Path) -> None:
    text = BALL + (
        "translate = [1, 2, 3]\nrotate = [10, 20, 30]\norder = 'zyx'\nscale = [1, 2, 0.5]\n"
        "shear = [0.5, 0, 0]\n"
    )
    expected = World((1, 2, 3), (10, 20, 30), None, (1, 2, 0.5), (0.5, 0, 0), "zyx")
    assert read(tmp_path, text).objects[0].world_from_object == expected.world_from_object


def test_one_number_scales_every_axis(tmp_path: Path) -> None:
    matrix = read(tmp_path, BALL + "scale = 3").objects[0].world_from_object
    assert [matrix[i][i] for i in range(4)] == [3, 3, 3, 1]


@pytest.mark.parametrize(
    "rows", ["[[1,0,2],[0,1,0],[0,0,1]]", "[[1,0,2,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]"]
)
def test_a_matrix_is_written_in_rows(tmp_path: Path, rows: str) -> None:
    matrix = read(tmp_path, BALL + f"matrix = {rows}").objects[0].world_from_object
    assert matrix[0] == (1, 0, 2, 0)
    assert matrix[3] == (0, 0, 0, 1)


def test_children_stand_under_their_parents_wherever_the_file_puts_them(tmp_path: Path) -> None:
    text = (
        '[[object]]\nname="hand"\nparent="arm"\nshape="box"\nrotate=[0,0,90]\n'
        '[[object]]\nname="arm"\nparent="shoulder"\nshape="box"\nscale=[1,2,1]\n'
        '[[object]]\nname="shoulder"\ntranslate=[5,0,0]\n'
    )
    hand, arm = read(tmp_path, text).objects
    # T(5, 0, 0) · diag(1, 2, 1) · Rz(90°), by hand
    assert to_floats(hand.world_from_object) == (
        (0, -1, 0, 5),
        (2, 0, 0, 0),
        (0, 0, 1, 0),
        (0, 0, 0, 1),
    )
    assert arm.world_from_object[0][3] == 5
    assert hand.world_from_parent == arm.world_from_object


def test_a_turn_under_a_stretched_parent_is_a_shear_rounded_once(tmp_path: Path) -> None:
    text = (
        '[[object]]\nname="a"\nshape="box"\nscale=[1,2,1]\n'
        '[[object]]\nname="b"\nparent="a"\nshape="box"\nrotate=[0,0,30]\n'
    )
    above, below = read(tmp_path, text).objects
    exact = product(above.world_from_object, World(rotate_degrees=(0, 0, 30)).exact)
    assert to_floats(below.world_from_object) == to_floats(exact)
    normal_matrix = inverse_transpose(linear_part(below.world_from_object))
    assert normal_matrix != linear_part(below.world_from_object)


def test_copies_share_one_geometry_and_the_material(tmp_path: Path) -> None:
    text = BALL + (
        'material = "red"\n[materials.red]\ndiffuse = [1, 0, 0]\n[materials.blue]\n'
        '[[object]]\ncopy_of = "ball"\n'
        '[[object]]\ncopy_of = "object 2"\nmaterial = "blue"\n'
    )
    first, second, third = read(tmp_path, text).objects
    assert first.geometry is second.geometry is third.geometry
    assert (second.material.name, third.material.name) == ("red", "blue")


@pytest.mark.parametrize(
    ("shape", "given", "expected"),
    [
        ("sphere", "12", (12, 24)),
        ("torus", "[8, 10]", (8, 10)),
        ("cone", "9", (9,)),
        ("plane", "[4]", (4,)),
        ("box", "1", (1,)),
    ],
)
def test_tessellation(tmp_path: Path, shape: str, given: str, expected: tuple[int, ...]) -> None:
    scene = read(tmp_path, f'[[object]]\nshape = "{shape}"\ntessellation = {given}')
    geometry = scene.objects[0].geometry
    assert geometry == ShapeGeometry(Shape(shape), expected)
    assert len(geometry.mesh().triangles) > 0


def test_files_are_relative_to_the_scene(tmp_path: Path) -> None:
    (tmp_path / "a.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    (tmp_path / "b.png").write_bytes(b"")
    text = (
        '[[object]]\nmesh = "a.obj"\nmaterial = "m"\n'
        '[materials.m]\ntexture = "b.png"\nnormal_map = "b.png"\n'
    )
    (one,) = read(tmp_path, text).objects
    # a normal map needs tangents
    assert one.geometry == TangentGeometry(FileGeometry(tmp_path / "a.obj"))
    assert one.material.texture == one.material.normal_map == Texture(tmp_path / "b.png")


@pytest.mark.parametrize(
    ("keys", "expected"),
    [
        ('wrap = "clamp"', Texture(Pattern.CHECKER, (Wrap.CLAMP, Wrap.CLAMP))),
        ('wrap = ["mirror", "repeat"]', Texture(Pattern.CHECKER, (Wrap.MIRROR, Wrap.REPEAT))),
        ("uv_scale = 2", Texture(Pattern.CHECKER, scale=(2, 2))),
        (
            "uv_scale = [2, 3]\nuv_rotation = 30\nuv_offset = [0.5, 1]",
            Texture(Pattern.CHECKER, scale=(2, 3), rotation_degrees=30, offset=(0.5, 1)),
        ),
    ],
)
def test_textures_are_wrapped_and_placed(tmp_path: Path, keys: str, expected: Texture) -> None:
    text = BALL + f'material = "m"\n[materials.m]\ntexture = "checker"\n{keys}\n'
    assert read(tmp_path, text).objects[0].material.texture == expected


def test_materials_have_grey_levels_or_colours(tmp_path: Path) -> None:
    text = BALL + (
        'material = "m"\n[materials.m]\ndiffuse = [1, 0, 0]\nspecular = 0.5\nshininess = 0\n'
        'reflection = "toon"\ntexture = "checker"\nopacity = 0\n'
    )
    found = read(tmp_path, text).objects[0].material
    assert found.diffuse == (1, 0, 0)
    assert found.ambient == (0.15, 0, 0)
    assert found.specular == (0.5, 0.5, 0.5)
    assert (found.texture, found.opacity, found.shininess) == (CHECKER, 0, 0)


def test_camera_by_target_and_by_angles(tmp_path: Path) -> None:
    aimed = read(tmp_path, BALL + "[camera]\neye=[1,2,3]\nfar=inf\ndepth='reversed'\nhanded='left'")
    assert aimed.has_camera
    assert aimed.view.eye == (1, 2, 3)
    assert aimed.view.handed is aimed.lens.clip.handed is Handedness.LEFT
    assert (aimed.lens.far, aimed.lens.clip.depth) == (inf, DepthRange.REVERSED)
    turned = read(tmp_path, BALL + "[camera]\nelevation=-45\nangle=30\nconvention='polimi'")
    assert turned.view.angles == FirstPerson(-45, 30, 0)


def test_aspect_is_the_pictures_unless_the_camera_says(tmp_path: Path) -> None:
    free = read(tmp_path, BALL + "[render]\nsize=[640,320]")
    assert (free.lens.aspect, free.has_aspect) == (2.0, False)
    fixed = read(tmp_path, BALL + "[camera]\naspect=1.5\n[render]\nsize=[640,320]")
    assert (fixed.lens.aspect, fixed.has_aspect) == (1.5, True)
    assert free.sized(100, 400).lens.aspect == 0.25
    assert fixed.sized(100, 400).lens.aspect == 1.5


def test_settings(tmp_path: Path) -> None:
    text = BALL + (
        '[render]\nspace="custom"\nspace_matrix=[[2,0,0],[0,1,0],[0,0,1]]\nsamples=64\n'
        "background=[0,0,1]\nfog={end=9}\ngamma=true\ndepth_bits=16\nshadow_map=64\n"
    )
    found = read(tmp_path, text).settings
    assert found.space is Space.CUSTOM
    assert found.space_matrix is not None
    assert found.space_matrix[0][0] == Fraction(2)
    assert found.fog == Fog((0, 0, 1), 0, 9)
    assert (found.samples, found.depth, found.shadow_map) == (64, DepthBuffer.UNORM16, 64)


def test_lights_of_every_kind(tmp_path: Path) -> None:
    text = BALL + (
        '[[light]]\nkind="ambient"\ncolor=0.2\n'
        '[[light]]\nname="sun"\nangles=[-90,0]\n'
        '[[light]]\nkind="point"\nposition=[1,2,3]\nattenuation=[0,0,1]\nrange=inf\n'
        '[[light]]\nkind="spot"\nfixed_to="eye"\ncone=[0,90]\nshadows=true\n'
        '[[light]]\nkind="point"\nfixed_to="ball"\nrange=4\n'
    )
    ambient, sun, point, spot, carried = read(tmp_path, text).lights
    assert ambient.color == (0.2, 0.2, 0.2)
    assert sun.direction == (0, -1, 0)
    assert (point.position, point.range, point.fades) == ((1, 2, 3), inf, True)
    assert (spot.direction, spot.fixed_to, spot.cone_degrees) == ((0, 0, -1), "eye", (0, 90))
    assert (carried.position, carried.fixed_to, carried.range) == ((0, 0, 0), "ball", 4)


MATERIAL = "[materials.m]\n"
LAMP = '[[light]]\nname = "lamp"\n'

FAULTS = [
    ("scal = 2", '[[object]] 1 "ball": scal: no such key is known here; did you mean scale?'),
    ("scale = [1, 2]", "scale (1 2): …3…2; mend scale: stretch, by three"),
    ('scale = "2"', 'scale ("2"): …; mend scale: stretch'),
    ("scale = true", "scale (true): …; mend scale"),
    ("scale = nan", "scale (nan): it is not a finite number"),
    ("translate = [0, inf, 0]", "translate (0 inf 0): it is not a finite number"),
    ('rotate = [0, 0, "x"]', 'rotate (0 0 "x"): it is not a number; write it like'),
    ("rotate = [[0], 0, 0]", "rotate ([0] 0 0): …; mend rotate"),
    ("rotate = {x = 1}", "rotate (a table): …; mend rotate"),
    ("scale = 1e999", "number ('1e999'): no float64 is near it"),
    ("scale = 1e-999", "number ('1e-999'): no float64 is near it"),
    ("scale = 0x" + "f" * 300, "scale (a huge integer): …; mend scale"),
    ('order = "XXY"', "its place: order (XXY): it must hold each axis once"),
    ('order = "ZYX"\nconvention = "polimi"', "the course's library fixes the order"),
    ("quaternion = [0, 0, 0, 0]", "quaternion (0 0 0 0): it has no direction"),
    ("quaternion = [0, 0, 0, 1]\nrotate = [0, 0, 0]", "quaternion with rotate: both are"),
    ("matrix = [[1, 0], [0, 1]]", "matrix ([1 0] [0 1]): it is three rows of three numbers"),
    ("matrix = [[1,0,0,0],[0,1,0,0],[0,0,1,0],[5,0,0,1]]", "matrix (last row 5 0 0 1)"),
    ("matrix = [[1,0,0],[0,1,0],[0,0,1]]\nscale = 2", "matrix with scale: the matrix is"),
    ("tessellation = 2001", "tessellation (2001): …2000; mend tessellation: rings"),
    ("tessellation = 2", "tessellation (2): a sphere needs 3 at least"),
    ("tessellation = 2.5", "tessellation (2.5): …; mend tessellation"),
    ('shape = "ball"', "Cannot overwrite a value"),
    ('mesh = "a.obj"', "mesh with shape: a mesh has its own triangles"),
    ('copy_of = "ball"', "copy_of with shape: a copy shares them"),
    ('parent = "bal"', 'parent ("bal"): no object has this name; did you mean ball?'),
    ('parent = "ball"', 'parent ("ball"): it is its own ancestor: the hierarchy is a cycle'),
    ('material = "gold"', 'material ("gold"): no material has this name; there are none'),
    (BALL, '[[object]] 2 "ball": name ("ball"): another object has it already'),
    ('[[object]]\nname = "eye"', 'name ("eye"): lights are fixed to eye by this word'),
    ('[[object]]\nshape = "spher"', 'shape ("spher"): …; did you mean sphere?'),
    ("[[object]]\nshape = 3", "shape (3): …; there are sphere, torus, box, plane"),
    ('[[object]]\nmesh = "a.obj"', 'mesh ("a.obj"): there is no such file'),
    (f'[[object]]\nmesh = "{"é" * 200}"', "there is no such file; names are relative to the"),
    ('[[object]]\nmesh = "scene.toml"', "meshes are .obj, .ply or .stl"),
    ('[[object]]\ncopy_of = "bell"', 'copy_of ("bell"): no drawn object has this name; did you'),
    (
        '[[object]]\nname = "a"\ncopy_of = "b"\n[[object]]\nname = "b"\ncopy_of = "a"',
        'copy_of ("b"): it is a copy of itself',
    ),
    (
        '[[object]]\nname = "a"\nparent = "b"\n[[object]]\nname = "b"\nparent = "a"',
        'parent ("b"): it is its own ancestor',
    ),
    (
        'scale = 1e200\n[[object]]\nparent = "ball"\nshape = "box"\nscale = 1e200',
        "[[object]] 2: its place: a result near 1e400: it is beyond the largest float64",
    ),
    (MATERIAL + "opacity = 1.5", "[materials.m]: opacity (1.5): …1.0; mend opacity: 1 hides"),
    (MATERIAL + "shininess = -1", "shininess (-1): …0.0; mend shininess"),
    (MATERIAL + "diffuse = [1, 2, 0]", "diffuse (1 2 0): …1.0; mend diffuse: light"),
    (MATERIAL + "diffuse = [1, 0]", "diffuse (1 0): …3; mend diffuse"),
    (MATERIAL + 'texture = "chequer"', 'texture ("chequer"): there is no such file'),
    (MATERIAL + 'normal_map = "n.png"', 'normal_map ("n.png"): there is no such file'),
    (MATERIAL + 'reflection = "phon"', 'reflection ("phon"): …; did you mean phong?'),
    (MATERIAL + 'wrap = "clamp"', 'wrap ("clamp"): there is no image to place; add texture'),
    (MATERIAL + "uv_scale = 2", "uv_scale (2): there is no image to place; add texture"),
    (MATERIAL + 'texture = "checker"\nwrap = "tile"', 'wrap ("tile"): …; there are repeat, clamp'),
    (MATERIAL + "toon_steps = 0", "toon_steps (0): …1; mend toon_steps"),
    ("[materials]\nm = 3", "[materials.m] (3): it is not a table"),
    (LAMP + "range = -3", '[[light]] 1 "lamp": range (-3): …0.0; mend range'),
    (LAMP + "intensity = -1", "intensity (-1): …0.0; mend intensity"),
    (LAMP + 'kind = "sport"', 'kind ("sport"): …; did you mean spot?'),
    (LAMP + "range = 3", "light of kind directional has no range; kind point or spot has"),
    (LAMP + 'kind = "point"', "position: light of kind point is somewhere; add position"),
    (LAMP + 'kind = "spot"\nposition = [0, 0, 0]', "direction: light of kind spot points"),
    (LAMP + 'kind = "ambient"\nshadows = true', "light of kind ambient has no shadows"),
    (LAMP + "direction = [0, 0, 0]", "direction (0 0 0): light that travels nowhere"),
    (LAMP + "direction = [0, 0, 1]\nangles = [0, 0]", "direction with angles: both are"),
    (LAMP + 'fixed_to = "bal"', "an object that is drawn; did you mean ball?"),
    (LAMP + LAMP, 'name ("lamp"): another light has it already'),
    (
        LAMP + 'kind = "spot"\nposition=[1,1,1]\ndirection=[0,0,1]\ncone = [40, 30]',
        "cone (40 30): it is the inner and the outer half angle",
    ),
    (
        LAMP + 'kind = "point"\nposition=[1,1,1]\nattenuation = [0, 0, 0]',
        "attenuation (0 0 0): c, l and q are all zero",
    ),
    ("[camera]\nfov = 180", "[camera]: fov (180): …180.0; mend fov: vertical"),
    ("[camera]\naspect = 0", "aspect (0): …0.0; mend aspect"),
    ("[camera]\nnear = 0", "near (0): a perspective view needs it above 0"),
    ("[camera]\nnear = inf", "near (inf): it is not a finite number"),
    ("[camera]\nfar = 0.05", "far (0.05): near is 0.1 and far is 0.05"),
    ("[camera]\neye = [0, 0, 0]", "the camera: eye and target (0 0 0): they coincide"),
    ("[camera]\nup = [0, 0, 0]", "the camera: up (0 0 0): it has no direction"),
    ("[camera]\nangle = 3\ntarget = [0, 0, 0]", "angle with target: both say where to look"),
    ('[camera]\nangle = 3\nhanded = "left"', "angle with handed: the angles are for"),
    ('[camera]\nangle = 3\napi = "direct3d"', "angle with api: the angles are for"),
    ('[camera]\nconvention = "polimi"', 'convention ("polimi"): it is about elevation'),
    ("[camera]\northo = [1, 1, 0, 2]", "left and right (1 and 1): they coincide"),
    ("[camera]\northo = [0, 1, 0, 2]\nfov = 50", "ortho with fov: both shape the view"),
    ("[render]\nsize = [0, 10]", "[render]: size (0 10): …1; mend size: width and"),
    ("[render]\nsize = [10, 8193]", "size (10 8193): …8192; mend size"),
    ("[render]\nsamples = 5", "samples (5): …; there are 1, 4, 16, 64"),
    ("[render]\ndepth_bits = 32", "depth_bits (32): …; there are 16, 24, float32, full"),
    ("[render]\nfog = {start = 3}", "[render] fog: end: it is missing; add end: all is fog from"),
    ("[render]\nfog = {end = 3, colr = 1}", "[render] fog: colr: no such key is known here; did"),
    ("[render]\nfog = {end = 3, start = 4}", "[render] fog: start (4): it is not before the end"),
    ("[render]\nfog = 3", "fog (3): …; mend fog: a table with start"),
    ('[render]\nspace = "custom"', 'space ("custom"): it needs its matrix'),
    ("[render]\nspace_matrix = [[1,0,0],[0,1,0],[0,0,1]]", "only custom space takes a matrix"),
    ("[lights]\na = 1", "lights: a scene file has no such table; did you mean light?"),
    ("[light]\na = 1", "light (a table): it is written [[light]]"),
]


@pytest.mark.parametrize(("addition", "words"), FAULTS, ids=[words for _, words in FAULTS])
def test_every_fault_has_one_line(tmp_path: Path, addition: str, words: str) -> None:
    """What msgspec says of a value stands at the …; the words may change, its numbers may not."""
    message = refusal(tmp_path, BALL + addition)
    assert re.search(".*".join(map(re.escape, words.split("…"))), message), message


def test_what_the_checker_says_of_a_value_stands_in_the_message(tmp_path: Path) -> None:
    message = refusal(tmp_path, BALL + MATERIAL + "opacity = 1.5")
    with pytest.raises(msgspec.ValidationError) as caught:
        msgspec.convert(1.5, Level)
    assert str(caught.value).replace("`", "")[1:] in message
    assert "`" not in message
    assert "null" not in refusal(tmp_path, BALL + "scale = '2'")


TABLES = {
    "[[object]]": ObjectRecord,
    "[[light]]": LightRecord,
    "[camera]": CameraRecord,
    "[materials.m]": MaterialRecord,
    "[render]": RenderRecord,
    "[render.fog]": FogRecord,
}
ODD = [
    "1979-05-27",
    "{a = 1}",
    "[[[]]]",
    "[]",
    "-1e300",
    "0x" + "f" * 2000,
    "[true]",
    '"\\n"',
    "nan",
]


@pytest.mark.parametrize("header", TABLES)
@pytest.mark.parametrize("value", ODD, ids=[value[:10] for value in ODD])
def test_odd_values_of_every_key_are_taken_or_refused_in_one_line(
    tmp_path: Path, header: str, value: str
) -> None:
    """A date is no value of any key, so each key must be named with it."""
    for key in TABLES[header].__struct_fields__:
        try:
            read(tmp_path, f"{BALL}{header}\n{key} = {value}")
        except IllegalValueError as error:
            message = str(error)
            assert message.startswith(f"{tmp_path / 'scene.toml'}, {header[:5]}")
            assert "\n" not in message
            assert "`" not in message
            assert len(message) < 400
            if value == ODD[0]:
                assert f"{key} (1979-05-27): expected" in message
        else:
            assert value != ODD[0]


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "it is empty"),
        (b" \n\t", "it is empty"),
        (b"\xff\xfe[\x00", "it is not UTF-8 text"),
        (b"x = '\xe9'", "it is not UTF-8 text"),
        (b"[[object]", "it is not TOML"),
        (b"a = " + b"[" * 5000, "it is nested too deeply"),
        (b"a = " + b"9" * 5000, "it is not TOML"),
        (b"#" * 4_000_001, "it is larger than"),
        (b"[camera]", "the scene has none"),
        (b"object = 3", "it is written [[object]]"),
        (b"object = [3]", "it is not a table"),
        (b"[[object]]\nname = 'group'", "it draws nothing"),
    ],
    ids=lambda value: repr(value)[:30],
)
def test_what_is_no_scene_is_refused(tmp_path: Path, content: bytes, words: str) -> None:
    path = tmp_path / "scene.toml"
    path.write_bytes(content)
    with pytest.raises(IllegalValueError) as caught:
        read_scene(path)
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_file_that_is_missing_is_named(tmp_path: Path) -> None:
    with pytest.raises(IllegalValueError, match="there is no such file"):
        read_scene(tmp_path / "none.toml")


def test_a_byte_order_mark_of_utf8_is_no_fault(tmp_path: Path) -> None:
    path = tmp_path / "scene.toml"
    path.write_bytes(b"\xef\xbb\xbf" + BALL.encode())
    assert read_scene(path).objects[0].name == "ball"


def test_names_cannot_break_the_line(tmp_path: Path) -> None:
    message = refusal(tmp_path, '[[object]]\nname = "a\\nb"\nscal = 1')
    assert r"'a\nb'" in message


@pytest.mark.parametrize("path", sorted(SCENES.glob("*.toml")), ids=lambda path: path.stem)
def test_every_example_reads_and_says_what_it_shows(path: Path) -> None:
    assert path.read_text(encoding="utf-8").startswith("# ")
    assert read_scene(path).objects


@pytest.mark.parametrize("name", ["classroom", "stretched", "hierarchy", "glass", "everything"])
def test_what_stands_on_the_floor_of_an_example_touches_it_and_pokes_not_through(name: str) -> None:
    lowest = []
    for one in read_scene(SCENES / f"{name}.toml").objects:
        row = [float(x) for x in one.world_from_object[1]]
        lowest.append(float((one.geometry.mesh().positions @ row[:3] + row[3]).min()))
    assert min(lowest) > -0.01
    assert sum(low < 0.02 for low in lowest) >= 2


def test_the_robots_hand_is_sheared_by_its_forearm() -> None:
    hand = read_scene(SCENES / "hierarchy.toml").objects[-1]
    x, y = (tuple(row[i] for row in hand.world_from_object[:3]) for i in (0, 1))
    along = sum(a * b for a, b in zip(x, y, strict=True))
    assert abs(float(along)) > 0.01


def test_reading_needs_no_numpy() -> None:
    code = (
        "import sys; from pathlib import Path; from nmatrix.scene.toml.file import read_scene\n"
        f"read_scene(Path({str(SCENES / 'everything.toml')!r}))\n"
        "sys.exit('numpy' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
