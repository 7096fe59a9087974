"""A sheet: exercises that take turns through the kinds, each drawn by itself."""

from __future__ import annotations

from nmatrix.errors import IllegalValueError
from nmatrix.lessons.exercises import choices, matrices, tracing
from nmatrix.lessons.exercises.exercise import Exercise, ExerciseKind
from nmatrix.lessons.exercises.matrices import Build
from nmatrix.lessons.exercises.scheme import Draws, Sheet

MOST = 100  # exercises of one sheet
ATTEMPTS = 200  # until the numbers of an exercise show its planned mistakes

BUILDERS: dict[ExerciseKind, Build] = {
    ExerciseKind.WORLD: matrices.world_matrix,
    ExerciseKind.NORMAL: matrices.normal_matrix,
    ExerciseKind.WHICH_SPACE: choices.which_space,
    ExerciseKind.LIGHT: matrices.light_in_camera,
    ExerciseKind.EYE: matrices.eye_in_object,
    ExerciseKind.SHORTCUT: choices.short_cut,
    ExerciseKind.TRACE: tracing.trace,
    ExerciseKind.MISTAKE: choices.find_the_mistake,
    ExerciseKind.MIRROR_SINGULAR: matrices.mirrored,
    ExerciseKind.CONCEPT: choices.concept,
}


def exercise(number: int, sheet: Sheet) -> Exercise:
    """Make one exercise of a sheet; it does not depend on how many there are.

    Raises
    ------
    IllegalValueError
        For a number below 1 or above the most.

    Examples
    --------
    >>> exercise(1, Sheet("7", "Ada")) == exercise(1, Sheet("7", "Ada"))
    True
    """
    if not 1 <= number <= MOST:
        raise IllegalValueError(
            f"exercise ({number})", f"a sheet has 1 to {MOST}", "give a number from the sheet"
        )
    build = BUILDERS[ExerciseKind.of(number)]
    for attempt in range(ATTEMPTS):
        found = build(Draws(sheet, number, attempt))
        if found is not None:
            return found
    raise AssertionError(f"exercise {number} of {sheet} found no numbers")


def exercises(count: int, sheet: Sheet) -> tuple[Exercise, ...]:
    """Make the first exercises of a sheet."""
    return tuple(exercise(number, sheet) for number in range(1, count + 1))
