"""`nmatrix handout`: a sheet to print, or a folder of them for a class."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from typer import Option

from nmatrix.classroom.bank.write import BankFormat
from nmatrix.classroom.words import Language
from nmatrix.cli.class_files import class_list, write_bank, write_merged
from nmatrix.cli.scene_options import OptionGroups
from nmatrix.cli.shared_options import MOST_POINTS, CommonOptions, among, whole_number
from nmatrix.cli.sheet_options import SheetOptions
from nmatrix.cli.show import progress, show
from nmatrix.cli.workers import WorkerOptions
from nmatrix.errors import IllegalValueError, counted, did_you_mean
from nmatrix.output.files import kind_of, refuse_existing, write_file
from nmatrix.output.pages.document import PAGES, WITH_PICTURES_BESIDE, PageFormat, Paper
from nmatrix.report import Block, Report, Text, Verdict
from nmatrix.samples import samples

if TYPE_CHECKING:
    from concurrent.futures import Executor

    from nmatrix.classroom.handout import HandoutPlan
    from nmatrix.classroom.manifest import Manifest
    from nmatrix.classroom.roster import Student
    from nmatrix.classroom.run import Job
    from nmatrix.classroom.topics import Topic

HELP = {
    "handout": """nmatrix handout --scale 1 2 1

nmatrix handout --roster class --seed 7 --key -o sheets

nmatrix handout --to moodle --variants 20 -o bank.xml

With a roster everybody in a class gets a sheet of their own, and a rerun completes the folder.""",
}

USUAL_EXERCISES = 10
USUAL_NAME, USUAL_FOLDER = "handout", "handouts"


def _topics() -> list[str]:
    from nmatrix.classroom.topics import Topic

    return list(Topic)


@dataclass(frozen=True)
class HandoutOptions:
    """What stands on the sheet, and what it is printed on."""

    to: Annotated[
        str | None,
        Option(
            "--to",
            metavar="FORMAT",
            help="html, pdf, typ, tex, md, or the platform: moodle, qti, canvas (html).",
            autocompletion=among([*PageFormat, *BankFormat]),
        ),
    ] = None
    topics: Annotated[
        str | None,
        Option(
            metavar="WORDS",
            help="rule, spaces, exercises, worked, proofs, pitfalls, cost.",
            autocompletion=among(_topics),
        ),
    ] = None
    exercises: Annotated[
        str | None, Option(metavar="N", help="So many exercises (10 with that topic).")
    ] = None
    roster: Annotated[
        str | None,
        Option(
            metavar="FILE",
            help="A .csv with a column student: one sheet each.",
            autocompletion=among(samples, ".csv"),
        ),
    ] = None
    merged: Annotated[
        str | None,
        Option(metavar="FILE.pdf", help="With --roster: all sheets in one file, to print."),
    ] = None
    variants: Annotated[
        str | None, Option(metavar="N", help="To a platform: so many sheets, for no one by name.")
    ] = None
    title: Annotated[
        str | None,
        Option(
            metavar="TEXT", help="What stands at the head: course, sheet, date (lines to fill)."
        ),
    ] = None
    points: Annotated[str | None, Option(metavar="N", help="Of each exercise (a box to fill).")] = (
        None
    )
    language: Annotated[Language, Option(help="Of the fixed words; what is asked is English.")] = (
        Language.ENGLISH
    )
    key: Annotated[bool, Option("--key", help="Write the answers too, as a second file.")] = False
    paper: Annotated[Paper, Option(help="What it is printed on.")] = Paper.A4
    output: Annotated[
        str | None, Option("--output", "-o", metavar="FILE", help="A folder with --roster.")
    ] = None
    force: Annotated[bool, Option("--force", help="Overwrite what is there.")] = False

    @property
    def usual_name(self) -> str:
        """The name of a file that is given none, without its ending."""
        return USUAL_NAME

    @cached_property
    def platform(self) -> BankFormat | None:
        """The learning platform that --to names, if it does."""
        self._check_to()
        return BankFormat(self.to) if self.to in list(BankFormat) else None

    @cached_property
    def page(self) -> PageFormat | None:
        """The format on paper that --to names, if it does."""
        self._check_to()
        return PageFormat(self.to) if self.to in list(PageFormat) else None

    def _check_to(self) -> None:
        known = [*PageFormat, *BankFormat]
        if self.to is not None and self.to not in known:
            raise IllegalValueError(
                f"--to ({self.to[:20]})",
                f"it is one of {', '.join(known)}",
                did_you_mean(self.to, known, "choose one of them"),
            )

    @cached_property
    def kind(self) -> PageFormat:
        """The format that --to names, or the ending of the sheet's own file."""
        if self.output is None or self.roster is not None:
            return self.page or PageFormat.HTML
        if Path(self.output).is_dir():
            raise IllegalValueError(
                f"--output ({self.output[:60]})",
                "it is a folder, and one sheet is a file; a class with --roster goes into a folder",
                f"name a file in it, such as {USUAL_NAME}{next(iter(PAGES))}",
            )
        named = kind_of(Path(self.output), PAGES)
        if self.page not in (None, named):
            raise IllegalValueError(
                f"--to {self.to} with --output ({self.output[:60]})",
                "they name two formats",
                "keep one of them",
            )
        return named

    def chosen_topics(self) -> tuple[Topic, ...]:
        """Choose the topics, in the order in which they are printed."""
        from nmatrix.classroom.topics import USUAL, Topic

        wants_exercises = self.exercises is not None or self.roster is not None
        if self.topics is None:
            words = [] if self.roster is not None else [topic.value for topic in USUAL]
            wants_exercises = wants_exercises or self.key
        else:
            words = [word.strip() for word in self.topics.split(",")]
        for word in words:
            if word not in list(Topic):
                raise IllegalValueError(
                    f"--topics ({word[:20]})", f"they are {', '.join(Topic)}", "choose from them"
                )
        if wants_exercises and Topic.EXERCISES not in words:
            words.append(Topic.EXERCISES)
        return tuple(topic for topic in Topic if topic in words)

    def check_merged(self) -> None:
        """Refuse a merged file where there is no class, or where files of each are wanted too."""
        if self.merged is None:
            return
        clashes = {
            "without --roster": (self.roster is None, "add --roster FILE.csv"),
            "with --output": (self.output is not None, "leave one of them out"),
            f"with --to {self.to}": (self.to not in (None, "pdf"), "leave --to out"),
        }
        for how, (is_so, next_step) in clashes.items():
            if is_so:
                why = "it is one PDF of all sheets of a class"
                raise IllegalValueError(f"--merged {how}", why, next_step)

    def count(self) -> int:
        """Read the number of exercises."""
        from nmatrix.lessons.exercises.sheet import MOST

        typed = str(USUAL_EXERCISES) if self.exercises is None else self.exercises
        why = f"a sheet has 1 to {MOST}"
        return whole_number(typed, "--exercises", range(1, MOST + 1), USUAL_EXERCISES, why)

    def points_of_each(self) -> int | None:
        """Read the points of an exercise."""
        if self.points is None:
            return None
        why = f"an exercise has 1 to {MOST_POINTS}"
        return whole_number(self.points, "--points", range(1, MOST_POINTS + 1), 4, why)


