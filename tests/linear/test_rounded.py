"""Digits that were given: how well they are known, and what a rounded matrix stands for."""

from __future__ import annotations

from fractions import Fraction
from itertools import chain
from random import Random

import numpy as np
import pytest

from nmatrix.enums import Kind
from nmatrix.linear.classify import classify
from nmatrix.linear.rational import RoundedMatrix, linear_part, to_floats
from nmatrix.linear.rounded import meant
from nmatrix.reading.matrix import matrix_literal
from nmatrix.scene.world import World


@pytest.mark.parametrize(
    ("text", "half"),
    [
        ("0.70711", "1/200000"),
        ("0.001", "1/2000"),
        ("1.41", "1/200"),
        ("12.5", "1/20"),
        ("1.25e-3", "1/200000"),
        ("0.5", "0"),
        ("1.1", "0"),
        ("2", "0"),
        ("1000", "0"),
        ("250.0", "0"),
        ("1/3", "0"),
        ("2e-7", "0"),
        ("-0.000", "1/2000"),
    ],
)
def test_a_number_is_known_to_half_a_unit_of_its_last_digit(text: str, half: str) -> None:
    found = matrix_literal(f"{text} 0 0; 0 1 0; 0 0 1").half_units
    assert found[0][0] == Fraction(half)
    assert not any(chain(*found[1:]))


def test_numbers_that_are_all_float32_are_known_to_half_a_unit_of_float32() -> None:
    turned = np.array(to_floats(linear_part(World(rotate_degrees=(10, 20, 30)).world_from_object)))
    single = turned.astype("f4")
    for text in (str(single.tolist()), np.array2string(single, floatmode="unique")):
        found = matrix_literal(text).half_units
        halves = np.spacing(np.abs(single)).astype(float) / 2
        assert (np.array(found, float) >= halves * (1 - 1e-12)).all()
        assert (np.array(found, float) <= np.maximum(halves, 5e-8)).all()
    assert np.array(matrix_literal(str(turned.tolist())).half_units, float).max() < 1e-15


def test_what_nmatrix_wrote_is_exact(nmatrix, tmp_path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    for form in ("json", "csv"):
        (tmp_path / "m.txt").write_text(nmatrix(f"world --rotate 10 20 30 -f {form}").out)
        literal = matrix_literal((tmp_path / "m.txt").read_text())
        assert not any(chain(*literal.half_units))


KINDS = {
    Kind.ROTATION: {},
    Kind.SIMILARITY: {"scale": (2.5, 2.5, 2.5)},
    Kind.NON_UNIFORM_SCALE: {"scale": (1, 1.7, 0.3)},
    Kind.SHEAR: {"shear": (0.4, 0, 0)},
}


@pytest.mark.parametrize("mirror", [1, -1])
@pytest.mark.parametrize("kind", KINDS)
def test_a_map_printed_with_few_digits_is_the_kind_that_it_was(kind: Kind, mirror: int) -> None:
    random = Random(4)
    for _ in range(15):
        parts = dict(KINDS[kind])
        scale = parts.pop("scale", (1, 1, 1))
        turn = [random.choice((0, 30, 45, 17, -33.3, random.uniform(-180, 180))) for _ in range(3)]
        world = World(rotate_degrees=turn, scale=(*scale[:2], mirror * scale[2]), **parts)
        digits = random.randint(3, 9)
        rows = linear_part(world.world_from_object)
        text = "; ".join(" ".join(f"{float(x):.{digits}f}" for x in row) for row in rows)
        found = classify(matrix_literal(text).as_floats)
        special = {kind, Kind.IDENTITY} if kind is Kind.ROTATION else {kind}
        assert found.kind in special, text
        assert found.mirrored == (mirror < 0)


def test_a_kind_to_the_digits_is_held_by_a_matrix_strictly_within_them() -> None:
    """What `meant` finds lies inside, is of its kind exactly, and nothing is claimed without it."""
    random, claimed = Random(5), 0
    for _ in range(60):
        digits = random.randint(3, 5)
        turn = [random.uniform(-180, 180) for _ in range(3)]
        rows = linear_part(World(rotate_degrees=turn).world_from_object)
        noise = random.choice((0, 0.4, 1.5, 5)) * 10.0**-digits
        text = "; ".join(
            " ".join(f"{float(x) + random.uniform(-noise, noise):.{digits}f}" for x in row)
            for row in rows
        )
        typed = matrix_literal(text).as_floats
        found = meant(typed)
        if found == tuple(typed):
            continue
        claimed += 1
        assert isinstance(typed, RoundedMatrix)
        for entry, middle, half in zip(
            chain(*found), chain(*typed), chain(*typed.half_units), strict=True
        ):
            assert abs(entry - middle) < half
        columns = list(zip(*found, strict=True))
        for i in range(3):
            for j in range(i):
                assert sum(p * q for p, q in zip(columns[i], columns[j], strict=True)) == 0
    assert claimed > 20


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("0.70711 -0.70711 0; 0.70711 0.70711 0; 0 0 1", Kind.ROTATION),
        ("0.70711 -0.70711 0; 0.70711 0.70711 0; 0 0 1.1", Kind.NON_UNIFORM_SCALE),
        ("0.70711 -0.70711 0; 0.70711 0.70715 0; 0 0 1", Kind.SHEAR),
        ("0.707 -0.707 0; 0.707 0.707 0; 0 0 1", Kind.ROTATION),
        ("0.71 -0.71 0; 0.71 0.71 0; 0 0 1", Kind.NON_UNIFORM_SCALE),
        ("1 0.001 0; -0.001 1 0; 0 0 1", Kind.NON_UNIFORM_SCALE),
        ("1.000 0 0; 0 1.000 0; 0 0 1.000", Kind.IDENTITY),
        ("0.9995 0 0; 0 1 0; 0 0 1", Kind.NON_UNIFORM_SCALE),
        ("0.9997 0 0; 0 1 0; 0 0 1", Kind.NON_UNIFORM_SCALE),
        ("0.99997 0 0; 0 1.00 0; 0 0 1", Kind.NON_UNIFORM_SCALE),
        ("1.0001 0 0; 0 1 0; 0 0 1", Kind.NON_UNIFORM_SCALE),
        ("1 0 0; 0 1 0; 0 0 1.000", Kind.IDENTITY),
    ],
)
def test_half_a_unit_decides_and_no_more(text: str, kind: Kind) -> None:
    assert classify(matrix_literal(text).as_floats).kind is kind


def test_option_values_are_exact(nmatrix) -> None:
    found = nmatrix("world --scale 1 1 1.001 -f json").data
    assert (found["transform"], found["transform_exact"]) == ("non-uniform-scale", True)


def test_to_the_digits_in_every_space_and_command(nmatrix) -> None:
    text = "0.70711 -0.70711 0; 0.70711 0.70711 0; 0 0 1"
    for line, key in (
        (f"normal '{text}'", "rotation"),
        (f"normal '{text}' --space camera", "rigid"),
        (f"world --world-matrix '{text}'", "rotation"),
        (f"normal --scale 1 1 1 --view-matrix '{text}' --space camera", "rotation"),
        (f"normal --scale 1 1 1 --space-matrix '{text}' --space custom", "rotation"),
    ):
        found = nmatrix(f"{line} -f json").data
        assert (found["transform"], found["transform_exact"]) == (key, False), line
        said = nmatrix(line).out
        assert "To the digits given this is" in said.replace("\n", " ")
        assert "needs the inverse transpose" not in said
    assert nmatrix(f"space camera --view-matrix '{text}' -f json").data["metric"] is None
