"""Matrices of known parameters are read back: from floats, from float32, from six digits."""

from __future__ import annotations

import json
from dataclasses import dataclass
from fractions import Fraction
from math import inf
from random import Random

import numpy as np
import pytest

from nmatrix.answers.identify import NUMBERS, identify_matrix
from nmatrix.enums import API_PRESETS, Api, ClipY, DepthRange, Handedness, Layout
from nmatrix.linear.lens_readings import as_written
from nmatrix.linear.projection import ClipSpace, Window
from nmatrix.linear.rational import to_floats
from nmatrix.reading.matrix import matrix_literal
from nmatrix.scene.camera import FirstPerson, View
from nmatrix.scene.lens import Lens

FORMS = {
    "float64 as JSON": lambda A: json.dumps(A.tolist()),
    "float64 as NumPy prints it": lambda A: np.array2string(A, floatmode="maxprec", precision=17),
    "float32 as JSON": lambda A: json.dumps(A.astype("f4").astype("f8").tolist()),
    "float32 as NumPy prints it": lambda A: np.array2string(A.astype("f4"), floatmode="unique"),
    "six digits": lambda A: "; ".join(" ".join(f"{x:.6g}" for x in row) for row in A),
}


PLACES = ("clip_from_camera", "camera_from_world", "world_from_object")


@dataclass(frozen=True)
class Typed:
    """A lens as somebody typed it, and the words and numbers that a reading must come to."""

    lens: Lens
    numbers: dict[str, float]
    kind: str

    def agrees(self, reading: dict[str, object], layouts: set[str]) -> bool:
        clip = self.lens.clip
        words = (self.kind, clip.handed, clip.depth, clip.clip_y)
        told = tuple(reading[key] for key in ("kind", "handed", "depth_range", "clip_y"))
        return (
            told == words
            and reading["layout"] in layouts
            and all(_holds(reading[name], value) for name, value in self.numbers.items())
        )


def _holds(interval: object, value: float) -> bool:
    low, high = interval  # type: ignore[misc]
    return low <= value and (high is None or value <= high)


class _Typist:
    """Chooses what people choose: round numbers of one to three digits, usual interfaces."""

    def __init__(self, seed: int) -> None:
        self.random = Random(seed)

    def round_number(self, low: float, high: float) -> float:
        digits = self.random.choice((1, 1, 1, 2, 2, 3))
        return float(f"{low * (high / low) ** self.random.random():.{digits - 1}e}")

    def clip(self) -> ClipSpace:
        choose = self.random.choice
        if self.random.random() > 0.8:
            return ClipSpace(*(choose(list(words)) for words in (DepthRange, Handedness, ClipY)))
        depth, handed, clip_y, _ = API_PRESETS[choose(list(Api))]
        if depth is DepthRange.ZERO_TO_ONE and self.random.random() < 0.3:
            depth = DepthRange.REVERSED
        return ClipSpace(depth, handed, clip_y)

    def lens(self) -> Typed:
        return self.random.choice((self._field, self._field, self._frustum, self._ortho))()

    def _planes(self, clip: ClipSpace) -> dict[str, float]:
        near = self.random.choice((0.1, 1, 0.01, self.round_number(0.001, 10)))
        far = self.random.choice((100, 1000, near * 1e4, self.round_number(near * 3, near * 1e5)))
        if self.random.random() < (0.6 if clip.depth is DepthRange.REVERSED else 0.03):
            far = inf
        return {"near": near, "far": float(f"{far:.2e}")}

    def _field(self) -> Typed:
        choose, clip = self.random.choice, self.clip()
        planes = self._planes(clip)
        fov = choose((45, 60, 90, self.round_number(10, 150)))
        aspect = choose((1, 16 / 9, 4 / 3, 1.5, self.round_number(0.5, 3)))
        lens = Lens(fov_degrees=fov, aspect=aspect, clip=clip, **planes)
        return Typed(lens, planes | {"fov_y_deg": fov, "aspect": aspect}, "projection")

    def _frustum(self) -> Typed:
        clip = self.clip()
        planes, sides = self._planes(clip), self._sides(0.01, 1)
        lens = Lens(frustum=Window(**sides), clip=clip, **planes)
        return Typed(lens, planes | sides, "projection")

    def _ortho(self) -> Typed:
        clip, sides = self.clip(), self._sides(0.1, 100)
        near = self.random.choice((0, 0.1, 1, self.round_number(0.01, 10)))
        planes = {"near": near, "far": float(f"{near + self.round_number(1, 1000):.2e}")}
        lens = Lens(ortho=Window(**sides), clip=clip, **planes)
        return Typed(lens, planes | sides, "orthographic")

    def _sides(self, low: float, high: float) -> dict[str, float]:
        sides = {}
        for first, second in (("left", "right"), ("bottom", "top")):
            sides[first] = -self.round_number(low, high)
            sides[second] = self.random.choice((-sides[first], self.round_number(low, high)))
        return sides


