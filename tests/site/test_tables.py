"""What the site is made of: words, numbers and cures of each mistake, words of each rule."""

from __future__ import annotations

import doctest
import json
import re
from importlib import import_module
from pathlib import Path

import cures
import numpy as np
import pytest
from symptoms import MISTAKES, RULES

import nmatrix
from nmatrix.lessons.check.mistake import MistakeId
from nmatrix.linting.rules import RuleId
from nmatrix.raster.proofs.catalogue import PROOFS

DOCS = Path(__file__).resolve().parents[2] / "docs"
LONGEST = 90  # characters of a heading


@pytest.mark.parametrize("mistake", MistakeId)
def test_the_example_of_a_mistake_is_named_so_by_check(mistake: MistakeId, nmatrix) -> None:
    found = nmatrix(f"{MISTAKES[mistake].command.removeprefix('nmatrix ')} -f json")
    assert found.code == 1
    assert json.loads(found.out)["mistake"] == mistake


@pytest.mark.parametrize("mistake", MistakeId)
def test_a_mistake_has_the_words_that_are_searched(mistake: MistakeId) -> None:
    symptom = MISTAKES[mistake]
    assert len(symptom.searched) >= 3
    assert len(symptom.seen) <= LONGEST
    assert ":" in symptom.seen  # what one sees, and why
    assert symptom.cure in cures.CURES
    assert symptom.picture in {None, *(one.name for one in PROOFS)}


def test_no_two_pages_are_searched_by_the_same_words() -> None:
    phrases = [one for symptom in MISTAKES.values() for one in (symptom.seen, *symptom.searched)]
    phrases += [one for words in RULES.values() for one in words]
    assert len({one.lower() for one in phrases}) == len(phrases)


@pytest.mark.parametrize("rule", RuleId)
def test_a_rule_has_the_words_that_are_searched(rule: RuleId) -> None:
    assert len(RULES[rule]) >= 2


def defined(cure: cures.Cure) -> dict:
    """Run the lines of a cure; return what they define."""
    names = {"np": np}
    exec(cure.lines, names)
    return names


def test_the_cure_of_normals_is_the_normal_matrix_up_to_a_positive_factor() -> None:
    world = nmatrix.world(scale=(-1, 2, 3), rotate=(30, 20, 10), translate=(1, 2, 3))
    right = nmatrix.normal_matrix(world)
    cured = defined(cures.COFACTORS)["normal_matrix"](world)
    assert np.linalg.det(world[:3, :3]) < 0
    assert np.allclose(cured / np.linalg.norm(cured), right / np.linalg.norm(right))


def test_the_cure_of_worlds_puts_rotation_scale_and_translation_in_their_order() -> None:
    rotation = defined(cures.EULER)["rotation"]((30, 20, 10))
    cured = defined(cures.WORLD)["world"]((1, 2, 3), rotation, (1, 2, 4))
    turned = np.radians((30, 20, 10))
    right = nmatrix.world(scale=(1, 2, 4), rotate=turned, translate=(1, 2, 3))
    assert np.allclose(cured, right)


def test_the_cure_of_quaternions_takes_any_length_and_w_last() -> None:
    given = (1.0, -2.0, 3.0, 0.5)
    cured = defined(cures.QUATERNION)["rotation_of"](given)
    assert np.allclose(cured, nmatrix.quaternion(given)[:3, :3])


def test_the_cure_of_cameras_is_the_view_matrix() -> None:
    eye, target, up = np.array([3.0, 1, 5]), np.array([0.0, 1, -1]), np.array([0.0, 1, 0])
    cured = defined(cures.LOOK_AT)["look_at"](eye, target, up)
    assert np.allclose(cured, nmatrix.look_at(eye, target, up))


@pytest.mark.parametrize(("zero_to_one", "depth"), [(False, "-1..1"), (True, "0..1")])
def test_the_cure_of_lenses_takes_near_and_far_to_the_ends_of_the_depth_range(
    zero_to_one, depth
) -> None:
    matrix = defined(cures.PERSPECTIVE)["perspective"](50, 1.6, 0.5, 20, zero_to_one)
    ends = [(matrix @ (0, 0, -z, 1))[2] / (matrix @ (0, 0, -z, 1))[3] for z in (0.5, 20)]
    assert np.allclose(ends, [0, 1] if zero_to_one else [-1, 1]), depth
    corner = matrix @ (1.6 * np.tan(np.radians(25)), np.tan(np.radians(25)), -1, 1)
    assert np.allclose(corner[:2] / corner[3], 1)


def test_the_cure_of_windows_is_where_trace_puts_the_vertex(nmatrix) -> None:
    line = "trace --point 1 1 0 --eye 0 0 5 --viewport 640 480 -f json"
    traced = nmatrix(line).data
    clip = np.array(traced["clip"])
    window = defined(cures.WINDOW)["window"]
    assert np.allclose(window(clip, 640, 480), traced["window"])
    assert np.allclose(window(clip, 640, 480, from_the_top=True)[1], 480 - traced["window"][1])


def test_the_cure_of_axes_is_what_axes_computes() -> None:
    matrix = nmatrix.world(scale=(1, 2, 4), rotate=(30, 20, 10), translate=(1, 2, 3))
    cured = defined(cures.AXES)["in_y_up"](matrix)
    assert np.allclose(cured[:3, 3], (1, 3, -2))
    right = nmatrix.axes("blender", "opengl", matrix).data
    found = [value for value in right.values() if np.shape(value) == (4, 4)]
    assert any(np.allclose(cured, one) for one in found)


def test_every_proof_stands_in_the_gallery_with_its_claim_picture_words_and_command() -> None:
    text = (DOCS / "gallery.md").read_text(encoding="utf-8")
    sections = re.split(r"^## ", text, flags=re.MULTILINE)[1:]
    assert len(sections) == len(PROOFS)
    for section, proof in zip(sections, PROOFS, strict=True):
        assert section.startswith(f"{proof.claim}\n")
        picture = re.search(r"!\[([^\]]{60,})\]\(pictures/([\w-]+)\.png\)", section)
        assert picture is not None, proof.name
        assert picture[2] == proof.name
        assert f"```sh\nnmatrix render {proof.name}\n```" in section


@pytest.mark.parametrize("module", ["markdown", "front_page"])
def test_the_examples_of_the_builder_hold(module: str) -> None:
    pytest.importorskip("yaml", reason="the extra docs is not installed")
    found = doctest.testmod(import_module(module))
    assert found.attempted > 0
    assert found.failed == 0


def test_the_index_of_the_documents_leads_to_each_of_them() -> None:
    listed = set(re.findall(r"\]\(([\w/-]+\.md)\)", (DOCS / "README.md").read_text("utf-8")))
    pages = {one.name for one in DOCS.glob("*.md")} - {"README.md"}
    assert listed == {*pages, "lint/README.md"}
