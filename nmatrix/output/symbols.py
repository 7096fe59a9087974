"""The letter of each quantity: one table, so that every notation calls a thing alike.

They are the letters of the lessons and of the text; docs/conventions.md lists them. A quantity that
has no letter is called by its words.
"""

from __future__ import annotations

import re

from nmatrix.formula import Name, Node, Row, Sign, Words, parse

LETTERS = {
    "world_from_object": "M",
    "camera_from_world": "V",
    "clip_from_camera": "P",
    "clip_from_object": "P V M",
    "space_from_world": "S",
    "space_from_object": "S M",
    "world_from_camera": "V⁻¹",
    "rotation": "R",
    "translation": "T",
    "normal_matrix": "N",
    "cofactor_matrix": "C",
    "to_from": "F",
    "matrix": "F M F⁻¹",
    "determinant": "det A",
    "rank": "rank A",
    "condition": "κ",
    "eye": "e",
    "normals.object": "n",
    "normals.transformed": "n′",
}
_PLACE = re.compile(r"\.\d+(?=\.|$)")  # in a list: spaces.0.eye
_ARROW = re.compile(r"([a-z]+) ← ([a-z]+)")  # from one frame to another
_PLAIN = re.compile(r"[A-Za-z0-9][A-Za-z0-9 ,.'()\[\]/-]*")  # words that every notation can set


def letter(key: str) -> str:
    """Find the letter of a quantity, as one types it; empty if it has none.

    Examples
    --------
    >>> letter("normal_matrix"), letter("spaces.0.space_from_world"), letter("pixel")
    ('N', 'S', '')
    """
    name = _PLACE.sub("", key)
    return LETTERS.get(name) or LETTERS.get(name.rpartition(".")[2], "")


def label(key: str, title: str) -> tuple[Node, str]:
    """Choose what stands before the sign of equality, and what of the title it leaves to say.

    Examples
    --------
    >>> label("normal_matrix", "A⁻ᵀ, the inverse transpose")
    (Name(text='N'), 'A⁻ᵀ, the inverse transpose')
    >>> label("parts.translate", ""), label("steps.0.value", "step 1")
    ((Words(text='translate'), ''), (Words(text='step 1'), ''))
    """
    symbol = letter(key)
    if symbol:
        return parse(symbol), "" if title.strip() == symbol else title
    if _PLAIN.fullmatch(title):
        return _called(title), ""
    if arrow := _ARROW.fullmatch(title):
        return Row((Words(arrow[1]), Sign("←"), Words(arrow[2]))), ""
    return _called(_PLACE.sub("", key).rpartition(".")[2].replace("_", " ")), title


def _called(words: str) -> Node:
    return Name(words) if len(words) == 1 else Words(words)
