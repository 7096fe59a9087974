"""`nmatrix handout`: a sheet to print, or a folder of them for a class."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from typer import Option

from nmatrix.cli.camera_options import LensOptions, ViewOptions
from nmatrix.cli.everywhere import Everywhere
from nmatrix.cli.scene_group import SceneOptions
from nmatrix.cli.scene_options import Groups, SpaceOptions
from nmatrix.cli.sheet_options import SheetOptions
from nmatrix.cli.show import show
from nmatrix.cli.workers import WorkerOptions
from nmatrix.cli.world_options import LightOptions, WorldOptions
from nmatrix.errors import IllegalValueError
from nmatrix.output.files import refuse_existing, write_file
from nmatrix.output.pages.document import PageFormat, Paper
from nmatrix.report import Block, Report, Text, Verdict

if TYPE_CHECKING:
    from nmatrix.classroom.handout import Plan
    from nmatrix.classroom.topics import Topic

HELP = {
    "handout": """nmatrix handout --scale 1 2 1

nmatrix handout --topics rule,exercises --exercises 10 --student Ada --key --to pdf

nmatrix handout --roster class.csv --seed 7 --to pdf --key -o sheets

A printable sheet: theory, numbers, pictures, exercises; or one for everybody in a class.""",
}

USUAL_EXERCISES = 10
USUAL_NAME, USUAL_FOLDER = "handout", "handouts"


@dataclass(frozen=True)
class HandoutOptions:
    """What stands on the sheet, and what it is printed on."""

    to: Annotated[PageFormat, Option("--to", help="The format of the file.")] = PageFormat.HTML
    topics: Annotated[
        str | None,
        Option(metavar="WORDS", help="rule, worked, spaces, proofs, pitfalls, cost, exercises."),
    ] = None
    exercises: Annotated[
        str | None, Option(metavar="N", help="So many exercises (10 with that topic).")
    ] = None
    roster: Annotated[
        str | None, Option(metavar="FILE", help="A .csv with a column student: one sheet each.")
    ] = None
    key: Annotated[bool, Option("--key", help="Write the answers too, as a second file.")] = False
    paper: Annotated[Paper, Option(help="What it is printed on.")] = Paper.A4
    output: Annotated[
        str | None, Option("--output", "-o", metavar="FILE", help="A folder with --roster.")
    ] = None
    force: Annotated[bool, Option("--force", help="Overwrite what is there.")] = False

    def chosen_topics(self) -> tuple[Topic, ...]:
        """Return the topics, in the order in which they are printed."""
        from nmatrix.classroom.topics import USUAL, Topic

        wants_exercises = self.exercises is not None or self.roster is not None
        if self.topics is None:
            usual = () if self.roster is not None else USUAL
            return (*usual, Topic.EXERCISES) if wants_exercises or self.key else usual
        words = [word.strip() for word in self.topics.split(",")]
        for word in words:
            if word not in list(Topic):
                raise IllegalValueError(
                    f"--topics ({word[:20]})", f"they are {', '.join(Topic)}", "choose from them"
                )
        if wants_exercises and Topic.EXERCISES not in words:
            words.append(Topic.EXERCISES)
        return tuple(topic for topic in Topic if topic in words)

    def count(self) -> int:
        """Return how many exercises there are."""
        from nmatrix.lessons.exercises.sheet import MOST

        typed = str(USUAL_EXERCISES) if self.exercises is None else self.exercises
        if typed.isascii() and typed.isdigit() and len(typed) < 9 and 1 <= int(typed) <= MOST:
            return int(typed)
        raise IllegalValueError(f"--exercises ({typed[:20]})", f"a sheet has 1 to {MOST}", "try 10")


def handout(
    *,
    world: WorldOptions,
    view: ViewOptions,
    lens: LensOptions,
    light: LightOptions,
    space: SpaceOptions,
    scene: SceneOptions,
    options: HandoutOptions,
    of: SheetOptions,
    workers: WorkerOptions,
    everywhere: Everywhere,
) -> None:
    """Write a handout."""
    from nmatrix.classroom.handout import Plan
    from nmatrix.classroom.topics import Topic

    topics = options.chosen_topics()
    has_exercises = Topic.EXERCISES in topics
    if options.key and not has_exercises:
        raise IllegalValueError("--key", "there are no exercises to answer", "add --exercises 10")
    if options.to is PageFormat.PDF:
        from nmatrix.output.pages.pdf import check_typst

        check_typst()
    setup = Groups(world, view, lens, light, space, scene=scene).setup(everywhere)
    count = options.count() if has_exercises else 0
    plan = Plan(topics, setup, count, options.to, options.paper, options.key)
    if options.roster is None:
        files = _one(plan, options, of)
        made = len(files)
    else:
        from nmatrix.cli.handout_class import write_class

        folder = Path(options.output or USUAL_FOLDER)
        files, made = write_class(plan, options.roster, folder, of, workers, force=options.force)
    show(_report(files, made, options), everywhere)


def _one(plan: Plan, options: HandoutOptions, of: SheetOptions) -> list[Path]:
    """Write one sheet, its pictures where they stand beside it, and its key."""
    from nmatrix.classroom.handout import pictures_beside, written

    if plan.kind is PageFormat.PDF:
        from nmatrix.output.pages.pdf import check_names

        check_names([of.student or ""])
    from nmatrix.output.pages.write import WITH_PICTURES_BESIDE

    path = Path(options.output or f"{USUAL_NAME}.{plan.kind}")
    key = path.with_name(f"{path.stem}-key{path.suffix}")
    refuse_existing([path, key] if plan.with_key else [path], force=options.force)
    has_pictures_beside = plan.kind in WITH_PICTURES_BESIDE
    plan = replace(plan, prefix=f"{path.stem}-" if has_pictures_beside else "")
    found = written(plan, of.sheet)
    contents = [(path, found.sheet)]
    if found.key is not None:
        contents.append((key, found.key))
    beside = [(path.with_name(name), one) for name, one in pictures_beside(plan).items()]
    contents += [(place, one) for place, one in beside if not _is_there(place, one)]
    refuse_existing([target for target, _ in contents], force=options.force)
    for target, content in contents:
        write_file(target, content, force=options.force)
    return [target for target, _ in contents]


def _is_there(path: Path, content: bytes) -> bool:
    """Return whether a picture was written before, for another format."""
    return path.is_file() and path.read_bytes() == content


def _report(files: Sequence[Path], made: int, options: HandoutOptions) -> Report:
    names = [str(path) for path in files]
    shown = ", ".join(names[:3]) + (f" and {len(names) - 3} more" if len(names) > 3 else "")
    told = f"Written: {shown}"
    if made < len(names):
        told = f"Complete: {shown}; {made} of {len(names)} files were missing and are written"
    blocks: list[Block] = [Verdict(told)]
    if options.to is PageFormat.HTML:
        them = "it" if len(names) == 1 else "them"
        blocks.append(Text(f"Open {them} in a browser and print {them}."))
    return Report("handout", {"files": names}, tuple(blocks))