def _read_back(count: int, seed: int) -> tuple[int, list[str], list[str]]:
    """Type so many lenses and read them back: how many come first, which do not, which are lost."""
    typist, later, lost, first = _Typist(seed), [], [], 0
    for _ in range(count):
        typed = typist.lens()
        P = np.array(to_floats(typed.lens.clip_from_camera))
        layout = typist.random.choice(list(Layout))
        stored = P.T if layout is Layout.COLUMN_MAJOR else P
        text = FORMS[typist.random.choice(list(FORMS))](stored)
        readings = identify_matrix(matrix_literal(text).as_floats).data["readings"]
        layouts = set(Layout) if (P == P.T).all() else {layout}
        agreeing = [typed.agrees(reading, layouts) for reading in readings]
        first += agreeing[0]
        if not agreeing[0]:
            (later if any(agreeing) else lost).append(text)
    return first, later, lost


@pytest.mark.slow
def test_what_was_typed_is_among_the_readings_and_mostly_first() -> None:
    first, later, lost = _read_back(100, seed=2)
    assert not lost
    assert first >= 98, later


@pytest.mark.slow
def test_of_two_thousand_lenses_ninety_nine_in_a_hundred_come_first_and_none_is_lost() -> None:
    first, _, lost = _read_back(2000, seed=1)
    assert not lost
    assert first >= 1980


@pytest.mark.parametrize("api", Api)
@pytest.mark.parametrize("form", FORMS)
def test_the_usual_lens_of_every_interface_is_recognised(api: Api, form: str) -> None:
    lens = Lens(clip=ClipSpace(*API_PRESETS[api]))
    text = FORMS[form](np.array(to_floats(lens.clip_from_camera)))
    (first, *_) = identify_matrix(matrix_literal(text).as_floats).data["readings"]
    # Metal, WebGPU and OpenGL differ in depth alone, which 0.1 to 100 tells.
    assert api.value in first["apis"]
    assert _holds(first["near"], 0.1)
    assert _holds(first["far"], 100)


@pytest.mark.parametrize("seed", range(30))
def test_the_command_builds_the_matrix_again(seed: int, nmatrix) -> None:
    typist = _Typist(1000 + seed)
    P = np.array(to_floats(typist.lens().lens.clip_from_camera))
    literal = matrix_literal(FORMS[typist.random.choice(list(FORMS))](P))
    reading = identify_matrix(literal.as_floats).data["readings"][0]
    again = nmatrix(reading["command"].removeprefix("nmatrix ") + " -f json").data
    built = np.array(again[next(key for key in again if key in PLACES)])
    if reading["layout"] == "column-major":
        built = built.T
    assert reading["residual"] <= 1
    written, known = as_written(literal.as_floats)
    off = np.abs(built - np.array(written, float))
    assert (off <= np.array(known, float) + 1e-15 * np.abs(P).max()).all()


def test_worlds_and_views_come_back_in_round_numbers(nmatrix) -> None:
    for line, option in (
        ("world --translate 1 2 3 --rotate 10 20 30 --order ZYX --scale 2 2 2", "nmatrix world"),
        ("world --scale 1 2 1 --shear 0.5 0 0", "nmatrix world"),
        ("view --eye 3 3 2.5", "nmatrix view"),
        ("view --eye 1 2 3 --elevation -20 --angle 35 --roll 5", "nmatrix view"),
    ):
        key = "world_from_object" if line.startswith("world") else "camera_from_world"
        built = nmatrix(f"{line} -f json").data[key]
        for digits in (6, 17):
            text = "; ".join(" ".join(f"{x:.{digits}g}" for x in row) for row in built)
            reading = nmatrix(f'identify "{text}" -f json').data["readings"][0]
            assert reading["command"].startswith(option)
            assert {float(word) for word in reading["command"].split() if _is_number(word)} == {
                float(word) for word in line.split() if _is_number(word)
            } | ({0.0} if "--eye 3" in line or "--shear" in line else set()), line


def _is_number(word: str) -> bool:
    return word.lstrip("-").replace(".", "").isdigit()


