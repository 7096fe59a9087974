"""How long handouts take: one HTML sheet against its imports, and a class of PDF sheets with keys.

Run it by hand: `python tests/benchmarks/sheets.py`.
"""

from __future__ import annotations

import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from statistics import median

from startup import MODULE, seconds

ROUNDS = 7
STUDENTS = 500
IMPORTS = [sys.executable, "-c", "import sympy, numpy"]


def sheet_ratio(folder: Path) -> float:
    """Return the median time of one HTML sheet over that of what it must import."""
    words = [*MODULE, "handout", "--force", "-o", str(folder / "sheet.html")]
    pairs = [(seconds(IMPORTS), seconds(words)) for _ in range(ROUNDS + 1)][1:]
    return median(b for _, b in pairs) / median(a for a, _ in pairs)


def class_seconds(folder: Path) -> float:
    """Return the seconds of a class of PDF sheets with keys, by two processes."""
    roster = folder / "class.csv"
    roster.write_text("student\n" + "\n".join(f"student {i}" for i in range(STUDENTS)))
    words = ["handout", "--roster", str(roster), "--to", "pdf", "--key", "--workers", "2"]
    started = time.perf_counter()
    subprocess.run(
        [*MODULE, *words, "-o", str(folder / "sheets")], stdout=subprocess.DEVNULL, check=True
    )
    return time.perf_counter() - started


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        print(f"one sheet {sheet_ratio(folder):5.2f} x (import sympy, numpy), goal 1.6")
        print(f"{STUDENTS} PDF sheets with keys {class_seconds(folder):5.1f} s, goal 60")
        largest = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
        print(f"largest process {largest:5.0f} MiB, goal 500")


if __name__ == "__main__":
    main()
