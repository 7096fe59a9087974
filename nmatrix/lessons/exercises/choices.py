"""Exercises that are answered by a letter: spaces, short cuts, found mistakes, concepts."""

from __future__ import annotations

from fractions import Fraction
from itertools import takewhile

from nmatrix.lessons.check.judge import Judge
from nmatrix.lessons.check.mistake import MistakeId
from nmatrix.lessons.check.mistakes import MISTAKES
from nmatrix.lessons.check.question import Question, Subject
from nmatrix.lessons.exercises.bank import CONCEPTS, SPACE_OPTIONS, SPACES
from nmatrix.lessons.exercises.exercise import Choice, Exercise, Option
from nmatrix.lessons.exercises.matrices import CONVENTION, SCALES, SHORT_MOVES
from nmatrix.lessons.exercises.scheme import Draws
from nmatrix.lessons.notation import formula, in_parentheses, written
from nmatrix.linear.affine import rotation_about
from nmatrix.linear.angle import Angle
from nmatrix.linear.rational import RationalMatrix, diagonal, identity, product, transpose
from nmatrix.report import Block, Code, Text
from nmatrix.scene.setup import Setup
from nmatrix.scene.world import World

LETTER = "Answer with a letter."
CHOICES = 4
# They need a sentence of context to be a fair question.
NOT_ASKED = (MistakeId.POLIMI_ANGLES_SWAPPED, MistakeId.USED_MODEL_VIEW)
# The mistakes that the scheme nmatrix/1 draws from end before this one: more would change sheets.
AFTER_THE_SCHEME = MistakeId.CLIP_Y

# What a wrong choice is told: where to look, and not what is to be seen there.
FOLLOW_THE_MATRICES = (
    "Read the line from right to left: world takes object space to world space, view takes that "
    "to camera space, projection takes that to clip space, an inverse goes back."
)
LOOK_AT_PRODUCTS = (
    "Work out AᵀA: its diagonal holds the squared lengths of the columns, the rest tells whether "
    "they are perpendicular."
)
UP_TO_LENGTH = "Of a normal matrix any positive multiple counts."
OTHER_NUMBERS = "That mistake gives other numbers: work one entry out and compare."


def which_space(draws: Draws) -> Exercise:
    """Ask for the space of a vector in a line of shader code."""
    line, space, because = draws.choice(SPACES)
    options = tuple(
        Option(one, because if one == space else FOLLOW_THE_MATRICES, aliases=aliases)
        for one, aliases in SPACE_OPTIONS.items()
    )
    task = (
        Code("glsl", f"{line}\n"),
        Text(
            "Positions and normals come in object space, lights and the eye in world space. In "
            "which space is the result?"
        ),
    )
    return _choice(draws, task, options, list(SPACE_OPTIONS).index(space))


def short_cut(draws: Draws) -> Exercise:
    """Ask whether a world matrix may carry normals itself."""
    yes = "yes: the columns are perpendicular and equally long"
    lengths = "no: the columns are perpendicular, but not equally long"
    angles = "no: the columns are not perpendicular"
    kind = draws.randbelow(4)
    A = _block(draws, kind)
    right = (0, 0, 1, 2)[kind]
    size = product(transpose(A), A)
    because = (
        "AᵀA is a multiple of the identity, so A⁻ᵀ is a multiple of A; a mirror does not matter.",
        "AᵀA is diagonal with different entries: A bends every normal off its axes.",
        "AᵀA is not diagonal: a shear. Its determinant says nothing about that.",
    )[right]
    options = tuple(
        Option(text, because if i == right else LOOK_AT_PRODUCTS)
        for i, text in enumerate((yes, lengths, angles))
    )
    task = (
        formula("A = ", A),
        Text("Is it legal to multiply normals by A itself, and to normalise?"),
    )
    return _choice(draws, task, options, right, (formula("Aᵀ · A = ", size),))


def find_the_mistake(draws: Draws) -> Exercise | None:
    """Show a wrong answer and ask which mistake it holds."""
    quarter = draws.choice((90, -90))
    scale = draws.several(SCALES, 3)
    move = tuple(Fraction(1 + draws.randbelow(4)) for _ in range(3))
    world = World(translate=move, rotate_degrees=(0, 0, quarter), scale=scale)
    subject = draws.choice((Subject.WORLD, Subject.NORMAL))
    judge = Judge(Question(subject, Setup(world)))
    of_the_scheme = list(takewhile(lambda one: one is not AFTER_THE_SCHEME, MistakeId))
    asked = [one for one in reversed(of_the_scheme) if one not in NOT_ASKED]
    by_mistake = {one: wrong[0] for one in asked if (wrong := judge.wrong_by(one))}
    near = list(by_mistake)
    if len(near) < CHOICES:
        return None
    chosen = draws.several(near, CHOICES)
    if len({by_mistake[one] for one in chosen}) < CHOICES:
        return None
    right = draws.randbelow(CHOICES)
    made = chosen[right]
    options = tuple(
        Option(MISTAKES[one].did, MISTAKES[one].rule if one is made else OTHER_NUMBERS, one)
        for one in chosen
    )
    told = (
        f"scaled by {in_parentheses(scale)}, turned by {written(quarter)}° about z, "
        f"moved by {in_parentheses(move)}"
    )
    what = "the world matrix" if subject is Subject.WORLD else "the normal matrix"
    task: tuple[Block, ...] = (
        Text(f"An object is {told}. For {what} Sam writes"),
        formula("answer = ", by_mistake[made]),
        Text(CONVENTION if subject is Subject.WORLD else f"{CONVENTION} {UP_TO_LENGTH}"),
        Text("What do you tell Sam?"),
    )
    key = (formula("right = ", judge.right), Text(MISTAKES[made].did))
    return _choice(draws, task, options, right, key)


def concept(draws: Draws) -> Exercise:
    """Ask a question of understanding."""
    question, right, wrong = draws.choice(CONCEPTS)
    options = [Option(text, because) for text, because in (right, *wrong)]
    order = draws.shuffled(range(len(options)))
    shuffled = tuple(options[i] for i in order)
    return _choice(draws, (Text(question),), shuffled, order.index(0))


def _block(draws: Draws, kind: int) -> RationalMatrix:
    """Draw a turn with a uniform scale, a mirror of one, a stretch, or a shear."""
    turn = rotation_about(draws.choice("XYZ"), Angle.degrees(draws.choice((90, 180, 270))))
    if kind < 2:
        s = draws.choice(SCALES)
        return product(turn, diagonal((-s if kind else s, s, s)))
    if kind == 2:
        return product(turn, diagonal(draws.several(SCALES, 3)))
    H = [list(row) for row in identity(3)]
    i, j = draws.choice(((0, 1), (0, 2), (1, 2)))
    H[i][j] = draws.choice(SHORT_MOVES)
    return product(turn, tuple(map(tuple, H)))


def _choice(
    draws: Draws,
    task: tuple[Block, ...],
    options: tuple[Option, ...],
    right: int,
    key: tuple[Block, ...] = (),
) -> Exercise:
    grader = Choice(options, right)
    worked = (*key, Text(f"Answer: {grader.letter}. {options[right].because}"))
    return Exercise(draws.number, task, LETTER, (1, 1), worked, grader.letter, grader)