@pytest.mark.slow
def test_views_of_both_hands_and_all_turns_are_rigid_with_their_eye() -> None:
    random = Random(3)
    for _ in range(40):
        eye = [round(random.uniform(-9, 9), 2) for _ in range(3)]
        turn = FirstPerson(*(round(random.uniform(-80, 80), 1) for _ in range(3)))
        view = random.choice(
            (View(eye=eye, angles=turn), View(eye=eye, handed=random.choice(list(Handedness))))
        )
        V = np.array(to_floats(view.placed().camera_from_world))
        for form in FORMS.values():
            (first, *_) = identify_matrix(matrix_literal(form(V)).as_floats).data["readings"]
            assert first["kind"] == "rigid"
            assert np.allclose(np.array(first["eye"], float), eye, atol=1e-3)


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("0 0 0; 0 0 0; 0 0 0", "singular"),
        ("0 0 0 0; 0 0 0 0; 0 0 0 0; 0 0 0 0", "singular"),
        ("1 2 3 4; 2 4 6 8; 3 6 9 12; 4 8 12 16", "singular"),
        ("1 0 0 0; 0 1 0 0; 0 0 -1 0; 0 0 -1 0", "singular"),
        ("1 0 0; 0 1 0; 0 0 0", "singular"),
        ("1 2 3 4; 0 1 2 3; 1 0 1 2; 3 1 0 1", "general"),
        ("1 0 0 5; 0 1 0 6; 0 0 1 7", "rigid"),
        ("1 0 0; 0 1 0; 0 0 1; 5 6 7", "rigid"),
        ("1 0.5 0; 0 1 0; 0 0 1", "affine"),
        ("1e300 0 0; 0 1e-300 0; 0 0 1", "affine"),
        ("1e-300 0 0; 0 1e-300 0; 0 0 1e-300", "affine"),
        ("1e300 1e300 0 1e300; -1e300 1e300 0 1e300; 0 0 1e300 1e300; 0 0 0 1", "affine"),
        ("5e-324 5e-324 0 0; -5e-324 5e-324 0 0; 0 0 5e-324 0; 0 0 0 1", "affine"),
        ("1 0 0 0; 0 1 0 0; 0 0 -1.002 -1e307; 0 0 -1 0", "projection"),
        ("2 0 0 0; 0 2 0 0; 0 0 -2.44444 -4.44444; 0 0 -2 0", "projection"),
        ("1 0.2 0 0; 0 1 0 0; 0 0 -1.22222 -2.22222; 0 0 -1 0", "general"),
    ],
)
def test_whatever_fits_no_reading_is_what_is_nearest(text: str, kind: str, nmatrix) -> None:
    found = nmatrix(f'identify "{text}" -f json')
    assert found.code == 0
    assert found.data["readings"][0]["kind"] == kind
    for command in ("identify", "projection --projection-matrix", "view --view-matrix", "normal"):
        assert nmatrix(f'{command} "{text}"').code in (0, 2, 3)


def test_what_is_no_map_of_space_is_refused_in_one_line(nmatrix) -> None:
    for text in ("1 2; 3 4", "1 2 3", "1 2 3 4 5"):
        found = nmatrix(f'identify "{text}"')
        assert (found.code, found.err.count("\n")) == (2, 1)


def test_an_interval_is_all_values_that_round_to_the_digits(nmatrix) -> None:
    """near = c/A in 0..1: a near just inside the interval rounds to the digits, outside not."""
    data = nmatrix('identify "1 0 0 0; 0 1 0 0; 0 0 1.0101 -1.0101; 0 0 1 0" -f json').data
    low, high = data["readings"][0]["near"]
    half, value = Fraction(1, 20000), Fraction("1.0101")
    assert abs(Fraction(low) - (value - half) / (value + half)) < 1e-14
    assert abs(Fraction(high) - (value + half) / (value - half)) < 1e-14


def test_every_depth_range_that_fits_is_among_the_readings(nmatrix) -> None:
    """-1 -K with three digits: both ranges fit, whatever K is."""
    for K in range(3, 1000, 53):
        text = f"1 0 0 0; 0 1 0 0; 0 0 -1 -{K / 1000}; 0 0 -1 0"
        readings = nmatrix(f'identify "{text}" -f json').data["readings"]
        assert {"zero-to-one", "minus-one-to-one"} <= {one["depth_range"] for one in readings}


def test_keys_that_the_entries_do_not_decide_are_named(nmatrix) -> None:
    built = nmatrix("projection -f json").data["clip_from_camera"]
    found = nmatrix(f"identify '{built}' -f json").data
    assert {"depth_range", "near"} <= set(found["ambiguous"])
    assert not {"kind", "layout", "handed", "clip_y", "far", "fov_y_deg"} & set(found["ambiguous"])
    assert set(NUMBERS) <= set(found["readings"][0])
