"""Every shading space is named, computed, described, answered and documented: none is forgotten."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from nmatrix.enums import Frame, Space
from nmatrix.linear.rational import identity, rational_matrix
from nmatrix.scene.camera import View
from nmatrix.scene.setup import Light, Setup
from nmatrix.scene.world import World
from nmatrix.spaces.shading_spaces import PROFILES, SYNONYMS, Place

DOCS = Path(__file__).resolve().parents[2] / "docs"
SKEWED = "2 1 0 5; 0 1 0 -1; 0.5 0 1 2; 0 0 0 1"
MAPS = Setup(
    World(scale=(1, 4, 1), rotate_degrees=(10, 20, 30), translate=(1, 2, 3)),
    View(eye=(3, 4, 5)),
    light=Light(direction=(1, -2, 3), position=(3, 4, 4)),
    space_matrix=rational_matrix([[float(x) for x in row.split()] for row in SKEWED.split(";")]),
).maps


@pytest.mark.parametrize("space", Space)
def test_a_space_has_a_frame_and_a_matrix_that_leads_there(space: Space) -> None:
    found = MAPS.space_from_world(space)
    assert (found.to, found.source) == (Frame(space), Frame.WORLD)


@pytest.mark.parametrize("space", Space)
def test_what_a_profile_says_is_true_of_the_matrices(space: Space) -> None:
    profile, S = PROFILES[space], MAPS.space_from_world(space)
    assert (profile.symbol == "") is (S.exact == identity(4))
    assert (profile.lights_moved is Place.NOWHERE) is (profile.symbol == "")
    if profile.vertices_in is Space.OBJECT and not profile.moves_vertices:
        assert MAPS.space_from_object(space).exact == identity(4)
    assert profile.eye_is_origin is (max(map(abs, S.point((3, 4, 5)))) < 1e-12)
    assert profile.pros
    assert profile.cons
    assert profile.used


@pytest.mark.parametrize("space", Space)
@pytest.mark.parametrize("command", ["light {}", "eye {}", "space {}", "normal --space {}"])
def test_commands_answer_in_every_space(nmatrix, command: str, space: Space) -> None:
    own = f"--space-matrix '{SKEWED}'" if space is Space.CUSTOM else ""
    code, out, err = nmatrix(f"{command.format(space)} {own} --scale 1 2 1 -f json")
    assert code == 0, err
    answer = json.loads(out)
    assert answer.get("space", space) == space


def test_a_synonym_is_the_name_of_no_space_and_means_one() -> None:
    assert not set(SYNONYMS) & set(Space)
    assert len(SYNONYMS) == sum(len(profile.synonyms) for profile in PROFILES.values())


@pytest.mark.parametrize("space", Space)
def test_the_documents_name_every_space_with_its_synonyms(space: Space) -> None:
    conventions = (DOCS / "conventions.md").read_text(encoding="utf-8")
    synonyms = ", ".join(PROFILES[space].synonyms)
    assert f"\n| {space} | {synonyms} ".rstrip() + " |" in conventions
    key = next(
        line
        for line in (DOCS / "scenes.md").read_text(encoding="utf-8").splitlines()
        if line.startswith("| `space` |")
    )
    assert f"`{space}`" in key
