"""How long `check` takes: one answer against `nmatrix world`, and answers a second in a class.

Run it by hand: `python tests/benchmarks/check.py`.
"""

from __future__ import annotations

import random
import time
from itertools import product
from statistics import median

from startup import MODULE, ROUNDS, seconds

from nmatrix.answers.exercise import exercises_of
from nmatrix.answers.grades import answers_to, grades
from nmatrix.lessons.check.judge import Judge
from nmatrix.lessons.check.question import Question, Subject
from nmatrix.lessons.exercises.scheme import Sheet
from nmatrix.lessons.exercises.sheet import exercise
from nmatrix.reading.records import Record
from nmatrix.scene.setup import Setup
from nmatrix.scene.world import World

PLACED = "--scale 1 2 1 --rotate 20 35 -50".split()
LINES = {
    "a right answer": ["check", "eye", "0 0 5", *PLACED],
    "a mistake": ["check", "normal", "1 0 0; 0 2 0; 0 0 1", "--scale", "1", "2", "1"],
    "an unexplained world": ["check", "world", "1 0 0; 0 7 0; 0 0 1", *PLACED],
    "an unexplained view": [
        "check",
        "view",
        "1 0 0 3; 0 1 0 2; 0 0 1 7; 0 0 0 1",
        "--eye",
        "3 1 2",
    ],
    "an unexplained vertex": ["check", "trace", "0.3 0.2 0.7", "--point", "1 1 1", *PLACED],
}
CLASS = 2_000
STUDENTS, OF_NUMBERS, SEED = 40, (1, 2, 4, 5, 7, 9), "7"


def ratio(words: list[str]) -> float:
    """Return the median time of a command over the median time of `nmatrix world`."""
    world = [*MODULE, "world", *PLACED]
    pairs = [(seconds(world), seconds([*MODULE, *words])) for _ in range(ROUNDS + 1)][1:]
    return median(b for _, b in pairs) / median(a for a, _ in pairs)


def rate(values: list[tuple[tuple[float, ...], ...]], question: Question) -> float:
    """Return how many different answers a second are graded."""
    draw = random.Random(1)
    rows = [
        Record(i, {"student": str(i), "answer": "; ".join(_typed(row, draw) for row in value)})
        for i, value in enumerate(draw.choices(values, k=CLASS))
    ]
    start = time.perf_counter()
    grades(rows, answers_to(question))
    return CLASS / (time.perf_counter() - start)


def _typed(row: tuple[float, ...], draw: random.Random) -> str:
    return " ".join(f"{float(x):.{draw.randint(4, 9)}f}" for x in row)


def exercises_with_numbers() -> dict[str, list[dict[str, str]]]:
    """Return answers to exercises of which each student has numbers of his own."""
    found: dict[str, list[dict[str, str]]] = {"right": [], "planned": []}
    for i, number in product(range(STUDENTS), OF_NUMBERS):
        one = exercise(number, Sheet(SEED, f"student {i}"))
        cells = {"student": f"student {i}", "exercise": str(number)}
        found["right"].append({**cells, "answer": one.right})
        found["planned"] += [{**cells, "answer": wrong.text} for wrong in one.planned[:1]]
    return found


def graded(rows: list[dict[str, str]]) -> float:
    """Return how many answers to exercises are graded a second."""
    judge = exercises_of(SEED, b"")
    start = time.perf_counter()
    for row in rows:
        judge(row)
    return len(rows) / (time.perf_counter() - start)


def main() -> None:
    for name, words in LINES.items():
        print(f"check, {name:22} {ratio(words):5.2f} x nmatrix world, goal 1.3")
    world = World(scale=(1, 2, 1), rotate_degrees=(30, 60, 20), shear=(1, 0, 0))
    question = Question(Subject.NORMAL, Setup(world))
    judge, draw = Judge(question), random.Random(2)
    noise = [tuple(tuple(draw.gauss(0, 1) for _ in range(3)) for _ in range(3)) for _ in range(999)]
    pools = {
        "right": [judge.right],
        "one mistake": [one.value for one in judge.singles],
        "two mistakes": [one.value for one in judge.doubles],
        "random numbers": noise,
    }
    for name, values in pools.items():
        print(f"a class, {name:15} {rate(values, question):7.0f} answers a second, goal 500")
    for name, texts in exercises_with_numbers().items():
        print(f"exercises, {name:13} {graded(texts):7.0f} answers a second, goal 500")


if __name__ == "__main__":
    main()
