"""What lint looks for: a table of rules, the most particular first where two fit one place."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from nmatrix.enums import Severity
from nmatrix.report import Rule


class RuleId(StrEnum):
    """The rules; a code never changes its meaning."""

    NORMAL_BY_MATRIX = "NM101"
    NORMAL_WITH_W = "NM102"
    TANGENT_BY_NORMAL_MATRIX = "NM103"
    NORMAL_BY_PROJECTION = "NM104"
    HALF_INVERSE_TRANSPOSE = "NM105"
    SPACES_MIXED = "NM201"
    LIGHT_BY_MODEL_VIEW = "NM202"
    WRONG_W = "NM203"
    PRODUCT_ORDER = "NM204"
    EYE_AT_ORIGIN = "NM205"
    STUCK_LIGHT = "NM206"
    NOT_NORMALISED = "NM301"
    FOUR_COMPONENTS = "NM302"
    REFLECTED_WRONG_WAY = "NM303"
    W_NOT_DIVIDED = "NM304"
    POWER_OF_NEGATIVE = "NM305"
    HALFWAY_NOT_UNIT = "NM306"
    INVERSE_IN_SHADER = "NM401"


@dataclass(frozen=True)
class LintRule:
    """One rule: its weight, its words, and the mistake of `check` that it is, if it is one.

    `gains_degrees` is whether the world matrix decides how much it matters.
    """

    severity: Severity
    name: str
    sentence: str
    advice: str
    mistake: str | None = None
    gains_degrees: bool = False


_ERROR, _WARNING, _NOTE = Severity.ERROR, Severity.WARNING, Severity.NOTE

LINT_RULES = {
    RuleId.NORMAL_BY_MATRIX: LintRule(
        _WARNING,
        "Normal by the matrix itself",
        "A normal is multiplied by the model or model-view matrix, which moves points.",
        "Multiply it by the inverse transpose, and normalise.",
        "used-world-matrix",
        gains_degrees=True,
    ),
    RuleId.NORMAL_WITH_W: LintRule(
        _ERROR,
        "Normal with w = 1",
        "A normal is multiplied by a matrix with w = 1, so that the translation is added to it.",
        "Multiply its three components by the inverse transpose.",
        "translated",
    ),
    RuleId.TANGENT_BY_NORMAL_MATRIX: LintRule(
        _WARNING,
        "Tangent by the normal matrix",
        "A tangent is a difference of points, and is moved by the matrix that moves points.",
        "Multiply it by the upper 3 × 3 of the matrix that moves points.",
        None,
        gains_degrees=True,
    ),
    RuleId.NORMAL_BY_PROJECTION: LintRule(
        _ERROR,
        "Normal by the inverse transpose of a projection",
        "The projection bends right angles, so no light can be computed with such a normal.",
        "Take the inverse transpose of the model or model-view matrix alone.",
    ),
    RuleId.HALF_INVERSE_TRANSPOSE: LintRule(
        _ERROR,
        "Inverse or transpose alone",
        "A normal needs both the inverse and the transpose of the matrix.",
        "Write transpose(inverse(M)), or put the vector on the left of the inverse.",
        "not-transposed",
    ),
    RuleId.SPACES_MIXED: LintRule(
        _ERROR,
        "Two spaces in one sum or product",
        "Vectors of two spaces are subtracted, added, dotted or crossed.",
        "Bring both into one space first.",
    ),
    RuleId.LIGHT_BY_MODEL_VIEW: LintRule(
        _ERROR,
        "Light by view · model",
        "A light of the world is moved by a matrix that begins in object space.",
        "Multiply it by the view matrix alone.",
        "used-model-view",
    ),
    RuleId.WRONG_W: LintRule(
        _ERROR,
        "Direction with w = 1, or point with w = 0",
        "A direction with w = 1 is moved by the translation, a point with w = 0 is not.",
        "Give directions w = 0 and points w = 1.",
        "direction-as-point",
    ),
    RuleId.PRODUCT_ORDER: LintRule(
        _ERROR,
        "Matrices in the wrong order",
        "The space that one matrix leads to is not the one that its neighbour begins in.",
        "The matrix next to the vector is the one that is applied first.",
    ),
    RuleId.EYE_AT_ORIGIN: LintRule(
        _ERROR,
        "Eye at the origin outside camera space",
        "Only in camera space the eye is the origin, so that −position leads to it.",
        "Subtract the position from the eye's place in the same space.",
    ),
    RuleId.STUCK_LIGHT: LintRule(
        _ERROR,
        "Light in another space",
        "A light's place or direction meets a vector of another space.",
        "Move the light into the space in which the light is computed.",
    ),
    RuleId.NOT_NORMALISED: LintRule(
        _WARNING,
        "Interpolated normal not normalised",
        "Between vertices an interpolated normal is shorter than 1.",
        "Normalise it in the fragment shader.",
        "missing-normalise",
    ),
    RuleId.FOUR_COMPONENTS: LintRule(
        _ERROR,
        "Normalised over four components",
        "The length of four components counts w.",
        "Normalise the three components of .xyz.",
        "four-component-normalise",
    ),
    RuleId.REFLECTED_WRONG_WAY: LintRule(
        _ERROR,
        "Reflected the wrong way round",
        "reflect(I, N) takes the vector that arrives at the surface, not the one to the light.",
        "Write reflect(-L, N) for an L that points to the light.",
        "light-towards",
    ),
    RuleId.W_NOT_DIVIDED: LintRule(
        _ERROR,
        "Division by w left out",
        "Coordinates behind a projection are homogeneous until they are divided by w.",
        "Divide by w before the range is changed or a texture is read.",
        "w-not-divided",
    ),
    RuleId.POWER_OF_NEGATIVE: LintRule(
        _WARNING,
        "Power of a cosine that may be negative",
        "pow is undefined for a negative base, and the cosine of a far side is negative.",
        "Clamp the cosine first: pow(max(c, 0.0), n).",
    ),
    RuleId.HALFWAY_NOT_UNIT: LintRule(
        _ERROR,
        "Halfway vector not normalised",
        "The sum of two unit vectors, or half of it, has length 1 only by chance.",
        "Write normalize(L + V).",
        "missing-normalise",
    ),
    RuleId.INVERSE_IN_SHADER: LintRule(
        _NOTE,
        "Inverse in a shader",
        "A matrix of the program is inverted again for each vertex or fragment.",
        "Invert it once outside and pass a uniform.",
    ),
}
RULES = tuple(
    Rule(code.value, one.name, one.sentence, one.advice) for code, one in LINT_RULES.items()
)
RULE_OF = dict(zip(LINT_RULES, RULES, strict=True))
# Where several rules fit one place, the first of these is told.
PARTICULAR_FIRST = (
    RuleId.NORMAL_BY_PROJECTION,
    RuleId.NORMAL_WITH_W,
    RuleId.LIGHT_BY_MODEL_VIEW,
    RuleId.EYE_AT_ORIGIN,
    RuleId.STUCK_LIGHT,
)