def handout(
    *,
    groups: OptionGroups,
    options: HandoutOptions,
    sheet: SheetOptions,
    workers: WorkerOptions,
    common: CommonOptions,
) -> None:
    """Write a handout."""
    from nmatrix.classroom.handout import HandoutPlan
    from nmatrix.classroom.topics import Topic

    if options.platform is not None:
        workers.refuse("a bank is one file")
        show(write_bank(options.platform, options, groups, sheet), common)
        return
    options.check_merged()
    if options.merged is not None:
        workers.refuse("one file is written as a whole")
    if options.variants is not None:
        why = "a sheet on paper has one student"
        raise IllegalValueError("--variants", why, "add --to moodle, or use --roster FILE")
    topics = options.chosen_topics()
    has_exercises = Topic.EXERCISES in topics
    for option, is_given in (("--key", options.key), ("--points", options.points is not None)):
        if is_given and not has_exercises:
            raise IllegalValueError(option, "there are no exercises", "add --exercises 10")
    if options.kind is PageFormat.PDF or options.merged is not None:
        from nmatrix.output.pages.page_pdf import check_typst

        check_typst()
    setup = groups.setup(common)
    count = options.count() if has_exercises else 0
    plan = HandoutPlan(
        topics, setup, count, options.kind, options.paper, options.key,
        title=" ".join((options.title or "").split()), points=options.points_of_each(),
        language=options.language,
    )  # fmt: skip
    remarks: tuple[str, ...] = ()
    if options.roster is None:
        files = _one(plan, options, sheet)
        made = len(files)
    else:
        everyone, remarks = class_list(options.roster)
        if options.merged is not None:
            files = write_merged(plan, everyone, options, sheet)
            made = len(files)
        else:
            files, made = _write_class(plan, everyone, options, sheet, workers)
    show(replace(_report(files, made, options), remarks=remarks), common)


