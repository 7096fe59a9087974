"""What a class run was asked for; it lies beside the sheets, so that a rerun finishes it."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from hashlib import blake2b

from nmatrix.classroom.handout import HandoutPlan
from nmatrix.classroom.roster import Student, file_names, stem_of
from nmatrix.errors import IllegalValueError, quantity
from nmatrix.lessons.exercises.scheme import SCHEME
from nmatrix.output.pages.document import PageFormat
from nmatrix.version import __version__

NAME = "manifest.json"


@dataclass(frozen=True)
class Manifest:
    """Everything that decides what the sheets hold; the salt and the scene as digests."""

    scheme: str
    version: str
    seed: str
    salt: str
    scene: str
    topics: tuple[str, ...]
    exercises: int
    kind: str
    paper: str
    with_key: bool
    title: str
    points: int | None
    language: str
    students: tuple[str, ...]

    def text(self) -> bytes:
        """Write it as a file."""
        return (json.dumps(asdict(self), indent=1, ensure_ascii=False) + "\n").encode()


def manifest(plan: HandoutPlan, seed: str, salt: bytes, students: tuple[Student, ...]) -> Manifest:
    """Record a run."""
    return Manifest(
        SCHEME,
        __version__,
        seed,
        _digest(salt) if salt else "",
        _digest(repr(plan.setup).encode()),
        tuple(topic.value for topic in plan.topics),
        plan.exercises,
        plan.kind.value,
        plan.paper.value,
        plan.with_key,
        plan.title,
        plan.points,
        plan.language.value,
        tuple(one.name for one in students),
    )


def check_same(wanted: Manifest, found: bytes, folder: str) -> None:
    """Refuse to mix the sheets of two runs; students may have come at the end of the list.

    Raises
    ------
    IllegalValueError
        If the manifest in the folder is that of another run.
    """
    if found == wanted.text():
        return
    try:
        there = json.loads(found)
        here = json.loads(wanted.text())
        differs = [key for key, value in here.items() if there.get(key) != value]
        before = there.get("students")
        came_later = isinstance(before, list) and before == here["students"][: len(before)]
        if differs == ["students"] and came_later:
            return
        why = f"it holds another run: {', '.join(differs) or 'its manifest'} differ"
    except (ValueError, AttributeError):
        why = "its manifest cannot be read"
    raise IllegalValueError(
        f"folder ({folder})",
        why,
        f"choose another one with {quantity('output')}, or {quantity('force')} to write it anew",
    )


def files_of(found: bytes) -> frozenset[str]:
    """Name the sheets and keys that the run of a manifest wrote.

    What is no manifest of ours wrote none.
    """
    try:
        there = json.loads(found)
        kind, names = PageFormat(there["kind"]), there["students"]
        stems = [stem_of(i, str(name)) for i, name in enumerate(names)]
        each = (file_names(stem, kind, with_key=bool(there["with_key"])) for stem in stems)
        return frozenset(name for names in each for name in names)
    except (ValueError, KeyError, TypeError):
        return frozenset()


def _digest(content: bytes) -> str:
    return blake2b(content, digest_size=16).hexdigest()
