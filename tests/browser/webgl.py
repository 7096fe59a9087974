"""The pictures of a plan, drawn by a browser's WebGL2 with nothing but what the plan prints."""

from __future__ import annotations

import base64
import json
import re
from dataclasses import dataclass, fields
from pathlib import Path

import numpy as np
from PIL import Image

from nmatrix.answers.plan import plan as report_of
from nmatrix.enums import Format, Shading, Space
from nmatrix.linear.rational import to_floats
from nmatrix.output.write import OutputOptions, write
from nmatrix.raster.planning.plan import BodyPlan, Plan
from nmatrix.raster.render import render
from nmatrix.raster.shading.opacity import opacity
from nmatrix.raster.shading.outline import hull_normals
from nmatrix.raster.shading.shadow import shadow_map
from nmatrix.raster.shading.space import ShadingSpace
from nmatrix.raster.shading.surface import Surface
from nmatrix.raster.triangles.fragments import Fragments, VertexOutputs
from nmatrix.raster.triangles.vertices import Projected

# A browser's software snaps corners to 1/16 pixel and the rasterizer to 1/256: what jumps in a
# picture would jump elsewhere. So it draws larger, and the middle pixel of each block is compared.
TIMES = 5

SCRIPT = (Path(__file__).parent / "webgl.js").read_text()


def encoded(values: np.ndarray) -> str:
    return base64.b64encode(np.ascontiguousarray(values)).decode()


def printed_objects(plan: Plan) -> list[dict]:
    """The objects of the plan as its JSON prints them."""
    return json.loads(write(report_of(plan), OutputOptions(Format.JSON)))["objects"]


def declared(shaders: str) -> set[str]:
    """The names of the uniforms and samplers that shaders declare."""
    found = re.findall(r"^uniform (?:highp )?\w+ (\w+)(?:\[(\d+)\])?;", shaders, re.MULTILINE)
    return {
        f"{name}[{i}]" if count else name for name, count in found for i in range(int(count or 1))
    }


def attributes(plan: Plan, body: BodyPlan) -> dict[str, np.ndarray]:
    """The mesh's arrays, corner by corner, baked where static space wants it."""
    mesh = body.body.mesh
    rule = body.rule(plan.loaded.settings.normals)
    positions, normals = mesh.positions, mesh.normals
    tangents = None if mesh.tangents is None else mesh.tangents[:, :3]
    faces = mesh.face_normals
    corners = mesh.triangles.reshape(-1)
    if plan.loaded.settings.space is Space.STATIC:
        baked = ShadingSpace(plan.loaded, body.body, Space.STATIC, uses_metric=False)
        positions, normals = baked.positions().T, baked.normals(rule).T
        tangents = None if tangents is None else baked.vectors(tangents).T
        faces = baked.face_normals(rule).T
    found = {
        "vertex_position": positions[corners],
        "vertex_normal": np.where(np.isfinite(normals), normals, 0.0)[corners],
        "face_position": np.repeat(positions[mesh.triangles].mean(axis=1), 3, axis=0),
        "face_normal": np.repeat(faces, 3, axis=0),
        "hull_normal": hull_normals(plan.loaded, body.body).T[corners],
    }
    if mesh.uv is not None:
        found["vertex_uv"] = mesh.uv[corners]
    if mesh.colours is not None:
        found["vertex_colour"] = mesh.colours[corners, :3]
        found["vertex_alpha"] = mesh.colours[corners, 3:]
    if mesh.tangents is not None:
        found["vertex_tangent"] = np.hstack([tangents, mesh.tangents[:, 3:]])[corners]
    return found


def image_bound(plan: Plan, bind: dict) -> dict:
    """What a sampler is bound to, made as its entry in the JSON says."""
    if "shadow_map" in bind:
        return shadow_maps_bound(plan, bind)
    levels = np.asarray(Image.open(bind["image"]).convert("RGBA"))
    return {
        "size": [levels.shape[1], levels.shape[0]],
        "bytes": encoded(levels[::-1]),
        "format": bind["format"],
        "filter": bind["filter"],
        "wrap": bind["wrap"],
    }


def shadow_maps_bound(plan: Plan, bind: dict) -> dict:
    size = plan.loaded.settings.shadow_map
    views = plan.light_views[bind["shadow_map"]]
    printed = np.array(bind["light_from_world"])
    assert np.array_equal(printed, [to_floats(one.light_from_world) for one in views])
    maps = [np.minimum(shadow_map(one, size).distance, 3e38) for one in views]
    return {
        "size": [size, size],
        "layers": bind["layers"],
        "floats": encoded(np.stack(maps).astype(np.float32)),
        "filter": bind["filter"],
    }


