"""A map is classified before it is rounded: from parts, and down every hierarchy."""

from __future__ import annotations

import json
from fractions import Fraction
from itertools import permutations
from math import prod
from pathlib import Path
from random import Random

import pytest

import nmatrix as package
from nmatrix.answers.inspect.file import inspect_file
from nmatrix.answers.normal import NormalRequest, normal
from nmatrix.answers.world import world as world_answer
from nmatrix.enums import Convention, Flaw, Kind, NormalStatus, Space
from nmatrix.linear.classify import Classification, classify
from nmatrix.linear.exact import LinearMap
from nmatrix.linear.rank_keeping import LONGEST, rounded_keeping_rank
from nmatrix.linear.rational import (
    affine_matrix,
    linear_part,
    product,
    rational_matrix,
    rounded_for_display,
    to_floats,
)
from nmatrix.raster.loaded_scene import loaded
from nmatrix.scene.gltf.file import read_gltf
from nmatrix.scene.open import scene_of
from nmatrix.scene.setup import Setup
from nmatrix.scene.world import World

CAPITALS = tuple(map("".join, permutations("XYZ")))
ORDERS = (*CAPITALS, *map(str.lower, CAPITALS))
HOWS = [(order, Convention.STANDARD) for order in ORDERS] + [
    ("XYZ", convention) for convention in Convention if convention is not Convention.STANDARD
]


def quaternion(drawn: Random) -> list[float]:
    return [drawn.gauss(0, 1) for _ in range(4)]


def gltf(folder: Path, nodes: list[dict[str, object]]) -> Path:
    """Save a chain: every node is the child of the one before."""
    for index, node in enumerate(nodes[:-1]):
        node["children"] = [index + 1]
    path = folder / "chain.gltf"
    path.write_text(json.dumps({"asset": {"version": "2.0"}, "nodes": nodes}))
    return path


def is_flat(found: Classification, rank: int) -> bool:
    return (found.kind, found.mirrored, found.rank) == (Kind.SINGULAR, False, rank)


@pytest.mark.parametrize(("order", "convention"), HOWS)
def test_a_scale_of_0_is_singular_whatever_turns_and_shears(
    order: str, convention: Convention
) -> None:
    drawn = Random(order + convention)
    for _ in range(6):
        scale = [drawn.choice((0, 0, 1, -0.3, 2.7)) for _ in range(3)]
        scale[drawn.randrange(3)] = 0
        turns = [drawn.uniform(-180, 180) for _ in range(3)]
        shear = [drawn.uniform(-2, 2) for _ in range(3)]
        flat = World((1, 2, 3), turns, scale=scale, shear=shear, order=order, convention=convention)
        rank = sum(map(bool, scale))
        setup = Setup(flat)
        for space in (Space.WORLD, Space.CAMERA, Space.LIGHT):
            assert is_flat(classify(setup.maps.space_from_object(space).exact), rank)
        for data in (world_answer(setup).data, normal(setup, NormalRequest()).data):
            assert (data["transform"], data["mirrored"]) == ("singular", False)
            assert (data["rank"], data["determinant"], data["normal_matrix"]) == (rank, 0, None)


def test_the_normal_of_a_flattened_and_sheared_plane_has_two_sides() -> None:
    """H leaves the plane z = 0 as it is, and R carries its normal as any other."""
    turns = (10, 20, 30)
    flat = Setup(World(rotate_degrees=turns, scale=(1, 1, 0), shear=(0.7, -0.3, 0.55)))
    (found,) = normal(flat, NormalRequest(((0, 0, 1),))).data["normals"]
    right = Setup(World(rotate_degrees=turns))
    (carried,) = normal(right, NormalRequest(((0, 0, 1),))).data["normals"]
    assert found["status"] == NormalStatus.TWO_SIDED
    assert found["transformed"] == pytest.approx(carried["transformed"], abs=1e-15)


