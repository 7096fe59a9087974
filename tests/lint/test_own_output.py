"""The shaders that nmatrix prints are clean, and their names say their spaces."""

from __future__ import annotations

from itertools import product
from pathlib import Path

import pytest

from nmatrix.answers.lint import Source, report
from nmatrix.enums import Reflection, Shading, Space
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


def told(program: Program) -> object:
    sources = Source("a.vert", program.vertex_shader), Source("a.frag", program.fragment_shader)
    found = report(sources)
    assert found.remarks == ()
    return found.data["findings"]


@pytest.mark.parametrize("space", Space)
def test_nothing_is_told_of_a_sheet(space: Space) -> None:
    setup = Setup(World(scale=(1, 2, 1)), light=Light((0, -1, 0), position=(1, 2, 3)))
    maps = Setup(setup.world, light=setup.light, space_matrix=setup.world.world_from_object).maps
    for shading, reflection in product((Shading.GOURAUD, Shading.PHONG), Reflection):
        program = program_of_sheet(maps, Request(space, shading, reflection))
        assert told(program) == [], program.fragment_shader


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_nothing_is_told_of_the_bodies_of_a_scene(path: Path) -> None:
    plan = planned(loaded(scene_of(path)))
    assert plan.bodies
    for body in plan.bodies:
        assert told(program_of(plan, body)) == []
