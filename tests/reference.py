"""The references: the Python face, `docs/reference.md`, and the calculator, `docs/functions.md`.

One is made of the docstrings, the other of the records of the functions; `python
tests/reference.py` writes both anew, and a test compares.
"""

from __future__ import annotations

import inspect
import re
from enum import StrEnum
from functools import cached_property
from pathlib import Path
from typing import Any

import nmatrix
from nmatrix.calculator.arithmetic.values import Value
from nmatrix.calculator.functions import (
    camera,
    elimination,
    maps,
    matrices,
    numeric,
    places,
    rotations,
    spectral,
    vectors,
)
from nmatrix.calculator.functions.function import Function, Parameter

ENUM = re.compile(r"<\w+\.\w+: ('[^']*')>")  # a default, as Python shows it
CLASS = re.compile(r"<class '(?:\w+\.)*(\w+)'>")
QUOTED_TYPE = re.compile(r"(?<=\w): '([^']*)'")
LINE = 88  # characters of a call that stays on one line
PAGE = Path(__file__).resolve().parents[1] / "docs" / "reference.md"
OPENING = """# Python reference of nmatrix

Every public name of `nmatrix`, with its docstring; [the tour](python.md) shows how they go
together. This page is made by `python tests/reference.py`.
"""
FUNCTIONS_PAGE = PAGE.with_name("functions.md")
FUNCTIONS_OPENING = """# Functions of the calculator

Every function of [the calculator](calculator.md): how it is called, what it does, its formula, and
an example that holds. Arguments may be given by name, those with `=` may be left out. Angles are in
degrees; a multiple of `pi` without a unit is in radians. This page is made by
`python tests/reference.py`.
"""
FAMILIES = {
    "Matrices": matrices,
    "Row operations": elimination,
    "Spectra": spectral,
    "Vectors": vectors,
    "Spaces": places,
    "Numbers": numeric,
    "Rotations": rotations,
    "Worlds": maps,
    "Cameras": camera,
}
PARTS = {
    "Arrays": "nmatrix.api.normals nmatrix.api.builders",
    "Setups and reports": "nmatrix.api.setup nmatrix.api.report nmatrix.api.showing",
    "Commands": "nmatrix.api.commands nmatrix.api.pictures",
    "Values": "nmatrix.scene.world nmatrix.scene.camera nmatrix.scene.lens nmatrix.scene.setup "
    "nmatrix.linear.angle nmatrix.linear.projection nmatrix.linear.classify "
    "nmatrix.spaces.transform",
    "Words": "nmatrix.enums",
    "Errors": "nmatrix.errors",
}


def reference() -> str:
    """Return the whole page."""
    names = [name for name in nmatrix.__all__ if not name.startswith("_")]
    written = [OPENING]
    for title, modules in PARTS.items():
        written.append(f"## {title}\n")
        found = ((name, getattr(nmatrix, name)) for name in names)
        written += [entry(name, one) for name, one in found if one.__module__ in modules.split()]
    return "\n".join(written).rstrip() + "\n"


def functions() -> str:
    """Return the page of the calculator's functions."""
    written = [FUNCTIONS_OPENING]
    for title, family in FAMILIES.items():
        written.append(f"## {title}\n")
        written += [function_entry(name, one) for name, one in family.FUNCTIONS.items()]
    return "\n".join(written).rstrip() + "\n"


def function_entry(name: str, function: Function) -> str:
    """Return one function of the calculator."""
    does = f"{function.does[0].upper()}{function.does[1:]}."
    facts = [f"* formula: `{function.formula}`"]
    facts += [f"* `{one.name}`: {told(one)}" for one in function.parameters if told(one)]
    facts.append(f"* `{function.example}` is `{function.result}`")
    return "\n".join([f"### {function.usage(name)}\n", f"{does}\n", *facts, ""])


def told(parameter: Parameter) -> str:
    """Return what a parameter takes, where it has words or may be left out."""
    if not parameter.may_be_left_out and not parameter.choices:
        return ""
    usual = parameter.default
    if isinstance(usual, Value):
        usual = ", ".join(map(str, usual.numbers))
    left_out = f"; left out: {usual}" if usual is not None else ""
    stands_for = f"; left out: `{parameter.stands_for}`" if parameter.stands_for else ""
    return f"{parameter.wanted}{left_out}{stands_for}"


def entry(name: str, one: Any) -> str:
    """Return one name: its signature, its docstring, and its methods or words."""
    if isinstance(one, type) and issubclass(one, StrEnum):
        words = ", ".join(f"`{member.value}`" for member in one)
        return f"### {name}\n\n{prose(one)}\n\nWords: {words}.\n"
    if isinstance(one, type) and issubclass(one, Exception):
        return f"### {name}\n\n{prose(one)}\n"
    written = [f"### {name}\n\n{signature(name, one)}\n\n{prose(one)}\n"]
    if isinstance(one, type):
        members = [
            (member, found)
            for member, found in inspect.getmembers(one)
            if not member.startswith("_") and _is_ours(one, member) and inspect.getdoc(found)
        ]
        written += [
            f"#### {name}.{member}\n\n{signature(member, found)}\n\n{prose(found)}\n"
            for member, found in members
            if callable(found)
        ]
        written += [
            f"#### {name}.{member}\n\n{prose(found)}\n"
            for member, found in members
            if isinstance(found, property | cached_property)
        ]
    return "\n".join(written)


def prose(one: Any) -> str:
    """Return a docstring as Markdown: sections in bold, parameters as a list, doctests as code."""
    text = inspect.getdoc(one) or ""
    text = re.sub(r"^(\w[\w ]*)\n-{3,}$", r"**\1**\n", text, flags=re.MULTILINE)
    lines, code = [], False
    for line in text.splitlines():
        if line.startswith(">>> ") and not code:
            lines += ["```python", line]
            code = True
        elif code and not line:
            lines += ["", "```", ""]
            code = False
        else:
            lines.append(line if code else re.sub(r"^(\w[\w, ]*)$", r"* `\1`", line))
    return "\n".join([*lines, *(["", "```"] if code else [])])


def signature(name: str, one: Any) -> str:
    """Return a call with its parameters, one on a line where they do not fit on one."""
    found = inspect.signature(one)
    shown = [str(each) for each in found.parameters.values() if each.name != "self"]
    marks = [each.kind for each in found.parameters.values() if each.name != "self"]
    if inspect.Parameter.KEYWORD_ONLY in marks:
        shown.insert(marks.index(inspect.Parameter.KEYWORD_ONLY), "*")
    returned = "" if isinstance(one, type) else f" -> {found.return_annotation!s}"
    call = f"{name}({', '.join(shown)}){returned}"
    if len(call) > LINE:
        call = f"{name}(\n" + "".join(f"    {part},\n" for part in shown) + f"){returned}"
    plain = QUOTED_TYPE.sub(r": \1", CLASS.sub(r"\1", ENUM.sub(r"\1", call)))
    return f"```python\n{plain}\n```"


def _is_ours(one: type, name: str) -> bool:
    return any(name in vars(kind) for kind in one.__mro__ if kind.__module__.startswith("nmatrix"))


if __name__ == "__main__":
    PAGE.write_text(reference())
    FUNCTIONS_PAGE.write_text(functions())
