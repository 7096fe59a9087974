"""How long `lint` takes for 300 shaders of the corpus: `python tests/benchmarks/lint.py`."""

from __future__ import annotations

import sys
from pathlib import Path
from time import process_time

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from shader_programs import CORRECT, FAULTY

from nmatrix.answers.lint import Source, report

SHADERS = 300


def main() -> None:
    """Print the seconds of the processor for parsing, following and reporting."""
    programs = [*FAULTY.values(), *CORRECT.values()]
    sources: list[Source] = []
    while len(sources) < SHADERS:
        folder = len(sources)
        for program in programs:
            sources += [Source(f"{folder}/{name}", text) for name, text in program.items()]
    sources = sources[:SHADERS]
    report(sources[:2])  # the grammars are loaded once
    start = process_time()
    found = report(sources)
    lines = sum(one.text.count("\n") for one in sources)
    seconds = process_time() - start
    print(
        f"{SHADERS} shaders, {lines} lines: {seconds:.2f} s, {len(found.data['findings'])} findings"
    )


if __name__ == "__main__":
    main()
