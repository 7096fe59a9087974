"""A whole class: one job for each student, run here, by processes or by a cluster.

A job gets all that it needs and gives back bytes: workers may share no disk. What is written is
complete. A cluster gives what a lost worker was at to another one; a process that is killed ends
the run, and the next run goes on where it stopped.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, Future, wait
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from itertools import islice

from nmatrix.classroom.handout import Plan, Written, written
from nmatrix.classroom.roster import Student, file_names
from nmatrix.errors import IllegalValueError, quantity
from nmatrix.lessons.exercises.scheme import Sheet

AT_ONCE = 64  # jobs that wait for a worker: enough to keep many busy, few enough to hold


@dataclass(frozen=True)
class Job:
    """One student's sheet."""

    plan: Plan
    student: Student
    seed: str
    salt: bytes

    @property
    def files(self) -> tuple[str, ...]:
        """Return the names of the files that it makes: the sheet, then the key."""
        return file_names(self.student.stem, self.plan.kind.value, with_key=self.plan.with_key)


def run(job: Job) -> tuple[Job, Written]:
    """Make one student's files."""
    return job, written(job.plan, Sheet(job.seed, job.student.name, job.salt))


def finished(jobs: Sequence[Job], executor: Executor | None) -> Iterator[tuple[Job, Written]]:
    """Give the files of every student, in whatever order they are done.

    Raises
    ------
    IllegalValueError
        If one of the processes was killed.
    """
    if executor is None:
        yield from map(run, jobs)
        return
    try:
        yield from _finished_by(jobs, executor)
    except BrokenProcessPool:
        raise IllegalValueError(
            quantity("workers"),
            "one of the processes was killed",
            "run it again: it goes on where it stopped (fewer workers need less memory)",
        ) from None


def _finished_by(jobs: Sequence[Job], executor: Executor) -> Iterator[tuple[Job, Written]]:
    left = iter(jobs)
    waiting: set[Future[tuple[Job, Written]]] = {
        executor.submit(run, job) for job in islice(left, AT_ONCE)
    }
    while waiting:
        done, waiting = wait(waiting, return_when=FIRST_COMPLETED)
        for future in done:
            waiting |= {executor.submit(run, job) for job in islice(left, 1)}
            yield future.result()