def test_a_flattened_world_says_that_the_printed_floats_only_come_near_it() -> None:
    flat = World(rotate_degrees=(10, 20, 30), scale=(1, 0, 1), shear=(0.7, -0.3, 0.55))
    assert LinearMap.of(to_floats(linear_part(flat.world_from_object))).rank == 3
    assert "computed with exactly" in " ".join(world_answer(Setup(flat)).remarks)
    assert not World(rotate_degrees=(10, 20, 30), scale=(1, 0, 1)).remarks


def test_two_hundred_turned_children_of_flattened_nodes_are_singular(tmp_path: Path) -> None:
    for seed in range(200):
        drawn = Random(seed)
        scale = [1.0, 1.0, 1.0]
        scale[seed % 3] = 0.0
        nodes: list[dict[str, object]] = [
            {"rotation": quaternion(drawn), "scale": [1, drawn.uniform(0.5, 2), -1]},
            {"scale": scale, "rotation": quaternion(drawn)},
            {"rotation": quaternion(drawn), "translation": [1, 2, 3]},
        ]
        above, flat, part = inspect_file(gltf(tmp_path, nodes)).nodes
        assert Flaw.MIRRORED in above.flaws
        assert is_flat(flat.maps.each[0], 2)
        assert is_flat(part.maps.each[0], 2)


@pytest.mark.parametrize("seed", range(16))
def test_scene_files_multiply_ranks_and_signs(tmp_path: Path, seed: int) -> None:
    drawn = Random(seed)
    lines, signs = [], []
    for index in range(4):
        scale = [drawn.choice((-1.5, 0.3, 1, 2)) for _ in range(3)]
        if seed % 2 and index == 1:
            scale[drawn.randrange(3)] = 0
        turns = [drawn.uniform(-180, 180) for _ in range(3)]
        shear = [drawn.uniform(-1, 1) for _ in range(3)]
        signs.append((prod(scale) > 0) - (prod(scale) < 0))
        lines += ["[[object]]", f"name = 'o{index}'", "shape = 'box'", f"scale = {scale}"]
        lines += [f"rotate = {turns}", f"shear = {shear}"]
        lines += [f"parent = 'o{index - 1}'"] if index else []
    path = tmp_path / "arm.toml"
    path.write_text("\n".join(lines))
    scene = scene_of(path)
    for index, (one, body) in enumerate(zip(scene.objects, loaded(scene).bodies, strict=True)):
        sign = prod(signs[: index + 1])
        assert is_flat(body.kind, 2) == (sign == 0)
        found = classify(one.world_from_object)
        assert (found.determinant_sign, found.rank) == (sign, 3 if sign else 2)
        data = package.Setup.from_scene(path, object=one.name).world().data
        assert (data["determinant_sign"], data["rank"]) == (found.determinant_sign, found.rank)
        assert (data["transform"] == "singular") == (sign == 0)


def test_signs_multiply_where_the_rounded_determinant_loses_them(tmp_path: Path) -> None:
    """Every node makes the determinant 10⁹ times smaller."""
    drawn = Random(5)
    nodes = [
        {"rotation": quaternion(drawn), "scale": [1, drawn.choice((-1e-9, 1e-9)), 1]}
        for _ in range(300)
    ]
    rounded_right = 0
    sign = 1
    for node, record in zip(read_gltf(gltf(tmp_path, nodes)).nodes, nodes, strict=True):
        sign *= 1 if record["scale"][1] > 0 else -1
        block = linear_part(node.world_from_object)
        assert LinearMap.of(block).determinant_sign == sign
        rounded_right += LinearMap.of(to_floats(block)).determinant_sign == sign
    assert rounded_right < 200, "the chain must lose signs when it is rounded"


def test_a_long_chain_below_a_flattened_node_stays_flat_and_short(tmp_path: Path) -> None:
    drawn = Random(7)
    nodes = [{"rotation": quaternion(drawn), "scale": [1, 1, 1.001]} for _ in range(400)]
    nodes[3]["scale"] = [1, 0, 1]
    for index, node in enumerate(read_gltf(gltf(tmp_path, nodes)).nodes):
        found = LinearMap.of(linear_part(node.world_from_object))
        assert (found.determinant_sign, found.rank) == ((0, 2) if index >= 3 else (1, 3))
        assert max(entry.bit_length() for row in found.entries for entry in row) <= LONGEST


