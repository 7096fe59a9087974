"""Every shader that nmatrix prints, compiled and linked by a browser's own WebGL2."""

from __future__ import annotations

from itertools import product
from pathlib import Path

import pytest

from nmatrix.enums import Frame, Reflection, Shading, Space
from nmatrix.linear.rational import rational_matrix
from nmatrix.raster.loaded_scene import loaded
from nmatrix.raster.planning.glsl import program_of
from nmatrix.raster.planning.plan import planned
from nmatrix.scene.open import scene_of
from nmatrix.scene.setup import Light, Setup
from nmatrix.scene.world import World
from nmatrix.shaders.program import Program
from nmatrix.shaders.sheet import Request
from nmatrix.shaders.sheet import program_of as program_of_sheet

SCENES = sorted((Path(__file__).parents[2] / "docs" / "scenes").glob("*.toml"))
COMPILE = """([vertex, fragment]) => {
  const gl = document.createElement("canvas").getContext("webgl2");
  const program = gl.createProgram(), said = [];
  for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text); gl.compileShader(shader); gl.attachShader(program, shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) said.push(gl.getShaderInfoLog(shader));
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) said.push(gl.getProgramInfoLog(program));
  const error = gl.getError();
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return error ? [...said, "error " + error] : said;
}"""


def pair(program: Program) -> tuple[str, str]:
    return program.vertex_shader, program.fragment_shader


def stages():
    lights = (Light((-1, -2, -1)), Light(position=(2, 2, 8)),
              Light((0, -1, 0), position=(1, 2, 3)))  # fmt: skip
    stretched = rational_matrix([[2, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
    for light, scale in product(lights, ((1, 1, 1), (1, 2, 1))):
        yield Setup(World(scale=scale), light=light, space_matrix=stretched).maps


@pytest.mark.slow
def test_every_pair_of_every_space_links(blank) -> None:
    pairs = {
        pair(program_of_sheet(maps, Request(space, shading, reflection)))
        for maps, space, shading, reflection in product(
            stages(), Space, (Shading.GOURAUD, Shading.PHONG), Reflection
        )
    }
    assert len(pairs) > 60
    for one in pairs:
        assert blank.evaluate(COMPILE, list(one)) == [], one
    assert Frame.CUSTOM  # custom space is among them


def test_the_plans_of_the_example_scenes_link(blank) -> None:
    assert SCENES
    for path in SCENES:
        plan = planned(loaded(scene_of(path)))
        for body in plan.bodies:
            assert blank.evaluate(COMPILE, list(pair(program_of(plan, body)))) == [], path.name


def test_a_broken_shader_is_noticed(blank) -> None:
    assert blank.evaluate(COMPILE, ["#version 300 es\nvoid main() { x }", "void"])
