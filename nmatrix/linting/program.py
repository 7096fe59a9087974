"""Files become programs, and programs findings: `lint` reads sources and tells what it found.

Files of one folder that differ only behind the stem are one program.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import PurePath

from nmatrix.enums import ShaderLanguage
from nmatrix.linting.declarations import Conventions
from nmatrix.linting.faults import Evidence, Fault
from nmatrix.linting.following import Following, Passed
from nmatrix.linting.judging import Judge
from nmatrix.linting.parsing import parse
from nmatrix.linting.source import STAGES
from nmatrix.linting.tree import Shader, Stage

_ORDER = {Stage.VERTEX: 0, Stage.BETWEEN: 1, Stage.UNKNOWN: 2, Stage.FRAGMENT: 3}


@dataclass(frozen=True)
class Linted:
    """What was found in files: the faults, and the spaces of names, by file."""

    shaders: tuple[Shader, ...]
    faults: tuple[Fault, ...]
    spaces: Mapping[str, Mapping[str, tuple[str, str]]]


def lint(
    sources: Mapping[str, bytes],
    language: ShaderLanguage | None = None,
    *,
    are_one_program: bool = False,
) -> Linted:
    """Read shaders, follow them as programs, and collect what is wrong in the order of the files.

    Raises
    ------
    MissingPackageError
        Without the grammars.

    Examples
    --------
    >>> text = b"uniform mat4 model; in vec3 aNormal; out vec3 n;"
    >>> text += b"void main() { n = mat3(model) * aNormal; }"
    >>> [fault.rule.value for fault in lint({"a.vert": text}).faults]
    ['NM101']
    """
    shaders = [parse(name, content, language) for name, content in sources.items()]
    faults: list[Fault] = []
    spaces: dict[str, dict[str, tuple[str, str]]] = {}
    for program in [tuple(shaders)] if are_one_program else programs(shaders):
        found, known = _follow(program, sources)
        faults += found
        spaces |= known
    place = {name: place for place, name in enumerate(sources)}
    faults.sort(key=lambda one: (place[one.span.file], one.span.start, one.span.end))
    return Linted(tuple(shaders), tuple(faults), {name: spaces.get(name, {}) for name in sources})


def programs(shaders: Sequence[Shader]) -> list[tuple[Shader, ...]]:
    """Put together what runs together: files of one folder and stem, in the order of stages.

    Examples
    --------
    >>> made = [parse(name, b"") for name in ("a.vert", "b.vert", "a.frag")]
    >>> [[one.file for one in program] for program in programs(made)]
    [['a.vert', 'a.frag'], ['b.vert']]
    """
    by_stem: dict[tuple[str, str, ShaderLanguage], list[Shader]] = {}
    for one in shaders:
        path = PurePath(one.file)
        by_stem.setdefault((str(path.parent), _stem(path.name), one.language), []).append(one)
    return [tuple(together) for together in by_stem.values()]


def _stem(name: str) -> str:
    words = re.split(r"([._-])", name)
    kept = [word for place, word in enumerate(words) if place == 0 or word.lower() not in STAGES]
    first = "".join(kept).rstrip("._-")
    return first.removesuffix(".glsl").removesuffix(".hlsl").lower()


def _follow(
    program: Iterable[Shader], sources: Mapping[str, bytes]
) -> tuple[list[Fault], dict[str, dict[str, tuple[str, str]]]]:
    """Follow a program twice: what the first reading shows, the second one takes for known."""
    program = sorted(program, key=lambda one: _ORDER[one.stage])
    evidence = Evidence()

    conventions = Conventions()
    judge = Judge(evidence)
    for _ in range(2):
        judge = Judge(evidence)
        passed = Passed()
        spaces = {}
        for shader in program:
            one = Following(shader, judge, passed, conventions)
            one.follow()
            spaces[shader.file] = one.spaces
        conventions = Conventions(
            _named_are_transposed(program, evidence),
            evidence.projects_world and not evidence.has_view,
        )
    return list(judge.faults.values()), spaces


def _named_are_transposed(program: Sequence[Shader], evidence: Evidence) -> bool | None:
    """Tell from the side on which points stand whether named matrices are made for rows."""
    on_the_right, on_the_left = evidence.sides[False], evidence.sides[True]
    if on_the_left and not on_the_right:
        return True
    if on_the_right >= 3 * on_the_left and on_the_right:
        return False
    is_glsl = program[0].language is ShaderLanguage.GLSL
    return False if is_glsl and not on_the_left else None
