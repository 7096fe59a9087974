"""The Python face as a whole: what is public, what every parameter refuses, words for enums."""

from __future__ import annotations

import ast
import copy
import inspect
import pydoc
import subprocess
import sys
from enum import StrEnum
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import nmatrix
from nmatrix.errors import IllegalValueError, NMatrixError

ROOT = Path(__file__).resolve().parents[2]
SCENE = ROOT / "docs" / "scenes" / "mirror.toml"
IDENTITY = np.eye(3)

# One call of each public function and value that succeeds: what the tests below vary.
CALLS: dict[str, dict[str, Any]] = {
    "angle_between": {"a": (1, 0, 0), "b": (0, 1, 0)},
    "axis_angle": {"axis": (0, 0, 1), "turn": 0.5},
    "calc": {"expression": "M", "setup": nmatrix.Setup(), "let": {}},
    "check": {
        "what": "normal", "answer": (0, 1, 0), "setup": nmatrix.Setup(), "space": "world",
        "tolerance": 0.1, "normal": (0, 1, 0),
    },
    "check_exercise": {"exercise": 2, "answer": "1 0 0; 0 1 0; 0 0 1", "seed": 7, "student": "A"},
    "classify": {"A": IDENTITY, "tolerance": 1e-12},
    "cofactor_matrix": {"A": IDENTITY},
    "derive": {"case": "translation", "world": {"translate": (1, 2, 3)}},
    "first_person": {
        "eye": (0, 0, 5), "elevation": 0.1, "angle": 0.1, "roll": 0.1, "convention": "standard"
    },
    "frustum": {"window": (-1, 1, -1, 1), "near": 1, "far": 10, "clip": "opengl"},
    "inspect": {"file": ROOT / "docs" / "samples" / "gate.gltf"},
    "axes": {"from_axes": "blender", "to_axes": "unity"},
    "identify": {"matrix": np.diag([2.0, 1, 1])},
    "lint": {
        "sources": {"a.vert": "void main() {}"}, "language": "glsl", "world": {"scale": (1, 2, 1)}
    },
    "look_at": {"eye": (0, 0, 5), "target": (0, 0, 0), "up": (0, 1, 0), "handed": "right"},
    "normal_matrix": {"A": IDENTITY, "kind": "oriented", "level": "exact", "out": None},
    "normalize": {"v": (1, 2, 3)},
    "orthographic": {"window": (-1, 1, -1, 1), "near": 1, "far": 10, "clip": "opengl"},
    "perspective": {"fov_y": 1, "aspect": 1, "near": 1, "far": 10, "clip": "opengl"},
    "plan": {"scene": SCENE},
    "quaternion": {"xyzw": (0, 0, 0, 1)},
    "render": {
        "subject": SCENE, "size": (8, 8), "shading": "flat", "reflection": "phong",
        "normals": "exact", "space": "world", "samples": 1, "effects": "planned",
    },
    "rotation": {"turns": (0, 0, 1), "order": "XYZ"},
    "transform_normals": {"A": IDENTITY, "n": (0, 1, 0), "level": "exact", "out": None},
    "viewport": {"width": 640, "height": 480, "api": "opengl"},
    "world": {
        "translate": (1, 2, 3), "rotate": (0, 0, 1), "scale": (1, 2, 1), "shear": (0, 0, 0),
        "order": "XYZ", "convention": "standard",
    },
    "show": {"value": IDENTITY, "name": "A"},
    "Setup": {
        "world": {"scale": (1, 2, 1)}, "view": {"eye": (1, 2, 3)}, "lens": {"fov": 60},
        "light": {"light_position": (1, 2, 3)}, "space_matrix": IDENTITY, "tolerance": 1e-9,
    },
    "World": {
        "translate": (1, 2, 3), "rotate_degrees": (0, 0, 1), "scale": (1, 2, 1),
        "shear": (0, 0, 0), "order": "XYZ", "convention": "standard",
    },
    "View": {"eye": (1, 2, 3), "target": (0, 0, 0), "up": (0, 1, 0), "handed": "right"},
    "FirstPerson": {"elevation": 1, "angle": 2, "roll": 3},
    "Lens": {"fov_degrees": 60, "aspect": 1, "near": 1, "far": 10},
    "Light": {"direction": (1, 0, 0), "position": (1, 2, 3)},
    "ClipSpace": {"depth": "zero-to-one", "handed": "left", "clip_y": "down"},
    "Window": {"left": -1, "right": 1, "bottom": -1, "top": 1},
    "Setup.from_scene": {"file": SCENE, "object": "reflected", "light": None},
    "Setup.world": {},
    "Setup.view": {},
    "Setup.projection": {},
    "Setup.normal": {"normals": [(0, 1, 0)], "space": "world", "method": "exact"},
    "Setup.light": {"space": "camera"},
    "Setup.eye": {"space": "camera"},
    "Setup.space": {"space": "camera", "shading": "phong", "reflection": "phong"},
    "Setup.trace": {"point": (0, 0, 0), "normal": (0, 1, 0), "viewport": (64, 64)},
    "Report.to": {"format": "json", "digits": 6, "layout": "row-major"},
    "Transform.of": {"to": "world", "source": "object", "matrix": IDENTITY},
    "Transform.point": {"point": (1, 2, 3)},
    "Transform.vector": {"vector": (1, 2, 3)},
    "Transform.normal": {"normal": (1, 2, 3)},
    "Transform.exact_point": {"point": (1, 2, 3)},
    "Transform.exact_vector": {"vector": (1, 2, 3)},
    "Angle.degrees": {"value": 30},
    "Angle.radians": {"value": 0.5},
}  # fmt: skip
RESULTS = {  # values that functions return and nobody builds
    "Classification", "TransformedNormals", "Report", "Picture", "Angle", "Transform"
}  # fmt: skip
OWNERS = {
    "Setup": nmatrix.Setup(),
    "Report": nmatrix.Setup().world(),
    "Transform": nmatrix.Transform.of("world", "object", IDENTITY),
    "Angle": nmatrix.Angle.degrees(30),
}
BAD = {
    "None": None,
    "text": "no such thing",
    "bytes": b"1 2 3",
    "an object": object(),
    "not a number": float("nan"),
    "infinity": float("inf"),
    "minus one": -1,
    "a huge integer": 10**400,
    "complex": 1 + 2j,
    "complex array": np.eye(3) * 1j,
    "nan array": np.full((3, 3), np.nan),
    "masked array": np.ma.masked_array(np.ones((3, 3)), mask=np.eye(3)),
    "masked vector": np.ma.masked_array([1.0, 2, 3], mask=[0, 0, 1]),
    "text array": np.array(["a", "b", "c"]),
    "ragged": [[1, 2], [3]],
    "empty": [],
    "wrong shape": np.ones((2, 5)),
    "a set": {1, 2, 3},
    "a dict": {"a": 1},
    "a type": int,
}


