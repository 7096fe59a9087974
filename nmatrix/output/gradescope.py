"""Gradescope's `results.json`: the scores of one submission, test by test."""

from __future__ import annotations

import json
from fractions import Fraction

from nmatrix.errors import IllegalValueError, quantity
from nmatrix.output.write import OutputOptions
from nmatrix.report import Report, Score, Submission

DIGITS = 6  # behind the point, of a score


def write(report: Report, options: OutputOptions) -> str:
    """Write the one submission of a report.

    Raises
    ------
    IllegalValueError
        If the command grades nothing, or a class of several.

    Examples
    --------
    >>> done = Submission("Ada", (Score("exercise 1", Fraction(3, 2), 2, "One entry is wrong."),))
    >>> found = json.loads(write(Report("check", {}, (), submissions=(done,)), OutputOptions()))
    >>> found["score"], found["tests"][0]["max_score"]
    (1.5, 2)
    """
    if len(report.submissions) == 1:
        return results(report.submissions[0])
    name = f"{quantity('format')} {options.format} ({report.command})"
    if report.submissions:
        why = f"a file holds one student, and here are {len(report.submissions)}"
        raise IllegalValueError(name, why, f"add {quantity('output')} DIR")
    raise IllegalValueError(name, "this command grades no answer", f"use {quantity('format')} json")


def results(one: Submission) -> str:
    """Write the file of one student."""
    data = {
        "score": _number(sum((score.points for score in one.scores), Fraction(0))),
        "visibility": "visible",
        "tests": [_test(score) for score in one.scores],
    }
    return json.dumps(data, indent=1, ensure_ascii=False) + "\n"


def _test(score: Score) -> dict[str, object]:
    return {
        "name": score.name,
        "score": _number(score.points),
        "max_score": score.most,
        "status": "passed" if score.points == score.most else "failed",
        "output": score.explanation,
    }


def _number(points: Fraction) -> int | float:
    rounded = round(points, DIGITS)
    return int(rounded) if rounded.denominator == 1 else float(rounded)
