"""One mistake: its id, its words, and the slip that makes it of a scene."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from nmatrix.lessons.check.computation import Computation, Slip
    from nmatrix.lessons.check.question import Question, Subject


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
    CLIP_Y = "clip-y"
    VIEW_TRANSLATION = "view-translation"
    VIEW_ROTATION_TRANSPOSED = "view-rotation-transposed"
    VIEW_TRANSLATION_SIGN = "view-translation-sign"
    CAMERA_AXES = "camera-axes"
    HALF_ANGLE = "half-angle"
    FOCAL_INVERTED = "focal-inverted"
    ASPECT_MISSING = "aspect-missing"
    PERSPECTIVE_ROW = "perspective-row"
    DEPTH_SIGN = "depth-sign"
    DEPTH_FACTOR = "depth-factor"
    SCALE_AFTER_ROTATION = "scale-after-rotation"
    TRANSLATION_MISSING = "translation-missing"
    ROTATION_MISSING = "rotation-missing"
    SCALE_MISSING = "scale-missing"
    WORLD_INVERTED = "world-inverted"
    QUATERNION_ORDER = "quaternion-order"
    QUATERNION_LENGTH = "quaternion-length"
    AXES_CONJUGATED = "axes-conjugated"
    AXES_HALF_CONJUGATED = "axes-half-conjugated"
    UP_AXIS = "up-axis"
    NORMAL_ROTATION_ONLY = "normal-rotation-only"
    NORMAL_TRANSLATED = "normal-translated"
    LIGHT_TOWARDS = "light-towards"
    W_NOT_DIVIDED = "w-not-divided"
    WINDOW_Y = "window-y"


@dataclass(frozen=True, eq=False)
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

    def made_in(self, question: Question) -> tuple[Computation, ...]:
        """Make the mistake in the computation of a question, in every way; none where it cannot.

        Examples
        --------
        >>> from nmatrix.lessons.check.mistakes import MISTAKES
        >>> from nmatrix.lessons.check.question import Question, Subject
        >>> from nmatrix.scene.setup import Setup
        >>> MISTAKES[MistakeId.DEPTH_RANGE].made_in(Question(Subject.EYE, Setup()))
        ()
        """
        slip = self.slips.get(question.subject)
        return () if slip is None else slip(question)