# What an interface of another clip space does, in that of WebGL.
TO_WEBGL = {
    "minus-one-to-one": "",
    "zero-to-one": "gl_Position.z = 2.0 * gl_Position.z - gl_Position.w;",
    "reversed": "gl_Position.z = gl_Position.w - 2.0 * gl_Position.z;",
    "up": "",
    "down": "gl_Position.y = -gl_Position.y;",
}


def in_webgl(printed: dict) -> str:
    """The vertex shader for WebGL's own clip space."""
    more = TO_WEBGL[printed["depth_range"]] + TO_WEBGL[printed["clip_y"]]
    return printed["vertex_shader"].rstrip().removesuffix("}") + more + "}\n"


def drawn(page, plan: Plan) -> np.ndarray:
    """The picture (height, width, 3) in levels, as a browser draws it."""
    bodies = []
    for body, found in zip(plan.drawn, printed_objects(plan), strict=True):
        bodies += [
            {
                **printed,
                "vertex_shader": in_webgl(printed),
                "images": {
                    name: image_bound(plan, one) for name, one in printed["samplers"].items()
                },
                "attributes": {
                    name: [one.shape[1], encoded(one.astype(np.float32))]
                    for name, one in attributes(plan, body).items()
                },
                "corners": body.body.mesh.triangles.size,
                "is_clear": body.body.material.is_clear,
            }
            for printed in (found, found["outline"])
            if printed is not None
        ]
    bodies.sort(key=lambda one: one["is_clear"])
    size, background = plan.loaded.settings.size, plan.loaded.settings.background
    found = page.evaluate(SCRIPT, [size, TIMES, background, bodies])
    assert found["said"] == [], (found["said"], bodies)
    levels = np.frombuffer(base64.b64decode(found["pixels"]), np.uint8)
    return levels.reshape(size[1], size[0], 4)[::-1, :, :3].astype(int)


class Numbered(Surface):
    """A surface that is painted with the numbers of its body and of its triangles."""

    def vertex(self, projected: Projected) -> VertexOutputs:
        names = np.arange(len(self.space.body.mesh.triangles), dtype=float)[None]
        return VertexOutputs(faces={"name": projected.per_triangle(names)})

    def fragment(self, fragments: Fragments) -> np.ndarray:
        found = np.zeros((self.style.channels, len(fragments)))
        bodies, mine = self.space.loaded.bodies, self.space.body
        place = next(i for i, one in enumerate(bodies) if one.name == mine.name)
        if mine is not bodies[place]:  # the hull of its outline
            place += len(bodies)
        found[:] = place * 1e6 + fragments["name"] + 1
        if mine.material.is_clear:  # what blending over the background makes the number again
            seen = np.maximum(opacity(mine, fragments), 1e-9)
            behind = np.array(self.space.loaded.settings.background[: self.style.channels])
            found = (found - (1 - seen) * behind[:, None]) / seen
        return found


def names(plan: Plan) -> np.ndarray:
    """The number of the triangle that each pixel shows, and 1e6 for each body before its own."""
    painted = render(
        plan,
        finish=np.copy,
        change=lambda one: Numbered(**{f.name: getattr(one, f.name) for f in fields(one)}),
    )
    return painted.image[..., 0]


def interior(numbers: np.ndarray) -> np.ndarray:
    """The pixels whose eight neighbours have their own number too."""
    inner = np.zeros(numbers.shape, bool)
    middle = numbers[1:-1, 1:-1]
    same = middle >= 1
    height, width = numbers.shape
    for y in range(3):
        for x in range(3):
            same = same & (numbers[y : height - 2 + y, x : width - 2 + x] == middle)
    inner[1:-1, 1:-1] = same
    return inner


@dataclass(frozen=True)
class Agreement:
    """How a browser's picture compares: interior pixels, the share within 2 levels, the worst."""

    pixels: int
    share: float
    worst: int


def compared(page, plan: Plan, *, by_face: bool | None = None) -> Agreement:
    """Draw a plan both ways."""
    theirs = drawn(page, plan)
    image = np.clip(render(plan).rgb, 0.0, 1.0)
    ours = np.rint(image * 255).astype(int)
    numbers = names(plan)
    if by_face is None:
        by_face = plan.loaded.settings.shading is Shading.FLAT
    if not by_face:
        numbers = np.where(numbers >= 1, np.floor((numbers - 1) / 1e6) + 1, 0.0)
    inner = interior(numbers)
    off = np.abs(ours - theirs).max(axis=2)[inner]
    return Agreement(int(inner.sum()), float((off <= 2).mean()), int(off.max(initial=0)))
