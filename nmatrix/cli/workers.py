"""Run jobs here, in several processes or on a cluster."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Annotated

from typer import Option

from nmatrix.cli.shared_options import whole_number
from nmatrix.errors import IllegalValueError
from nmatrix.requirements import missing

if TYPE_CHECKING:
    from concurrent.futures import Executor

in_workers = partial(Option, rich_help_panel="Workers")
MOST_WORKERS = 256
PATIENCE = "10s"  # for the scheduler of a cluster to answer


@dataclass(frozen=True)
class WorkerOptions:
    """How many processes, or whose cluster."""

    workers: Annotated[str | None, in_workers(metavar="N", help="So many processes.")] = None
    dask: Annotated[str | None, in_workers(metavar="ADDRESS", help="A cluster.")] = None

    def refuse(self, why: str) -> None:
        """Refuse these options where nothing is shared out."""
        for name, value in (("--workers", self.workers), ("--dask", self.dask)):
            if value is not None:
                raise IllegalValueError(f"{name} ({value[:60]})", why, "leave it out")

    @contextmanager
    def executor(self) -> Iterator[Executor | None]:
        """Open what runs the jobs: nothing, processes, or a cluster's executor."""
        workers = whole_number(self.workers or "1", "--workers", range(1, MOST_WORKERS + 1), 2)
        if self.dask is not None:
            with _cluster(self.dask) as client:
                yield client.get_executor()
        elif workers > 1:
            from concurrent.futures import ProcessPoolExecutor

            with ProcessPoolExecutor(workers) as pool:
                yield pool
        else:
            yield None


def _cluster(address: str):  # type: ignore[no-untyped-def]  # noqa: ANN202  # an optional package's client
    try:
        from distributed import Client
    except ImportError:
        raise missing(f"--dask {address[:60]}", "distributed") from None
    try:
        return Client(address, timeout=PATIENCE)
    except (OSError, ValueError) as error:
        raise IllegalValueError(
            f"--dask ({address[:60]})", f"no scheduler answers there ({error})", "check the address"
        ) from None
