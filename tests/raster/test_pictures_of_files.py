"""Pictures of files that say little: their colours, their background, their camera, and remarks."""

from __future__ import annotations

import json
from base64 import b64encode
from dataclasses import replace
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from nmatrix.answers.render import PictureChoices, scene_frame
from nmatrix.answers.render import render as report_of
from nmatrix.enums import Effect, Shading
from nmatrix.linear.rational import identity
from nmatrix.raster.drawn_scene import DrawnScene, drawn_scene
from nmatrix.raster.loaded_scene import loaded
from nmatrix.raster.proofs.frames import PictureFrame, around
from nmatrix.raster.proofs.plain import picture
from nmatrix.scene import images
from nmatrix.scene.camera import View
from nmatrix.scene.geometry import LoadedGeometry
from nmatrix.scene.images import read_image
from nmatrix.scene.material import Material, Texture
from nmatrix.scene.meshes.mesh import Mesh
from nmatrix.scene.meshes.shapes import box, sphere, torus
from nmatrix.scene.open import scene_of
from nmatrix.scene.scene import Scene, SceneObject

APART = 20  # levels
UNLIT = {"extensions": {"KHR_materials_unlit": {}}}


def image(texels: Any) -> str:
    """A data URI of a PNG with these texels."""
    file = BytesIO()
    Image.fromarray(np.asarray(texels, np.uint8)).save(file, "PNG")
    return f"data:image/png;base64,{b64encode(file.getvalue()).decode()}"


def gltf(
    folder: Path,
    mesh: Mesh,
    material: dict[str, Any] | None = None,
    images: tuple[str, ...] = (),
    uv_set: int = 0,
    colours: np.ndarray | None = None,
    **document: Any,
) -> Scene:
    """A mesh as a .gltf file, in which textures are numbered as the images are."""
    arrays = {"POSITION": mesh.positions, "NORMAL": mesh.normals}
    if mesh.uv is not None:
        arrays[f"TEXCOORD_{uv_set}"] = mesh.uv * (1, -1) + (0, 1)
        if uv_set:
            arrays["TEXCOORD_0"] = np.zeros_like(mesh.uv)
    if colours is not None:
        arrays["COLOR_0"] = colours
    parts = [one.astype("<f4").tobytes() for one in arrays.values()]
    parts.append(mesh.triangles.astype("<u4").tobytes())
    starts = np.cumsum([0, *map(len, parts)]).tolist()
    accessors: list[dict[str, Any]] = [
        {"componentType": 5126, "count": len(one), "type": f"VEC{one.shape[1]}"}
        for one in arrays.values()
    ]
    low, high = mesh.box
    accessors[0] |= {"min": low.tolist(), "max": high.tolist()}
    accessors.append({"componentType": 5125, "count": mesh.triangles.size, "type": "SCALAR"})
    primitive: dict[str, Any] = {
        "attributes": {name: i for i, name in enumerate(arrays)},
        "indices": len(arrays),
    }
    if material is not None:
        primitive["material"] = 0
    content = b"".join(parts)
    uri = f"data:application/octet-stream;base64,{b64encode(content).decode()}"
    whole = {
        "asset": {"version": "2.0"},
        "nodes": [{"mesh": 0, "name": "thing"}],
        "meshes": [{"primitives": [primitive]}],
        "materials": [material or {}],
        "accessors": [one | {"bufferView": i} for i, one in enumerate(accessors)],
        "bufferViews": [
            {"buffer": 0, "byteOffset": start, "byteLength": len(part)}
            for start, part in zip(starts, parts, strict=False)
        ],
        "buffers": [{"byteLength": len(content), "uri": uri}],
        "images": [{"uri": one} for one in images],
        "textures": [{"source": i} for i in range(len(images))],
        **document,
    }
    path = folder / "thing.gltf"
    path.write_text(json.dumps(whole))
    return scene_of(path)


def base(*factor: float, **more: Any) -> dict[str, Any]:
    red, green, blue, alpha = factor if len(factor) == 4 else (*factor, 1.0)
    return {"pbrMetallicRoughness": {"baseColorFactor": [red, green, blue, alpha]}, **more}


def textured(**more: Any) -> dict[str, Any]:
    return {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}, **more}


