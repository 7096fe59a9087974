"""`python -m nmatrix` and the console script: the same program."""

from __future__ import annotations

import gc
import os
import sys
from pathlib import Path

INSTRUCTION = "_NMATRIX_COMPLETE"  # set by a shell that asks what TAB may offer
YOUNG = 100_000  # objects between two searches for cycles: imports make much that stays


def main() -> None:
    """Run the command line and leave with its exit code.

    Most of a short command is imports, whose objects live to its end. Searching them for cycles
    while they are made, and once more on the way out, would cost a fifth of a handout's time.
    """
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:  # closed by whoever started this: nobody reads it
            setattr(sys, name, Path(os.devnull).open("w"))  # noqa: SIM115
    if (asked := os.environ.get(INSTRUCTION)) is not None:
        from nmatrix.cli.completion import answer

        sys.stdout.buffer.write(f"{answer(asked)}\n".encode("utf-8", "surrogateescape"))
        return
    gc.set_threshold(YOUNG, 20, 20)
    from nmatrix.cli.app import run

    code = run(sys.argv[1:])
    gc.freeze()
    sys.exit(code)


if __name__ == "__main__":
    main()
