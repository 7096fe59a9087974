"""Every mistake that `check` can name: its words, and the slip that makes it.

Where several of them give the same numbers, the first one of this table is named first.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum

from nmatrix.enums import NormalRule
from nmatrix.lessons.check.computation import (
    Computation,
    Slip,
    misplaced,
    misread,
    misruled,
    written_transposed,
    written_unnormalised,
)
from nmatrix.lessons.check.question import Question, Subject
from nmatrix.lessons.check.slips import angles, camera, rules, whole_matrices


class MistakeId(StrEnum):
    """The mistakes, in the order in which they are named."""

    NOT_TRANSPOSED = "not-transposed"
    NOT_INVERTED = "not-inverted"
    USED_WORLD_MATRIX = "used-world-matrix"
    TRANSPOSED_LAYOUT = "transposed-layout"
    MISSING_NORMALISE = "missing-normalise"
    COFACTOR_SIGN = "cofactor-sign"
    TRANSLATED = "translated"
    FOUR_COMPONENT_NORMALISE = "four-component-normalise"
    USED_MODEL_VIEW = "used-model-view"
    DIRECTION_AS_POINT = "direction-as-point"
    COURSE_LIGHT_RULE = "course-light-rule"
    DEGREES_AS_RADIANS = "degrees-as-radians"
    ROTATION_ORDER = "rotation-order"
    ROTATION_SIGN = "rotation-sign"
    POLIMI_ANGLES_SWAPPED = "polimi-angles-swapped"
    WRONG_HANDEDNESS = "wrong-handedness"
    DEPTH_RANGE = "depth-range"
    ASPECT_INVERTED = "aspect-inverted"
    HORIZONTAL_FOV = "horizontal-fov"
    NEAR_FAR_SWAPPED = "near-far-swapped"
    SCALE_BEFORE_TRANSLATE = "scale-before-translate"
    VIEW_NOT_INVERTED = "view-not-inverted"


@dataclass(frozen=True)
class Mistake:
    """One mistake: its words, and the slip that makes it.

    Parameters
    ----------
    did
        What was done, as a sentence to the student.
    rule
        The rule that it broke, as a sentence.
    command
        A command line that shows the right way on a small example.
    slips
        For each subject that it happens to, the change that it makes to the computation.
    elsewhere
        Command lines for subjects of which `command` is no example.
    """

    did: str
    rule: str
    command: str
    slips: Mapping[Subject, Slip]
    elsewhere: Mapping[Subject, str] = field(default_factory=dict)

    @property
    def explanation(self) -> str:
        """What was done, and the rule that it broke."""
        return f"{self.did} {self.rule}"

    def command_for(self, subject: Subject) -> str:
        """Choose the command line that shows the right way for what was asked."""
        return self.elsewhere.get(subject, self.command)

    def made_in(self, question: Question) -> Computation | None:
        """Make the mistake in the computation of a question; None where it cannot happen.

        Examples
        --------
        >>> from nmatrix.scene.setup import Setup
        >>> MISTAKES[MistakeId.DEPTH_RANGE].made_in(Question(Subject.EYE, Setup())) is None
        True
        """
        slip = self.slips.get(question.subject)
        return None if slip is None else slip(question)


def _for(slip: Slip, *subjects: Subject) -> dict[Subject, Slip]:
    """Let the same slip happen to several subjects."""
    return dict.fromkeys(subjects, slip)


MATRICES = (Subject.WORLD, Subject.VIEW, Subject.PROJECTION)
LIGHTING = (Subject.LIGHT, Subject.EYE)
BUT_THE_LENS = tuple(subject for subject in Subject if subject is not Subject.PROJECTION)

MISTAKES: dict[MistakeId, Mistake] = {
    MistakeId.NOT_TRANSPOSED: Mistake(
        "You inverted the matrix and did not transpose it.",
        "Normals move by the inverse transpose A⁻ᵀ; A⁻¹ alone turns them the wrong way wherever "
        "A is not symmetric.",
        "nmatrix derive rule",
        _for(misruled(rules.normal_by(NormalRule.NOT_TRANSPOSED)), Subject.NORMAL),
    ),
    MistakeId.NOT_INVERTED: Mistake(
        "You transposed the matrix and did not invert it.",
        "Normals move by the inverse transpose A⁻ᵀ: transposing undoes the rotation, inverting "
        "undoes everything, and the two together undo only the scale.",
        "nmatrix derive rule",
        _for(misruled(rules.normal_by(NormalRule.NOT_INVERTED)), Subject.NORMAL),
    ),
    MistakeId.USED_WORLD_MATRIX: Mistake(
        "You used the matrix itself.",
        "The matrix that moves points carries normals only where it turns and scales alike in "
        "all directions; light and eye reach object space by its inverse.",
        "nmatrix derive nonuniform",
        {
            Subject.NORMAL: misruled(rules.normal_by(NormalRule.NONE)),
            **_for(misplaced(whole_matrices.used_world_matrix), *LIGHTING),
        },
        {Subject.LIGHT: "nmatrix derive lightdirection", Subject.EYE: "nmatrix derive eye"},
    ),
    MistakeId.TRANSPOSED_LAYOUT: Mistake(
        "You used the transposed matrix: rows stand where columns belong.",
        "Column vectors are multiplied from the left and the translation is the last column; "
        "memory order is another matter, and --input-layout column-major reads it.",
        "nmatrix world --translate 1 2 3",
        {
            **_for(written_transposed, *MATRICES),
            **_for(misplaced(whole_matrices.transposed_layout), *LIGHTING),
        },
        {
            Subject.VIEW: "nmatrix view --eye 3 0 5",
            Subject.PROJECTION: "nmatrix projection --near 1 --far 10",
        },
    ),
    MistakeId.MISSING_NORMALISE: Mistake(
        "The direction is right and its length is not 1.",
        "A unit vector was asked for: divide by the length, which the inverse transpose changes.",
        'nmatrix normal "1 0 0; 0 2 0; 0 0 1" --normal 1 1 0',
        _for(written_unnormalised, *Subject),
    ),
    MistakeId.COFACTOR_SIGN: Mistake(
        "Every entry has the wrong sign: these are the plain cofactors of a mirror.",
        "The cofactor matrix is det(A)·A⁻ᵀ, and here det(A) < 0: multiply by the sign of the "
        "determinant, or normals point inwards.",
        "nmatrix derive mirror",
        _for(misruled(rules.normal_by(NormalRule.COFACTOR)), Subject.NORMAL),
    ),
    MistakeId.TRANSLATED: Mistake(
        "You moved the normal like a point, with w = 1, so the translation was added.",
        "A normal is a direction: take the 3×3 block, or w = 0.",
        "nmatrix derive translation",
        _for(misruled(rules.normal_by(NormalRule.TRANSLATED)), Subject.NORMAL),
    ),
    MistakeId.FOUR_COMPONENT_NORMALISE: Mistake(
        "You normalised four components: the fourth one, −(A⁻¹t)·n, was counted in the length.",
        "The inverse transpose of a matrix that translates leaves something in w: drop it before "
        "normalising.",
        "nmatrix derive translation",
        _for(misruled(rules.normal_by(NormalRule.FOUR_COMPONENT), any_length=True), Subject.NORMAL),
    ),
    MistakeId.USED_MODEL_VIEW: Mistake(
        "You used V·M where one of the two belongs alone.",
        "The world matrix M is for what is fixed to the object; a light or an eye of the world "
        "moves by V alone, a normal into world space by M alone.",
        "nmatrix light camera --scale 1 2 1",
        _for(misplaced(whole_matrices.used_model_view), Subject.VIEW, Subject.NORMAL, *LIGHTING),
    ),
    MistakeId.DIRECTION_AS_POINT: Mistake(
        "You moved the direction like a point, with w = 1, so the translation was added.",
        "A direction has w = 0: it turns and scales, and it has no place.",
        "nmatrix light camera --light-direction 0 -1 0",
        _for(misruled(rules.direction_as_point), Subject.LIGHT),
    ),
    MistakeId.COURSE_LIGHT_RULE: Mistake(
        "You moved the light's direction by the inverse transpose (into object space: by Mᵀ).",
        "That is the rule for normals; a light direction is a vector and moves by the matrix "
        "itself (into object space: by M⁻¹).",
        "nmatrix light object --scale 1 1/4 1 --light-direction 0.3 0.9 0.2",
        _for(misruled(rules.course_light_rule), Subject.LIGHT),
    ),
    MistakeId.DEGREES_AS_RADIANS: Mistake(
        "You gave degrees to a sine or tangent that takes radians.",
        "Multiply degrees by π/180 first.",
        "nmatrix world --rotate 0 30 0",
        {
            **_for(misread(angles.degrees_as_radians), *BUT_THE_LENS),
            Subject.PROJECTION: misread(camera.angle_in_radians, camera.has_angle),
        },
        {Subject.PROJECTION: "nmatrix projection --fov 60", Subject.VIEW: "nmatrix view --roll 30"},
    ),
    MistakeId.ROTATION_ORDER: Mistake(
        "You multiplied the rotations in another order.",
        "Rotations do not commute; XYZ means R = Rx·Ry·Rz, so the vector meets Rz first.",
        "nmatrix world --rotate 30 60 0 --order XYZ",
        _for(misread(angles.rotation_order), *BUT_THE_LENS),
    ),
    MistakeId.ROTATION_SIGN: Mistake(
        "You turned the other way about at least one axis.",
        "By the right-hand rule Rz has −sin in its first row; Ry has it in its last.",
        "nmatrix world --rotate 0 30 0",
        _for(misread(angles.rotation_sign), *BUT_THE_LENS),
    ),
    MistakeId.POLIMI_ANGLES_SWAPPED: Mistake(
        "You took the three angles by another convention.",
        "Here they turn about x, y, z; the course's library turns about y with the first one and "
        "about x with the second, its labs with other signs too.",
        "nmatrix world --rotate 30 60 0 --convention polimi",
        _for(misread(angles.polimi_angles_swapped), *BUT_THE_LENS),
    ),
    MistakeId.WRONG_HANDEDNESS: Mistake(
        "You took the other hand: the camera looks along the other z.",
        "A right-handed camera looks down −z, a left-handed one down +z; view and projection "
        "must agree.",
        "nmatrix view --handed left",
        {
            **_for(misread(camera.view_of_the_other_hand), *BUT_THE_LENS),
            Subject.PROJECTION: misread(camera.lens_of_the_other_hand, camera.has_numbers),
        },
        {Subject.PROJECTION: "nmatrix projection --handed left"},
    ),
    MistakeId.DEPTH_RANGE: Mistake(
        "You took another depth range.",
        "OpenGL maps near and far to −1 and 1, Vulkan and Direct3D to 0 and 1, reversed depth "
        "to 1 and 0.",
        "nmatrix projection --depth zero-to-one",
        _for(misread(camera.other_depth_ranges, camera.has_numbers), Subject.PROJECTION),
    ),
    MistakeId.ASPECT_INVERTED: Mistake(
        "You multiplied by the aspect ratio instead of dividing, or took height over width.",
        "The aspect is width over height, and it divides the first entry.",
        "nmatrix projection --aspect 2",
        _for(misread(camera.aspect_inverted, camera.has_angle), Subject.PROJECTION),
    ),
    MistakeId.HORIZONTAL_FOV: Mistake(
        "You took the field of view for the horizontal one.",
        "It is vertical: it gives the second diagonal entry, and the aspect ratio the first.",
        "nmatrix projection --fov 90 --aspect 2",
        _for(misread(camera.horizontal_fov, camera.has_angle), Subject.PROJECTION),
    ),
    MistakeId.NEAR_FAR_SWAPPED: Mistake(
        "You swapped near and far.",
        "In the third row far comes first: (f + n)/(f − n), or f/(f − n); on purpose it is "
        "called reversed depth.",
        "nmatrix projection --near 1 --far 10",
        _for(camera.near_far_swapped, Subject.PROJECTION),
    ),
    MistakeId.SCALE_BEFORE_TRANSLATE: Mistake(
        "You multiplied the translation and the rest in the wrong order.",
        "In M = T·A the translation comes last and stays as it is, in V = R·T it comes first and "
        "is turned; a matrix to the left acts on everything to its right.",
        "nmatrix world --scale 2 2 2 --translate 1 0 0",
        _for(
            misplaced(whole_matrices.scale_before_translate), Subject.WORLD, Subject.VIEW, *LIGHTING
        ),
    ),
    MistakeId.VIEW_NOT_INVERTED: Mistake(
        "You gave the camera's pose instead of its inverse.",
        "The view matrix takes the world to the camera, so it undoes where the camera stands: "
        "R⁻¹·T(−eye).",
        "nmatrix view --eye 3 0 0",
        _for(misplaced(whole_matrices.view_not_inverted), Subject.VIEW, Subject.NORMAL, *LIGHTING),
    ),
}