def quad(*axes: int, back: bool = False) -> Mesh:
    """The unit square across two axes, its front towards the third one or away from it."""
    corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]], float)
    positions = np.zeros((4, 3))
    positions[:, axes] = corners
    triangles = np.array([[0, 1, 2], [0, 2, 3]])
    if back:
        triangles = triangles[:, ::-1]
    a, b, c = positions[triangles[0]]
    normal = np.cross(b - a, c - a)
    normals = np.tile(normal / np.linalg.norm(normal), (4, 1))
    return Mesh(positions, normals, triangles, uv=(corners + 1) / 2)


def shown(scene: Scene, size: int = 120) -> DrawnScene:
    return drawn_scene(scene.sized(size, size), keeps_depth=True)


def covered(drawn: DrawnScene) -> np.ndarray:
    """The levels of the pixels that are covered as a whole."""
    depth = drawn.rendered.depth
    assert depth is not None
    return drawn.levels[depth.coverage == 1.0].astype(int)


def remarks(scene: Scene) -> tuple[str, ...]:
    return picture(scene.sized(120, 120), "thing").remarks


# --- colours


@pytest.mark.parametrize("byte", [0, 1, 10, 11, 77, 128, 200, 254, 255])
def test_an_unlit_texture_comes_out_with_its_own_bytes(tmp_path: Path, byte: int) -> None:
    texels = np.full((2, 2, 3), (byte, 255 - byte, byte), np.uint8)
    found = covered(shown(gltf(tmp_path, quad(0, 1), textured(**UNLIT), (image(texels),))))
    assert np.abs(found - (byte, 255 - byte, byte)).max() <= 1


@pytest.mark.parametrize("factor", [0.0, 0.002, 0.0031308, 0.05, 0.2, 0.5, 1.0])
def test_a_factor_is_linear_light_written_as_srgb(tmp_path: Path, factor: float) -> None:
    found = covered(shown(gltf(tmp_path, quad(0, 1), base(factor, 1, factor, **UNLIT))))
    level = 12.92 * factor if factor <= 0.0031308 else 1.055 * factor ** (1 / 2.4) - 0.055
    assert np.abs(found - (255 * level, 255, 255 * level)).max() <= 0.5 + 1e-9
    if factor == 0.5:
        assert found[0].tolist() == [188, 255, 188]


def test_unlit_takes_vertex_colours_and_asks_no_lamp(tmp_path: Path) -> None:
    colours = np.tile([0.5, 1.0, 0.25, 1.0], (4, 1))
    drawn = shown(gltf(tmp_path, quad(0, 1), base(0.5, 0.5, 1, **UNLIT), colours=colours))
    (body,) = drawn.plan.bodies
    assert {Effect.UNLIT, Effect.VERTEX_COLOURS} <= body.effects
    assert not body.lights
    light = np.array([0.25, 0.5, 0.25])
    assert np.abs(covered(drawn) - 255 * (1.055 * light ** (1 / 2.4) - 0.055)).max() <= 0.5 + 1e-9


