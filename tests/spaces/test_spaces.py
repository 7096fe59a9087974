"""Spaces: the same cosine in every one of them, and shaders that a compiler accepts."""

from __future__ import annotations

import re
import shutil
import subprocess
from fractions import Fraction
from itertools import product
from math import isclose, isfinite, sqrt
from pathlib import Path

import numpy as np
import pytest

from nmatrix.enums import Reflection, Shading, Space
from nmatrix.errors import NoAnswerError
from nmatrix.linear import rational
from nmatrix.linear.rational import RationalMatrix, RationalVector
from nmatrix.scene.setup import Light, Setup
from nmatrix.scene.world import World
from nmatrix.shaders.sheet import Request, program_of
from nmatrix.spaces.light_and_eye import _last_column_of_inverse, light_in

WORLDS = {
    "scale": World(scale=(1, 4, 1), rotate_degrees=(10, 20, 30)),
    "shear": World(shear=(1, 2, -1), translate=(1, 2, 3)),
    "mirror": World(scale=(-1, 3, 2), rotate_degrees=(5, 0, 70)),
}
SKEWED = rational.rational_matrix([[2, 1, 0, 5], [0, 1, 0, -1], [0.5, 0, 1, 2], [0, 0, 0, 1]])


def setup_of(world: World, light: Light) -> Setup:
    return Setup(world, light=light, space_matrix=SKEWED)


def length(matrix: RationalMatrix, v: RationalVector) -> float:
    moved = rational.apply(matrix, v)
    return sqrt(float(rational.dot(moved, moved)))


def lambert(setup: Setup, space: Space, point: RationalVector, normal: RationalVector) -> float:
    """n·l over lengths measured by the metric's factors, in the coordinates of a space."""
    maps = setup.maps
    moved = maps.space_from_object(space)
    n = rational.apply(rational.inverse_transpose(rational.linear_part(moved.exact)), normal)
    position = light_in(maps, space).position
    assert position is not None
    p = moved.exact_point(point)
    l_ = tuple(a - b for a, b in zip(position, p, strict=True))
    lengths = length(maps.normal_world_from_space(space), n) * length(
        maps.vector_world_from_space(space), l_
    )
    return float(rational.dot(n, l_)) / lengths


@pytest.mark.parametrize("name", WORLDS)
def test_a_point_lights_cosine_is_the_same_in_every_space(name: str) -> None:
    setup = setup_of(WORLDS[name], Light(position=(3, 4, 5)))
    point, normal = rational.rational_vector((1, 0, 2)), rational.rational_vector((1, 1, 1))
    found = [lambert(setup, space, point, normal) for space in Space]
    assert all(isclose(one, found[0], rel_tol=1e-12) for one in found), found


def test_without_the_metric_object_space_is_wrong() -> None:
    maps = setup_of(WORLDS["scale"], Light(position=(3, 4, 5))).maps
    back = maps.vector_world_from_space(Space.OBJECT)
    v = rational.rational_vector((1, 1, 1))
    assert abs(length(back, v) - sqrt(3)) > 0.1


def test_the_counter_example_of_the_courses_light_rule() -> None:
    light = Light(direction=(Fraction(3, 10), Fraction(9, 10), Fraction(1, 5)))
    maps = setup_of(World(scale=(1, Fraction(1, 4), 1)), light).maps
    seen = light_in(maps, Space.OBJECT)
    n = (sqrt(0.5), sqrt(0.5), 0.0)
    assert seen.direction_course_rule is not None
    assert seen.direction is not None
    assert (
        round(sum(a * b for a, b in zip(n, seen.direction_course_rule, strict=True)), 4) == 0.8735
    )
    assert round(sum(a * b for a, b in zip(n, seen.direction, strict=True)), 4) == 0.7622


def test_object_space_of_a_singular_world_has_no_answer() -> None:
    with pytest.raises(NoAnswerError):
        setup_of(World(scale=(1, 0, 1)), Light()).maps.space_from_world(Space.OBJECT)


REQUESTS = [
    Request(space, shading, reflection)
    for space, shading, reflection in product(Space, (Shading.GOURAUD, Shading.PHONG), Reflection)
]
LIGHTS = (
    Light(direction=(1, -1, 0)),
    Light(position=(1, 2, 3)),
    Light(direction=(1, -1, 0), position=(1, 2, 3)),
)


def test_shaders_read_exactly_the_uniforms_that_are_listed() -> None:
    for request, light in product(REQUESTS, LIGHTS):
        maps = setup_of(WORLDS["scale"], light).maps
        program = program_of(maps, request)
        text = program.vertex_shader + program.fragment_shader
        for uniform in program.uniforms:
            declared = f"uniform {uniform.kind} {uniform.name};"
            assert declared in text, (request, uniform.name)
            assert text.replace(declared, "").count(uniform.name), (request, uniform.name)
        assert set(re.findall(r"uniform \w+ (\w+);", text)) == {u.name for u in program.uniforms}


def test_a_compiler_accepts_every_shader(tmp_path: Path) -> None:
    compiler = shutil.which("glslangValidator")
    if compiler is None:
        pytest.skip("glslangValidator is not installed (Debian: glslang-tools)")
    files = []
    for i, (request, light) in enumerate(product(REQUESTS, LIGHTS)):
        program = program_of(setup_of(WORLDS["scale"], light).maps, request)
        pair = (program.vertex_shader, program.fragment_shader)
        for stage, text in zip(("vert", "frag"), pair, strict=True):
            file = tmp_path / f"{i}.{stage}"
            file.write_text(text)
            files.append(str(file))
    done = subprocess.run([compiler, *files], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout[-2000:]


@pytest.mark.parametrize("scale", [1e-150, 1.0, 1e150])
def test_the_course_inverts_as_float64_programs_do(scale: float) -> None:
    random = np.random.default_rng(26)
    for A in random.uniform(-9, 9, (200, 4, 4)) * scale:
        A[0, 0] = 0 if A[0, 1] > 0 else 1e-17 * scale  # a pivot must be looked for
        right = np.linalg.inv(A)
        found = np.array(_last_column_of_inverse(A.tolist()))
        apart = np.abs(found - right[:, 3]).max()
        assert apart <= 1e-14 * np.linalg.cond(A) * np.abs(right).max()


@pytest.mark.parametrize("number", [0.0, float("inf"), float("nan"), 1e308])
def test_what_floats_cannot_invert_gives_no_numbers(number: float) -> None:
    assert not any(map(isfinite, _last_column_of_inverse([[number] * 4] * 4)))