def _one(plan: HandoutPlan, options: HandoutOptions, sheet: SheetOptions) -> list[Path]:
    """Write one sheet, its pictures where they stand beside it, and its key."""
    from nmatrix.classroom.handout import pictures_beside, student_files

    if plan.kind is PageFormat.PDF:
        from nmatrix.output.pages.page_pdf import check_names

        check_names([sheet.student or ""])
    path = Path(options.output or f"{USUAL_NAME}.{plan.kind}")
    key = path.with_name(f"{path.stem}-key{path.suffix}")
    refuse_existing([path, key] if plan.with_key else [path], force=options.force)
    plan = replace(plan, prefix=f"{path.stem}-" if plan.kind in WITH_PICTURES_BESIDE else "")
    found = student_files(plan, sheet.identity)
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
    """Whether a picture was written before, for another format."""
    return path.is_file() and path.read_bytes() == content


def _write_class(
    plan: HandoutPlan,
    everyone: Sequence[Student],
    options: HandoutOptions,
    sheet: SheetOptions,
    workers: WorkerOptions,
) -> tuple[list[Path], int]:
    """Write the sheets of a class that a folder lacks; all its files, and how many were missing."""
    from nmatrix.classroom.handout import pictures_beside
    from nmatrix.classroom.manifest import manifest
    from nmatrix.classroom.run import Job, finished

    seed, salt = sheet.of_a_class("--roster")
    wanted = manifest(plan, seed, salt, tuple(everyone))
    jobs = [Job(plan, one, seed, salt) for one in everyone]
    folder = Path(options.output or USUAL_FOLDER)
    with workers.executor() as executor:  # refused before anything is written
        if plan.kind is PageFormat.PDF:
            _check_names([one.name for one in everyone], executor)
        missing = _start_or_resume(folder, wanted, jobs, force=options.force)
        for name, content in pictures_beside(plan).items():
            write_file(folder / name, content, force=True)
        for job, found in progress(finished(missing, executor), len(missing), "writing sheets"):
            contents = (found.sheet,) if found.key is None else (found.sheet, found.key)
            for name, content in zip(job.files, contents, strict=True):
                write_file(folder / name, content, force=True)
    made = sum(len(job.files) for job in missing)
    return [folder / name for job in jobs for name in job.files], made


def _check_names(names: Sequence[str], executor: Executor | None) -> None:
    """Refuse names that a PDF cannot print, where its fonts are: at the workers, if there are any.

    A process that has used Typst must not be forked: its threads would be missing in the copies.
    """
    from nmatrix.output.pages.page_pdf import check_names

    if executor is None:
        check_names(names)
    else:
        executor.submit(check_names, names).result()


def _start_or_resume(
    folder: Path, wanted: Manifest, jobs: Sequence[Job], *, force: bool
) -> list[Job]:
    """Put the manifest into the folder; the jobs that are still to be done.

    With `force` the sheets of an earlier run that this one does not make are taken away: they
    would be handed out with the new ones.
    """
    from nmatrix.classroom.manifest import NAME, check_same, files_of

    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise IllegalValueError(
            f"folder ({folder})", error.strerror or "it cannot be made", "choose another with -o"
        ) from None
    path = folder / NAME
    before = path.read_bytes() if path.exists() else None
    if before is not None and not force:
        check_same(wanted, before, str(folder))
    write_file(path, wanted.text(), force=True)
    if before is not None and not force:
        return [job for job in jobs if not _is_complete(job, folder)]
    for name in files_of(before or b"") - {name for job in jobs for name in job.files}:
        (folder / name).unlink(missing_ok=True)
    return list(jobs)


def _is_complete(job: Job, folder: Path) -> bool:
    """Whether every file of a student is there; an empty one was damaged."""
    paths = (folder / name for name in job.files)
    return all(path.is_file() and path.stat().st_size > 0 for path in paths)


def _report(files: Sequence[Path], made: int, options: HandoutOptions) -> Report:
    names = list(map(str, files))
    shown = ", ".join(names[:3]) + (f" and {len(names) - 3} more" if len(names) > 3 else "")
    told = f"Written: {shown}"
    if made < len(names):
        told = f"Complete: {shown}; missing until now: {made} of {counted(len(names), 'file')}"
    blocks: list[Block] = [Verdict(told)]
    if options.kind is PageFormat.HTML:
        them = "it" if len(names) == 1 else "them"
        blocks.append(Text(f"Open {them} in a browser and print {them}."))
    return Report("handout", {"files": names}, tuple(blocks))