def test_emission_is_added_to_what_light_makes_and_no_lamp_is_asked(tmp_path: Path) -> None:
    """A black surface shines by itself, by factor, texture and strength."""
    half = np.full((2, 2, 3), 188, np.uint8)  # half of the light
    strength = {"extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 0.5}}}
    glowing = {"emissiveFactor": [1, 0, 0.5], "emissiveTexture": {"index": 0}, **strength}
    found = covered(shown(gltf(tmp_path, quad(0, 1), base(0, 0, 0, **glowing), (image(half),))))
    light = np.array([0.25, 0.0, 0.125])
    assert np.abs(found - 255 * np.maximum(1.055 * light ** (1 / 2.4) - 0.055, 0)).max() <= 1
    lit, more = (
        covered(shown(gltf(tmp_path, quad(0, 1), base(0.2, 0.2, 0.2, emissiveFactor=[e] * 3))))
        for e in (0.0, 0.25)
    )
    linear = [
        np.where(x <= 10, x / 3294.6, ((x / 255 + 0.055) / 1.055) ** 2.4) for x in (lit, more)
    ]
    assert np.abs(linear[1] - linear[0] - 0.25).max() < 0.01


def test_a_mask_cuts_holes_into_depth_and_picture(tmp_path: Path) -> None:
    """Half of the image is clear: the sheet ends at its middle."""
    texels = np.zeros((1, 64, 4), np.uint8)
    texels[..., :3], texels[:, :32, 3] = 255, 255
    cut = {"alphaMode": "MASK", "alphaCutoff": 0.5, **UNLIT}
    half = shown(gltf(tmp_path, quad(0, 1), textured(**cut), (image(texels),)))
    whole = shown(gltf(tmp_path, quad(0, 1), textured(**UNLIT), (image(texels),)))
    parts = [float(one.rendered.depth.coverage.sum()) for one in (half, whole)]
    assert 0.35 < parts[0] / parts[1] < 0.45  # what is left is the farther half
    assert half.rendered.work.fragments < 0.5 * whole.rendered.work.fragments


@pytest.mark.parametrize(("cutoff", "is_seen"), [(0.2, True), (0.3, False)])
def test_the_mask_compares_factor_texture_and_vertices(
    tmp_path: Path, cutoff: float, *, is_seen: bool
) -> None:
    texels = np.full((1, 1, 4), (255, 255, 255, 128), np.uint8)
    material = {
        "pbrMetallicRoughness": {
            "baseColorFactor": [1, 1, 1, 0.9],
            "baseColorTexture": {"index": 0},
        },
        "alphaMode": "MASK",
        "alphaCutoff": cutoff,
    }
    colours = np.tile([1, 1, 1, 0.6], (4, 1))
    scene = gltf(tmp_path, quad(0, 1), material, (image(texels),), colours=colours)
    assert bool(shown(scene).rendered.work.fragments) is is_seen  # 0.9 · 0.502 · 0.6 = 0.271
    if not is_seen:
        assert "Nothing can be seen: thing is all holes where it is in the picture." in (
            remarks(scene)
        )


def test_holes_cast_no_shadow(tmp_path: Path) -> None:
    """Under a lid of holes the floor is as bright as without a lid."""
    texels = np.zeros((2, 2, 4), np.uint8)
    Image.fromarray(texels).save(tmp_path / "clear.png")
    lid = '[[object]]\nshape = "plane"\ntranslate = [0, 1, 0]\nmaterial = "lid"\n'
    rest = (
        '[[object]]\nname = "floor"\nshape = "plane"\nscale = 3\n'
        "[[light]]\ndirection = [0, -1, 0]\nshadows = true\n"
        "[camera]\neye = [0, 6, 4]\n[render]\nsize = [64, 64]\n"
        '[materials.lid]\ntexture = "clear.png"\n'
    )
    levels = []
    for text in (rest, lid + rest, lid + rest + "alpha_cutoff = 0.5\n"):
        (tmp_path / "a.toml").write_text(text)
        levels.append(drawn_scene(scene_of(tmp_path / "a.toml")).levels.astype(int))
    without, closed, holes = levels
    assert np.abs(without - closed).max() > 100
    assert np.abs(without - holes).max() == 0


def test_blending_takes_the_alpha_of_texture_and_vertices(tmp_path: Path) -> None:
    texels = np.full((1, 1, 4), (0, 0, 0, 51), np.uint8)  # a fifth
    glass = textured(alphaMode="BLEND", doubleSided=True, **UNLIT)
    colours = np.tile([1, 1, 1, 0.5], (4, 1))
    scene = gltf(tmp_path, quad(0, 1), glass, (image(texels),), colours=colours)
    drawn = shown(scene)
    ground = np.array(drawn.loaded.settings.background)
    middle = drawn.rendered.rgb[60, 60]
    light = 0.9 * ground
    assert np.abs(middle - (1.055 * light ** (1 / 2.4) - 0.055)).max() < 1e-3


def test_an_opacity_alone_asks_neither_texture_nor_vertices(tmp_path: Path) -> None:
    """Scene files say one opacity; the alpha of an image counts where holes are asked for."""
    levels = []
    for alpha in (255, 40):
        texels = np.full((2, 2, 4), (200, 100, 50, alpha), np.uint8)
        Image.fromarray(texels).save(tmp_path / "a.png")
        (tmp_path / "a.toml").write_text(
            '[[object]]\nshape = "plane"\nmaterial = "m"\n[render]\nsize = [40, 40]\n'
            '[materials.m]\ntexture = "a.png"\nopacity = 0.5\n'
        )
        read_image.cache_clear()
        levels.append(drawn_scene(scene_of(tmp_path / "a.toml")).levels)
    assert (levels[0] == levels[1]).all()


def test_blending_without_any_alpha_is_opaque(tmp_path: Path) -> None:
    solid = image(np.full((1, 1, 3), 9, np.uint8))
    drawn = shown(gltf(tmp_path, quad(0, 1), textured(alphaMode="BLEND"), (solid,)))
    assert Effect.TRANSPARENCY not in drawn.plan.effects


def test_a_second_set_of_coordinates_is_read_where_the_base_colour_asks_for_it(
    tmp_path: Path,
) -> None:
    texels = np.zeros((1, 2, 3), np.uint8)
    texels[0, 1] = 255
    reference = {"index": 0, "texCoord": 1}
    material = {"pbrMetallicRoughness": {"baseColorTexture": reference}, **UNLIT}
    found = covered(shown(gltf(tmp_path, quad(0, 1), material, (image(texels),), uv_set=1)))
    assert found.min() < 40
    assert found.max() > 215, "by the first set all were one texel"


def test_the_diffuse_part_of_the_older_model_is_the_base_colour(tmp_path: Path) -> None:
    glossy = {"KHR_materials_pbrSpecularGlossiness": {"diffuseFactor": [0.5, 0, 0, 1]}}
    material = {"extensions": {**glossy, "KHR_materials_unlit": {}}}
    assert covered(shown(gltf(tmp_path, quad(0, 1), material)))[0].tolist() == [188, 0, 0]


def obj(folder: Path, material: str) -> Scene:
    """A square as an .obj file whose material is this text of an .mtl file."""
    (folder / "a.mtl").write_text(f"newmtl m\n{material}\n")
    (folder / "a.obj").write_text(
        "mtllib a.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 1\n"
        "vn 0.27 0.8 0.53\nusemtl m\nf 1/1/1 2/2/1 3/2/1 4/1/1\n"
    )
    return scene_of(folder / "a.obj")


def test_materials_of_obj_files_shine_are_unlit_and_are_not_burnt_out(tmp_path: Path) -> None:
    assert covered(shown(obj(tmp_path, "Kd 0.6 0.2 1\nillum 0"))).max(axis=0).tolist() == [
        153,
        51,
        255,
    ]
    white = covered(shown(obj(tmp_path, "Kd 1 1 1\nillum 1")))
    assert 250 <= white.max() <= 255, "daylight falls on it straight"
    light = shown(obj(tmp_path, "Kd 1 1 1\nillum 1")).rendered.image[60, 60]
    assert 0.98 < light.max() <= 1.0
    dark, glowing = (
        covered(shown(obj(tmp_path, f"Kd 0.1 0.1 0.1\nillum 1\nKe {level} 0 0")))[0, 0]
        for level in (0, 0.5)
    )
    assert abs(int(glowing) - int(dark) - 127.5) <= 1


def test_an_image_of_an_obj_file_that_is_not_read_costs_only_itself(tmp_path: Path) -> None:
    (tmp_path / "a.png").write_bytes(b"no image")
    told = remarks(obj(tmp_path, "Kd 1 1 1\nmap_Kd a.png"))
    assert "An image is not drawn: a.png: it is no image." in told


# --- images that are not read


def bomb() -> str:
    file = BytesIO()
    Image.new("1", (8200, 8200)).save(file, "PNG")
    return f"data:image/png;base64,{b64encode(file.getvalue()).decode()}"


@pytest.mark.parametrize(
    ("content", "why"),
    [
        ("data:;base64,q0tUWCAyMLsNChoK", "it is KTX2, which is not read"),
        ("data:;base64,aGVsbG8=", "it is no image"),
        (bomb(), "it has 8200 × 8200 pixels, more than 8192 × 8192 are not read"),
    ],
)
def test_an_image_that_is_not_read_is_named_and_the_rest_is_drawn(
    tmp_path: Path, content: str, why: str
) -> None:
    scene = gltf(tmp_path, quad(0, 1), textured(), (content,))
    proof = picture(scene.sized(80, 80), "thing")
    told = f"An image is not drawn: thing.gltf (image 0): {why}."
    assert told in report_of(proof).remarks
    assert proof.work.fragments > 0


def test_images_of_a_scene_have_room_for_so_many_pixels_and_are_tried_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    read = []
    image = images.read_image
    monkeypatch.setattr(images, "read_image", lambda source: read.append(source) or image(source))
    materials = []
    for name in ("a", "broken", "b", "c"):
        file = tmp_path / f"{name}.png"
        Image.new("RGB", (4, 4)).save(file)
        if name == "broken":
            file.write_bytes(file.read_bytes()[:45])
        materials += [Material(name, texture=Texture(file, is_optional=True)) for _ in range(3)]
    room = images.Room(left=40)
    told = [images.with_readable_images(one, room)[1] for one in materials]
    broken = "An image is not drawn: broken.png: its pixels are damaged or cut short."
    assert told[:9] == [[]] * 3 + [[broken]] * 3 + [[]] * 3
    full = "with it the scene has more pixels of images than can be held"
    assert told[9:] == [[f"An image is not drawn: c.png: {full}."]] * 3
    assert len(read) == 3


def test_an_image_beside_a_scene_file_that_is_not_read_is_an_error(tmp_path: Path) -> None:
    (tmp_path / "a.png").write_bytes(b"hello")
    (tmp_path / "a.toml").write_text(
        '[[object]]\nshape = "plane"\nmaterial = "m"\n[materials.m]\ntexture = "a.png"\n'
    )
    with pytest.raises(ValueError, match=r"a\.png: it is no image; check it"):
        drawn_scene(scene_of(tmp_path / "a.toml"))


# --- light and background


def test_a_white_ball_has_all_levels_and_is_not_burnt_out(tmp_path: Path) -> None:
    found = covered(shown(gltf(tmp_path, sphere(60, 120)), 256))[:, 0]
    assert found.max() >= 253
    assert found.min() <= 75
    assert (found == 255).mean() < 0.015
    assert len(np.unique(found)) > 150


def test_the_sides_of_a_white_box_differ_by_fifty_levels(tmp_path: Path) -> None:
    found = covered(shown(gltf(tmp_path, box())))[:, 0]
    sides, counts = np.unique(found, return_counts=True)
    largest = np.sort(sides[np.argsort(counts)[-3:]])
    assert np.diff(largest).min() >= 50


LEVELS = [0.0, 0.01, 0.0103, 0.03, 0.1, 0.214, 0.5, 0.8, 1.0]


@pytest.mark.parametrize("shape", [sphere(24, 48), torus(), box()])
@pytest.mark.parametrize("level", LEVELS)
@pytest.mark.parametrize("is_lit", [True, False])
def test_what_is_drawn_stands_out_from_the_background(
    tmp_path: Path, shape: Mesh, level: float, *, is_lit: bool
) -> None:
    material = base(level, level, level, **({} if is_lit else UNLIT))
    scene = gltf(tmp_path, shape, material)
    drawn = shown(scene)
    ground = drawn.levels[0, 0].astype(int)
    apart = np.abs(covered(drawn) - ground).max(axis=1)
    assert (apart >= APART).mean() > 0.98
    assert not [one for one in remarks(scene) if "from the background" in one]


@pytest.mark.parametrize("level", [255, 250, 236, 128, 20, 0])
def test_an_image_stands_out_though_only_drawing_tells_its_colour(
    tmp_path: Path, level: int
) -> None:
    texels = np.full((2, 2, 3), level, np.uint8)
    drawn = shown(gltf(tmp_path, quad(0, 1), textured(**UNLIT), (image(texels),)))
    assert np.abs(covered(drawn) - drawn.levels[0, 0].astype(int)).min() >= APART


def test_what_no_background_parts_is_told(tmp_path: Path) -> None:
    """Half of it is white and half nearly black, as the two backgrounds are."""
    texels = np.zeros((1, 2, 3), np.uint8)
    texels[0, 0], texels[0, 1] = 255, 26
    nearest = [{"magFilter": 9728}]
    scene = gltf(
        tmp_path,
        quad(0, 1),
        textured(**UNLIT),
        (image(texels),),
        samplers=nearest,
        textures=[{"source": 0, "sampler": 0}],
    )
    (told,) = [one for one in remarks(scene) if "from the background" in one]
    assert "fewer than 20 levels" in told
    assert 35 < float(told.split()[1]) < 65


def test_all_frames_of_a_turn_have_one_background(tmp_path: Path) -> None:
    """A white front and a black back: each by itself would have a background of its own."""
    front, back = quad(0, 1), quad(0, 1, back=True)
    both = Mesh(
        np.concatenate([front.positions, back.positions - (0, 0, 0.1)]),
        np.concatenate([front.normals, back.normals]),
        np.concatenate([front.triangles, back.triangles + 4]),
    )
    colours = np.repeat([[1, 1, 1, 1], [0, 0, 0, 1]], 4, axis=0).astype(float)
    scene = gltf(tmp_path, both, base(1, 1, 1, **UNLIT), colours=colours)
    frame = scene_frame(scene, "thing", PictureChoices(size=(40, 40)))
    alone = {ground(frame.turned(angle)) for angle in (0, 180)}
    assert len(alone) == 2
    assert len({ground(one) for one in around(frame, 4)}) == 1


def ground(frame: PictureFrame) -> tuple[int, ...]:
    return tuple(frame.draw().image[0, 0].tolist())


def test_black_things_are_told_together_and_why(tmp_path: Path) -> None:
    nodes = [{"mesh": 0, "name": f"part {i}", "translation": [3 * i, 0, 0]} for i in range(6)]
    whole = gltf(tmp_path, sphere(6, 12), base(0, 0, 0), nodes=nodes)
    (told,) = [one for one in remarks(whole) if "black" in one]
    assert told == (
        "part 0, part 1, part 2, part 3, … are black: their materials send no light back, neither "
        "of lamps nor ambient."
    )
    dark = gltf(tmp_path, quad(0, 1), textured(), (image(np.zeros((2, 2, 3))),))
    (told,) = [one for one in remarks(dark) if "black" in one]
    assert "its texture or its colours are black there; what is sent back of ambient" in told


@pytest.mark.parametrize(("level", "is_told"), [(0.002, True), (0.02, False)])
def test_nearly_black_is_told_too(tmp_path: Path, level: float, *, is_told: bool) -> None:
    found = gltf(tmp_path, sphere(12, 24), base(level, level, level))
    (name,) = [one.name for one in found.objects]
    told = f"{name} is nearly black: about 100 % of what is seen of it is darker than level 20"
    assert any(one.startswith(told) for one in remarks(found)) == is_told
    assert not any("is black" in one for one in remarks(found))


def test_made_normals_are_told_to_be_smooth_unless_every_face_is_flat(tmp_path: Path) -> None:
    (tmp_path / "a.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\n")
    scene = scene_of(tmp_path / "a.obj")
    assert any("smooth across every edge" in one for one in loaded(scene).remarks)
    flat = replace(scene, settings=replace(scene.settings, shading=Shading.FLAT))
    assert not any("smooth across every edge" in one for one in loaded(flat).remarks)


@pytest.mark.parametrize(
    ("camera", "size", "words"),
    [
        ({"perspective": {"aspectRatio": 2, "yfov": 0.8}}, (80, 80), "more above and below"),
        ({"perspective": {"aspectRatio": 2, "yfov": 0.8}}, (90, 30), "more on both sides"),
        ({"perspective": {"aspectRatio": 2, "yfov": 0.8}}, (101, 50), None),
        ({"perspective": {"yfov": 0.8}}, (90, 30), None),
        ({"orthographic": {"xmag": 2, "ymag": 1}}, (80, 80), "more above and below"),
        ({"orthographic": {"xmag": 2, "ymag": 1}}, (90, 30), "more on both sides"),
    ],
)
def test_what_a_camera_frames_is_in_a_picture_of_every_shape(
    tmp_path: Path, camera: dict[str, Any], size: tuple[int, int], words: str | None
) -> None:
    (kind,) = camera
    camera[kind] |= {"znear": 0.1, "zfar": 10}
    nodes = [{"mesh": 0}, {"camera": 0, "translation": [0, 0, 5]}]
    scene = gltf(tmp_path, sphere(6, 12), nodes=nodes, cameras=[{"type": kind, **camera}])
    shown = scene.sized(*size)
    (own_x, own_y), (x, y) = (
        (float(P[0][0]), float(P[1][1]))
        for P in (scene.lens.clip_from_camera, shown.lens.clip_from_camera)
    )
    assert x <= own_x * 1.02  # a scale of clip space: the smaller, the more is seen
    assert y <= own_y * 1.02
    assert y / x == pytest.approx(size[0] / size[1])
    told = [one for one in shown.remarks if "framed" in one]
    assert [words in one for one in told] == [True] if words else not told


# --- the camera


@pytest.mark.parametrize("back", [False, True])
@pytest.mark.parametrize("axes", [(0, 1), (1, 2), (0, 2), (2, 0), (1, 0), (2, 1)])
def test_a_flat_sheet_is_seen_from_its_front(
    tmp_path: Path, axes: tuple[int, int], *, back: bool
) -> None:
    found = covered(shown(gltf(tmp_path, quad(*axes, back=back))))
    assert len(found) > 0.08 * 120 * 120
    assert found.max() >= 120, "light falls on its front"


def test_a_sheet_that_the_usual_eye_would_see_from_its_edge_is_turned(tmp_path: Path) -> None:
    """Its normal is at a right angle to the usual way to the eye."""
    right, up = np.array([0.6, 0.6, 1.0]) / np.sqrt(1.72), np.array([0.0, 1.0, -0.6])
    up /= np.linalg.norm(up)
    flat = quad(0, 1)
    positions = flat.positions @ np.array([right, up, (0, 0, 0)])
    normal = np.cross(right, up)
    edge = Mesh(positions, np.tile(normal, (4, 1)), flat.triangles)
    both = gltf(tmp_path, edge, {"doubleSided": True})
    assert len(covered(shown(both))) > 0.08 * 120 * 120


def test_a_closed_body_is_seen_from_the_usual_place() -> None:
    ring = SceneObject("ring", LoadedGeometry(torus()), identity(4))
    scene = loaded(Scene((ring,), has_camera=False))
    way = np.array([float(x) for x in scene.eye])
    assert (
        np.abs(way / np.linalg.norm(way) - np.array([0.6, 0.6, 1.0]) / np.sqrt(1.72)).max() < 0.01
    )


# --- why a picture is empty


def empty(scene: Scene) -> list[str]:
    proof = picture(scene.sized(64, 64), "thing")
    assert proof.work.fragments == 0
    assert proof.verdict == "Nothing covers a sample."
    return [one for one in report_of(proof).remarks if one.startswith("Nothing can be seen")]


def seen_from(scene: Scene, eye: tuple[float, float, float], target: tuple[float, ...]) -> Scene:
    view = View(eye=eye, target=target)  # type: ignore[arg-type]
    return replace(scene, has_camera=True, view=view)


@pytest.mark.parametrize(
    ("eye", "target", "why"),
    [
        ((0, 0, -5), (0, 0, 0), "turns its back"),
        ((0, 0, 5), (0, 0, 9), "is behind the eye"),
        ((0, 0, 5), (9, 0, 5), "is off the screen"),
        ((0, 0, 90), (0, 0, 0), "is smaller than a sample"),
        ((5, 0, 0), (0, 0, 0), "is seen from its edge"),
    ],
)
def test_an_empty_picture_says_why(
    tmp_path: Path, eye: tuple[int, int, int], target: tuple[int, ...], why: str
) -> None:
    small = Mesh(*(getattr(quad(0, 1), one) for one in ("positions", "normals", "triangles")))
    if "smaller" in why:
        small = Mesh(small.positions * 1e-3 + 0.013, small.normals, small.triangles)
    (told,) = empty(seen_from(gltf(tmp_path, small), eye, target))
    assert told.startswith(f"Nothing can be seen: thing {why}")


def test_triangles_without_area_are_told(tmp_path: Path) -> None:
    flat = quad(0, 1)
    line = Mesh(flat.positions * (1, 0, 0), flat.normals, flat.triangles)
    assert empty(gltf(tmp_path, line)) == [
        "Nothing can be seen: thing has no triangle with an area."
    ]


def test_a_file_of_lines_alone_says_so(tmp_path: Path) -> None:
    lines = [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 1}]}]
    with pytest.raises(ValueError, match=r"no triangles in its scene \(other primitives: 1 of lin"):
        loaded(gltf(tmp_path, quad(0, 1), meshes=lines))


def test_what_covers_next_to_nothing_is_told(tmp_path: Path) -> None:
    far = seen_from(gltf(tmp_path, sphere(12, 24)), (0.0, 0.0, 60.0), (0, 0, 0))
    assert "What is drawn covers less than 0.5 % of the picture." in remarks(far)


def test_what_is_next_to_nothing_beside_the_rest_is_told(tmp_path: Path) -> None:
    nodes = [{"mesh": 0, "name": "large"}, {"mesh": 0, "name": "speck", "scale": [0.01] * 3}]
    nodes[1]["translation"] = [1.5, 0, 0]
    told = remarks(gltf(tmp_path, sphere(12, 24), nodes=nodes))
    assert any(
        one.startswith("1 of 2 objects covers less than 0.5 % of the picture: speck; ")
        for one in told
    )
