"""A correction of one finding, as text in place of text; none where it would be a guess."""

from __future__ import annotations

from dataclasses import dataclass

from nmatrix.lint.judging import Fault
from nmatrix.lint.tree import Shader, Span


@dataclass(frozen=True)
class Change:
    """New text in place of a piece of a source."""

    span: Span
    text: str


def fixed(fault: Fault, shader: Shader, content: bytes) -> Change | None:
    """Correct a finding where one change of its expression is right.

    Examples
    --------
    >>> from nmatrix.lint.program import lint
    >>> text = b"in vec3 vNormal; void main() { float d = dot(vNormal, vec3(1.0)); }"
    >>> found = lint({"a.frag": text})
    >>> fixed(found.faults[0], found.shaders[0], text).text
    'normalize(vNormal)'
    """
    return None
