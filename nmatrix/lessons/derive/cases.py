"""The lessons that `derive` knows, by name and title; free of SymPy, so that help is fast."""

from __future__ import annotations

from nmatrix.errors import IllegalValueError, did_you_mean

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
    "lightdirection": "A light direction is a vector, not a normal",
    "eye": "Where the eye is in object space",
    "metric": "Lengths and angles in a space that is not rigid",
    "reflection": "Mirrored light, the half vector, and the gate on n · l",
}
ALL = "all"


def chosen(case: str) -> tuple[str, ...]:
    """Choose the cases that a word stands for.

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
        f"case ({case[:40]})",
        f"the cases are {', '.join(TITLES)}, all",
        did_you_mean(case.lower(), (*TITLES, ALL), "try nmatrix derive rule"),
    )
