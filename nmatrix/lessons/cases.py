"""The lessons that `derive` knows, by name and title; free of SymPy, so that help is fast."""

from __future__ import annotations

from nmatrix.errors import IllegalValueError

TITLES: dict[str, str] = {
    "rule": "Why normals move by the inverse transpose",
    "cofactor": "The cofactor matrix, and the sign that it lacks",
    "translation": "What a translation does to normals",
    "rotation": "A rotation is its own inverse transpose",
    "uniform": "A uniform scale changes lengths only",
    "nonuniform": "A non-uniform scale bends normals",
    "shear": "A shear has determinant 1 and bends normals",
    "mirror": "A mirror, its determinant and the outward side",
    "singular": "What is left when space is flattened",
}
ALL = "all"


def chosen(case: str) -> tuple[str, ...]:
    """Return the cases that a word stands for.

    Raises
    ------
    IllegalValueError
        If no case has this name.

    Examples
    --------
    >>> chosen("mirror")
    ('mirror',)
    """
    if case == ALL:
        return tuple(TITLES)
    if case in TITLES:
        return (case,)
    raise IllegalValueError(
        f"case ({case[:40]})", f"the cases are {', '.join(TITLES)}, all", "try nmatrix derive rule"
    )
