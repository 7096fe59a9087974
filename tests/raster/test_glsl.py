"""The GLSL of a plan: a compiler accepts it, and it holds no term that the plan left out."""

from __future__ import annotations

import shutil
import subprocess
from dataclasses import replace
from pathlib import Path

import pytest
from small_scenes import BLINN, BULB, LAMBERT, PHONG, SUN, TOON, single

from nmatrix.enums import Effect, Shading, Space
from nmatrix.raster.loaded_scene import LoadedScene, loaded
from nmatrix.raster.planning.glsl import program_of
from nmatrix.raster.planning.plan import everything, planned
from nmatrix.raster.proofs.showpiece import showpiece
from nmatrix.scene.scene import Settings
from nmatrix.scene.world import World


def loaded_scenes() -> list[LoadedScene]:
    found = [
        loaded(
            single(
                World(scale=(1, 2, 1)), material, lights=(SUN, BULB), space=space, shading=shading
            )
        )
        for material in (LAMBERT, PHONG, BLINN, TOON)
        for space in (Space.WORLD, Space.OBJECT)
        for shading in Shading
    ]
    settings = [Settings(size=(32, 32), shading=shading) for shading in Shading]
    return [*found, *(loaded(showpiece(one)) for one in settings)]


def test_a_compiler_accepts_every_plan(tmp_path: Path) -> None:
    compiler = shutil.which("glslangValidator")
    if compiler is None:
        pytest.skip("glslangValidator is not installed (Debian: glslang-tools)")
    files = []
    for i, ready in enumerate(loaded_scenes()):
        for plan in (planned(ready), everything(ready)):
            for j, body in enumerate(plan.bodies):
                program = program_of(plan, body)
                texts = (program.vertex_shader, program.fragment_shader)
                for name, text in zip(("vert", "frag"), texts, strict=True):
                    file = tmp_path / f"{i}-{plan.picture[Effect.COLOUR].on}-{j}.{name}"
                    file.write_text(text)
                    files.append(str(file))
    done = subprocess.run([compiler, *files], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout[-2000:]


def fragment(**scene: object) -> str:
    plan = planned(loaded(single(**scene)))  # type: ignore[arg-type]
    return program_of(plan, plan.bodies[0]).fragment_shader


def test_a_matt_body_under_the_sun_has_a_short_shader() -> None:
    text = fragment()
    for absent in (
        "position",
        "eye",
        "shininess",
        "attenuation",
        "fog",
        "metric",
        "gl_FrontFacing",
    ):
        assert absent not in text
    assert text.count("dot(n, l)") == 1


def test_each_effect_brings_its_own_lines() -> None:
    assert "pow(clamp(highlight, 0.0, 1.0), shininess)" in fragment(material=PHONG)
    assert "attenuation.x" in fragment(lights=(BULB,))
    assert "vector_world_from_space" in fragment(
        world=World(scale=(1, 2, 1)), material=PHONG, space=Space.OBJECT
    )
    assert "ceil(" in fragment(material=TOON)
    assert "shadow_map" in fragment(lights=(replace(SUN, shadows=True),))


def test_a_light_that_cannot_reach_has_no_line() -> None:
    far = replace(BULB, position=(100, 0, 0), range=5)
    assert "light_color_1" not in fragment(lights=(SUN, far))
    assert "light_color_1" in fragment(lights=(SUN, BULB))