def _is_a(one: object, kind: type) -> bool:
    return isinstance(one, type) and issubclass(one, kind)


def called(name: str) -> Any:
    owner, _, method = name.rpartition(".")
    return getattr(OWNERS[owner], method) if owner else getattr(nmatrix, name)


def test_every_public_function_and_value_is_tried() -> None:
    enums = {n for n in nmatrix.__all__ if _is_a(getattr(nmatrix, n), StrEnum)}
    errors = {n for n in nmatrix.__all__ if _is_a(getattr(nmatrix, n), Exception)}
    rest = set(nmatrix.__all__) - enums - errors - RESULTS - {"__version__"}
    assert rest <= set(CALLS)
    for owner, one in OWNERS.items():
        kind = one if isinstance(one, type) else type(one)
        methods = {
            f"{owner}.{n}"
            for n, f in vars(kind).items()
            if not n.startswith("_") and (callable(f) or isinstance(f, classmethod))
        }
        assert {m for m in methods if inspect.signature(called(m)).parameters} <= set(CALLS)


@pytest.mark.parametrize("name", CALLS)
def test_every_call_that_the_tests_vary_succeeds(name: str) -> None:
    called(name)(**CALLS[name])


@pytest.mark.parametrize("what", BAD)
@pytest.mark.parametrize("name", CALLS)
def test_whatever_comes_is_answered_or_refused_by_name(name: str, what: str) -> None:
    for parameter in CALLS[name]:
        try:
            called(name)(**CALLS[name] | {parameter: copy.deepcopy(BAD[what])})
        except NMatrixError as error:
            assert "\n" not in str(error)
            assert len(str(error)) < 700


