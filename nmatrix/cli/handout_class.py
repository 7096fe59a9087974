"""`nmatrix handout --roster`: a folder of sheets, one for everybody, that a rerun completes."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import Executor
from pathlib import Path
from typing import TYPE_CHECKING

from nmatrix.cli.sheet_options import SheetOptions
from nmatrix.cli.show import progress
from nmatrix.cli.workers import WorkerOptions
from nmatrix.errors import IllegalValueError
from nmatrix.output.files import write_file
from nmatrix.output.pages.document import PageFormat
from nmatrix.reading.records import records

if TYPE_CHECKING:
    from nmatrix.classroom.handout import Plan
    from nmatrix.classroom.manifest import Manifest
    from nmatrix.classroom.run import Job


def write_class(
    plan: Plan, roster: str, folder: Path, of: SheetOptions, workers: WorkerOptions, *, force: bool
) -> tuple[list[Path], int]:
    """Write what is missing of a class's sheets into a folder.

    Return all of its files, and how many were written.
    """
    from nmatrix.classroom.handout import pictures_beside
    from nmatrix.classroom.manifest import manifest
    from nmatrix.classroom.roster import COLUMN, students
    from nmatrix.classroom.run import Job, finished

    if of.student is not None:
        raise IllegalValueError(
            "--student with --roster", "the students stand in the file", "leave it out"
        )
    everyone = students(records(roster, (COLUMN,)), roster)
    salt = of.salt_read
    wanted = manifest(plan, of.seed, salt, everyone)
    jobs = [Job(plan, one, of.seed, salt) for one in everyone]
    with workers.executor() as executor:  # refused before anything is written
        if plan.kind is PageFormat.PDF:
            _check_names([one.name for one in everyone], executor)
        missing = _begun(folder, wanted, jobs, force=force)
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
    from nmatrix.output.pages.pdf import check_names

    if executor is None:
        check_names(names)
    else:
        executor.submit(check_names, names).result()


def _begun(folder: Path, wanted: Manifest, jobs: Sequence[Job], *, force: bool) -> list[Job]:
    """Put the manifest into the folder and return what is still to be made.

    With `force` the sheets of an earlier run that this one does not make are taken away: they
    would be handed out with the new ones.
    """
    from nmatrix.classroom.manifest import NAME, check_same, files_of

    _prepare(folder)
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
    """Return whether every file of a student is there; an empty one was damaged."""
    paths = (folder / name for name in job.files)
    return all(path.is_file() and path.stat().st_size > 0 for path in paths)


def _prepare(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise IllegalValueError(
            f"folder ({folder})", error.strerror or "it cannot be made", "choose another with -o"
        ) from None