def test_what_one_node_flattens_another_may_take_whole(tmp_path: Path) -> None:
    """Turned back, the second node has only what the first one takes to zero."""
    q, back = [0.3, 0.2, -0.1, 0.7], [-0.3, -0.2, 0.1, 0.7]
    nodes: list[dict[str, object]] = [
        {"rotation": [0.5, 0.1, 0.4, 0.2]},
        {"scale": [1, 0, 1]},
        {"rotation": q},
        {"rotation": back, "scale": [0, 1, 0]},
    ]
    found = [classify(node.world_from_object) for node in read_gltf(gltf(tmp_path, nodes)).nodes]
    assert [one.rank for one in found] == [3, 2, 2, 0]


def test_rounding_that_keeps_the_rank_but_not_what_vanishes_is_no_rounding() -> None:
    """Both rows are multiples of (3, 1, 1) and of its rounded third; the floats have rank 2."""
    third = Fraction(1, 3)
    block = ((1, third, third), (2, 2 * third, 2 * third), (0, 1, 2))
    M = affine_matrix(rational_matrix(block))
    rounded = rounded_for_display(M)
    assert LinearMap.of(linear_part(rounded)).rank == 2
    assert rounded != M
    assert rounded_keeping_rank(M) == M


@pytest.mark.parametrize("rank", range(4))
def test_a_shortened_block_has_its_rank_its_sign_and_its_floats(rank: int) -> None:
    for seed in range(30):
        drawn = Random(seed)

        def long() -> Fraction:
            return Fraction(drawn.getrandbits(700) - (1 << 699), drawn.getrandbits(600) | 1)  # noqa: B023

        tall = tuple(tuple(long() for _ in range(rank)) for _ in range(3))
        wide = tuple(tuple(long() for _ in range(3)) for _ in range(rank))
        block = product(tall, wide) if rank else ((Fraction(0),) * 3,) * 3
        if rank == 3:  # nearly flat: floats lose its sign
            flat = product(tall, ((*wide[0],), (*wide[1],), (*(x * 0 for x in wide[2]),)))
            block = tuple(
                tuple(f + x / (1 << 2600) for f, x in zip(a, b, strict=True))
                for a, b in zip(flat, block, strict=True)
            )
        before = LinearMap.of(block)
        M = rounded_keeping_rank(affine_matrix(block))
        after = LinearMap.of(linear_part(M))
        assert (after.rank, after.determinant_sign) == (before.rank, before.determinant_sign)
        longest = max(entry.bit_length() for row in after.entries for entry in row)
        assert longest < 3 * LONGEST
        for row, other in zip(to_floats(linear_part(M)), to_floats(block), strict=True):
            assert row == pytest.approx(other, rel=1e-15)


def test_ordinary_worlds_are_floats_and_nothing_else() -> None:
    drawn = Random(1)
    for _ in range(100):
        turns = [drawn.uniform(-180, 180) for _ in range(3)]
        scale = [drawn.uniform(-2, 2) for _ in range(3)]
        shear = [drawn.uniform(-2, 2) for _ in range(3)]
        M = World((1, 2, 3), turns, scale=scale, shear=shear).world_from_object
        assert rational_matrix(to_floats(M)) == M


def test_exact_halves_are_rounded_to_the_even_float() -> None:
    """float(−1.4) · ¾ lies exactly between two floats; ¾ is a product of two irrational sines."""
    tie = Fraction(-1.4) * Fraction(3, 4)
    M = World(rotate_degrees=(150, 240, -1080), scale=(-1.4,) * 3, order="YXZ").world_from_object
    assert M[0][2] == Fraction(float(tie)) == Fraction(-1.0499999999999998)