NUMERIC = [
    (name, parameter)
    for name, call in CALLS.items()
    for parameter, value in call.items()
    if isinstance(value, int | float | tuple | np.ndarray) and parameter not in ("seed", "size")
]


@pytest.mark.parametrize("what", ["text", "an object", "complex", "nan array", "masked vector"])
@pytest.mark.parametrize(("name", "parameter"), NUMERIC)
def test_what_is_no_number_is_refused_under_the_parameters_name(
    name: str, parameter: str, what: str
) -> None:
    if (name, parameter, what) == ("check", "answer", "text"):
        pytest.skip("an answer may be text, in any notation")
    with pytest.raises(NMatrixError) as found:
        called(name)(**CALLS[name] | {parameter: copy.deepcopy(BAD[what])})
    told = str(found.value)
    assert parameter.removesuffix("_degrees") in told or "matrix" in told


def words() -> list[tuple[str, str, type[StrEnum]]]:
    found = []
    for name in CALLS:
        for parameter, one in inspect.signature(called(name)).parameters.items():
            for word in str(one.annotation).replace("|", " ").replace("[", " ").split():
                kind = getattr(nmatrix, word, None) if word in nmatrix.__all__ else None
                if _is_a(kind, StrEnum):
                    found.append((name, parameter, kind))
    return found


@pytest.mark.parametrize(("name", "parameter", "kind"), words())
def test_an_enum_may_be_given_as_its_word(name: str, parameter: str, kind: type[StrEnum]) -> None:
    call = {k: v for k, v in CALLS[name].items() if not _excludes(name, parameter, k)}
    taken = []
    for member in kind:
        by_word = _told(name, call | {parameter: member.value})
        assert by_word == _told(name, call | {parameter: member})
        taken += [] if by_word.startswith(parameter) else [member]
    with pytest.raises(IllegalValueError) as found:
        called(name)(**call | {parameter: "lft"})
    assert taken
    assert all(member.value in str(found.value) for member in taken)
    assert parameter in str(found.value)


def test_the_words_are_found_by_their_annotations() -> None:
    found = {(name, parameter) for name, parameter, _ in words()}
    assert {("look_at", "handed"), ("ClipSpace", "depth"), ("Setup.normal", "method")} <= found
    assert {("normal_matrix", "level"), ("Transform.of", "to"), ("Report.to", "format")} <= found


def _excludes(name: str, parameter: str, other: str) -> bool:
    """Return whether a call's other argument contradicts one."""
    return parameter == "convention" and other == "order"


def _told(name: str, call: dict[str, Any]) -> str:
    try:
        found = called(name)(**call)
    except NMatrixError as error:
        return str(error)
    return str(found.png if isinstance(found, nmatrix.Picture) else found)


def test_help_and_a_star_import_know_every_name() -> None:
    told = pydoc.plain(pydoc.render_doc(nmatrix))
    names: dict[str, object] = {}
    exec("from nmatrix import *", names)
    assert set(nmatrix.__all__) <= set(names)
    assert all(name in told for name in nmatrix.__all__ if not name.startswith("_"))


def test_the_type_checker_reads_the_same_names() -> None:
    tree = ast.parse((ROOT / "nmatrix" / "__init__.py").read_text())
    (block,) = (one for one in tree.body if isinstance(one, ast.If))
    typed = {
        alias.name: f"{one.module}"
        for one in block.body
        if isinstance(one, ast.ImportFrom)
        for alias in one.names
    }
    assert typed == {name: f"nmatrix.{home}" for name, home in nmatrix._MODULES.items()}


def test_a_name_that_is_not_there_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match="normal_matrices"):
        getattr(nmatrix, "normal_matrices")  # noqa: B009  # a name that was


def test_importing_loads_no_array_library_and_a_setup_needs_none() -> None:
    script = (
        "import sys, nmatrix; nmatrix.Setup(world={'scale': (1, 2, 1)}).normal((1, 1, 0)).data; "
        "print([name for name in ('numpy', 'sympy', 'PIL', 'typer') if name in sys.modules])"
    )
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=True, cwd=ROOT
    )
    assert done.stdout.strip() == "[]"


def test_exact_numbers_stay_exact() -> None:
    third = nmatrix.World(scale=(Fraction(1, 3), 1, 1))
    assert third.exact[0][0] == Fraction(1, 3)
