"""Every mistake that `check` can name, one entry each: its words, and the slip that makes it.

Where several of them give the same numbers, the first one of `MistakeId` is named first. The words
need no scene: `MISTAKES[MistakeId.CLIP_Y].did`.
"""

from __future__ import annotations

from nmatrix.enums import NormalRule
from nmatrix.lessons.check.computation import (
    Entries,
    Slip,
    either,
    misplaced,
    misread,
    misruled,
    when,
    written_transposed,
    written_unnormalised,
)
from nmatrix.lessons.check.mistake import Mistake, MistakeId
from nmatrix.lessons.check.question import Subject
from nmatrix.lessons.check.slips import (
    angles,
    axes,
    lens,
    normals,
    parts,
    tracing,
    view,
    whole_matrices,
)


def _for(slip: Slip, *subjects: Subject) -> dict[Subject, Slip]:
    """Let the same slip happen to several subjects."""
    return dict.fromkeys(subjects, slip)


MATRICES = (Subject.WORLD, Subject.VIEW, Subject.PROJECTION, Subject.AXES)
LIGHTING = (Subject.LIGHT, Subject.EYE)
OF_ANGLES = tuple(subject for subject in Subject if subject is not Subject.PROJECTION)
OF_PARTS = tuple(one for one in OF_ANGLES if one is not Subject.VIEW)
SEEN = (Subject.PROJECTION, Subject.TRACE)

IN_ANOTHER_UNIT = misread(
    angles.world_in_another_unit,
    angles.view_in_another_unit,
    lens.angle_in_another_unit_if_given,
    angles.light_in_another_unit,
    together=True,
)
OF_THE_OTHER_HAND = either(misread(view=view.look_at_of_the_other_hand), misplaced(view.mirrored))
Y_TURNED = misplaced(lens.y_turned, entries=Entries.ROW_Y)

MISTAKES: dict[MistakeId, Mistake] = {
    MistakeId.NOT_TRANSPOSED: Mistake(
        "You inverted the matrix and did not transpose it.",
        "Normals move by the inverse transpose A⁻ᵀ; A⁻¹ alone turns them the wrong way wherever "
        "A is not symmetric.",
        "nmatrix derive rule",
        _for(misruled(normals.normal_by(NormalRule.NOT_TRANSPOSED)), Subject.NORMAL),
    ),
    MistakeId.NOT_INVERTED: Mistake(
        "You transposed the matrix and did not invert it.",
        "Normals move by the inverse transpose A⁻ᵀ: transposing undoes the rotation, inverting "
        "undoes everything, and the two together undo only the scale.",
        "nmatrix derive rule",
        _for(misruled(normals.normal_by(NormalRule.NOT_INVERTED)), Subject.NORMAL),
    ),
    MistakeId.USED_WORLD_MATRIX: Mistake(
        "You used the matrix itself.",
        "The matrix that moves points carries normals only where it turns and scales alike in "
        "all directions; light and eye reach object space by its inverse.",
        "nmatrix derive nonuniform",
        {
            Subject.NORMAL: misruled(normals.normal_by(NormalRule.NONE)),
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
        _for(misruled(normals.normal_by(NormalRule.COFACTOR)), Subject.NORMAL),
    ),
    MistakeId.TRANSLATED: Mistake(
        "You moved the normal like a point, with w = 1, so the translation was added.",
        "A normal is a direction: take the 3×3 block, or w = 0.",
        "nmatrix derive translation",
        _for(
            misruled(
                normals.normal_by(NormalRule.TRANSLATED),
                normals.unit_normal_by(NormalRule.TRANSLATED),
            ),
            Subject.NORMAL,
        ),
    ),
    MistakeId.FOUR_COMPONENT_NORMALISE: Mistake(
        "You normalised four components: the fourth one, −(A⁻¹t)·n, was counted in the length.",
        "The inverse transpose of a matrix that translates leaves something in w: drop it before "
        "normalising.",
        "nmatrix derive translation",
        _for(
            misruled(normals.normal_by(NormalRule.FOUR_COMPONENT), any_length=True), Subject.NORMAL
        ),
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
        _for(misruled(normals.direction_as_point), Subject.LIGHT),
    ),
    MistakeId.COURSE_LIGHT_RULE: Mistake(
        "You moved the light's direction by the inverse transpose (into object space: by Mᵀ).",
        "That is the rule for normals; a light direction is a vector and moves by the matrix "
        "itself (into object space: by M⁻¹).",
        "nmatrix light object --scale 1 1/4 1 --light-direction 0.3 0.9 0.2",
        _for(misruled(normals.course_light_rule), Subject.LIGHT),
    ),
    MistakeId.DEGREES_AS_RADIANS: Mistake(
        "You took degrees for radians, or radians for degrees.",
        "A sine or tangent takes radians: multiply degrees by π/180, once.",
        "nmatrix world --rotate 0 30 0",
        {
            **_for(IN_ANOTHER_UNIT, *OF_ANGLES),
            Subject.PROJECTION: when(lens.has_angle, misread(lens=lens.angle_in_another_unit)),
        },
        {Subject.PROJECTION: "nmatrix projection --fov 60", Subject.VIEW: "nmatrix view --roll 30"},
    ),
    MistakeId.ROTATION_ORDER: Mistake(
        "You multiplied the rotations in another order.",
        "Rotations do not commute; XYZ means R = Rx·Ry·Rz, so the vector meets Rz first.",
        "nmatrix world --rotate 30 60 0 --order XYZ",
        _for(misread(angles.world_in_another_order, angles.view_in_another_order), *OF_ANGLES),
    ),
    MistakeId.ROTATION_SIGN: Mistake(
        "You turned the other way about at least one axis.",
        "By the right-hand rule Rz has −sin in its first row; Ry has it in its last.",
        "nmatrix world --rotate 0 30 0",
        _for(misread(angles.world_turned_back, angles.view_turned_back), *OF_ANGLES),
    ),
    MistakeId.POLIMI_ANGLES_SWAPPED: Mistake(
        "You took the three angles by another convention.",
        "Here they turn about x, y, z; the course's library turns about y with the first one and "
        "about x with the second, its labs with other signs too.",
        "nmatrix world --rotate 30 60 0 --convention polimi",
        _for(
            misread(angles.world_of_another_convention, angles.view_of_another_convention),
            *OF_ANGLES,
        ),
    ),
    MistakeId.WRONG_HANDEDNESS: Mistake(
        "You took the other hand: the camera looks along the other z.",
        "A right-handed camera looks down −z, a left-handed one down +z; view and projection "
        "must agree.",
        "nmatrix view --handed left",
        {
            **_for(OF_THE_OTHER_HAND, Subject.VIEW, Subject.NORMAL, *LIGHTING),
            Subject.PROJECTION: when(lens.has_numbers, misread(lens=lens.of_the_other_hand)),
            Subject.TRACE: when(lens.has_numbers, misread(lens=lens.of_the_other_hand)),
        },
        {Subject.PROJECTION: "nmatrix projection --handed left"},
    ),
    MistakeId.DEPTH_RANGE: Mistake(
        "You took another depth range.",
        "OpenGL maps near and far to −1 and 1, Vulkan and Direct3D to 0 and 1, reversed depth "
        "to 1 and 0.",
        "nmatrix projection --depth zero-to-one",
        _for(when(lens.has_numbers, misread(lens=lens.other_depth_ranges)), *SEEN),
    ),
    MistakeId.ASPECT_INVERTED: Mistake(
        "You multiplied by the aspect ratio instead of dividing, or took height over width.",
        "The aspect is width over height, and it divides the first entry.",
        "nmatrix projection --aspect 2",
        _for(when(lens.has_angle, misread(lens=lens.aspect_inverted)), *SEEN),
    ),
    MistakeId.HORIZONTAL_FOV: Mistake(
        "You took the field of view for the horizontal one.",
        "It is vertical: it gives the second diagonal entry, and the aspect ratio the first.",
        "nmatrix projection --fov 90 --aspect 2",
        _for(when(lens.has_angle, misread(lens=lens.horizontal_fov)), *SEEN),
    ),
    MistakeId.NEAR_FAR_SWAPPED: Mistake(
        "You swapped near and far.",
        "In the third row far comes first: (f + n)/(f − n), or f/(f − n); on purpose it is "
        "called reversed depth.",
        "nmatrix projection --near 1 --far 10",
        _for(lens.near_far_swapped, *SEEN),
    ),
    MistakeId.SCALE_BEFORE_TRANSLATE: Mistake(
        "You multiplied the translation and the rest in the wrong order.",
        "In M = T·A the translation comes last and stays as it is; in V = R·T it comes first and "
        "is turned: a matrix to the left acts on everything to its right.",
        "nmatrix world --scale 2 2 2 --translate 1 0 0",
        _for(
            misplaced(whole_matrices.scale_before_translate),
            Subject.WORLD,
            Subject.TRACE,
            *LIGHTING,
        ),
    ),
    MistakeId.VIEW_NOT_INVERTED: Mistake(
        "You gave the camera's pose instead of its inverse.",
        "The view matrix takes the world to the camera, so it undoes where the camera stands: "
        "R⁻¹·T(−eye).",
        "nmatrix view --eye 3 0 0",
        _for(misplaced(view.not_inverted), Subject.VIEW, Subject.NORMAL, *LIGHTING, Subject.TRACE),
    ),
    MistakeId.CLIP_Y: Mistake(
        "You left out the flip of y in clip space, or made one where none belongs.",
        "In Vulkan y in clip space points down, so the second row is negated; in OpenGL, "
        "Direct3D, Metal and WebGPU it points up.",
        "nmatrix projection --api vulkan",
        {
            Subject.PROJECTION: Y_TURNED,
            Subject.TRACE: when(tracing.ends_before_the_window, Y_TURNED),
        },
    ),
    MistakeId.VIEW_TRANSLATION: Mistake(
        "The last column is not −R·eye: the eye or the target stands there, or Rᵀ turned it.",
        "V = R·T(−eye): the eye is turned with everything else, so that V takes it to the origin.",
        "nmatrix view --eye 3 1 2",
        _for(misplaced(*view.OTHER_TRANSLATIONS, entries=Entries.TRANSLATION), Subject.VIEW),
    ),
    MistakeId.VIEW_ROTATION_TRANSPOSED: Mistake(
        "The 3×3 block is transposed: the camera's axes stand in its columns.",
        "The view matrix measures along the camera's axes, so right, up and back are its rows.",
        "nmatrix view --eye 3 1 2",
        _for(misplaced(view.rotation_transposed, entries=Entries.BLOCK), Subject.VIEW),
    ),
    MistakeId.VIEW_TRANSLATION_SIGN: Mistake(
        "The signs of the last column are turned.",
        "Each entry of it is −dot(axis, eye): the world moves against the lens.",
        "nmatrix view --eye 3 1 2",
        _for(misplaced(view.translation_turned, entries=Entries.TRANSLATION), Subject.VIEW),
    ),
    MistakeId.CAMERA_AXES: Mistake(
        "You took the camera's axes as OpenCV has them: y down and z ahead.",
        "Here a camera has y up and looks down −z, a left-handed one down +z: negate the rows of V "
        "that differ.",
        "nmatrix view --eye 3 1 2",
        _for(misplaced(view.of_opencv), Subject.VIEW, *LIGHTING),
    ),
    MistakeId.HALF_ANGLE: Mistake(
        "You took the tangent of the whole field of view, or halved it twice.",
        "The focal length is 1/tan(fov/2): half of the field lies above the axis.",
        "nmatrix projection --fov 60",
        _for(when(lens.has_angle, misread(lens=lens.whole_or_quarter_angle)), *SEEN),
    ),
    MistakeId.FOCAL_INVERTED: Mistake(
        "You took tan(fov/2) for the focal length.",
        "The focal length is its reciprocal, 1/tan(fov/2): a wider field makes things smaller.",
        "nmatrix projection --fov 60",
        _for(when(lens.has_angle, misread(lens=lens.tangent_for_cotangent)), *SEEN),
    ),
    MistakeId.ASPECT_MISSING: Mistake(
        "You left out the aspect ratio.",
        "The first entry is the focal length divided by width over height.",
        "nmatrix projection --aspect 2",
        _for(when(lens.has_angle, misread(lens=lens.aspect_left_out)), *SEEN),
    ),
    MistakeId.PERSPECTIVE_ROW: Mistake(
        "The last row has the wrong sign, or is not that of a perspective.",
        "It makes w the distance in front of the camera: 0 0 −1 0 where that looks down −z, "
        "0 0 1 0 where it looks down +z.",
        "nmatrix projection --fov 60",
        _for(misplaced(*lens.LAST_ROWS, entries=Entries.ROW_W), Subject.PROJECTION),
    ),
    MistakeId.DEPTH_SIGN: Mistake(
        "One or both signs of the third row are turned.",
        "The row takes the two distances near and far to the two ends of the depth range: put "
        "them in and see.",
        "nmatrix projection --near 1 --far 10",
        _for(misplaced(*lens.DEPTH_SIGNS, entries=Entries.ROW_Z), Subject.PROJECTION),
    ),
    MistakeId.DEPTH_FACTOR: Mistake(
        "The factor of fn/(f − n) is wrong, or the third row is 0.",
        "From −1 to 1 it is 2fn/(f − n), from 0 to 1 fn/(f − n); a row of zeros keeps no depth.",
        "nmatrix projection --near 1 --far 10",
        _for(
            misplaced(lens.other_factor, lens.no_depth, entries=Entries.ROW_Z), Subject.PROJECTION
        ),
    ),
    MistakeId.SCALE_AFTER_ROTATION: Mistake(
        "You scaled after turning, S·R for R·S.",
        "In M = T·R·S the scale comes first and acts along the object's own axes.",
        "nmatrix world --rotate 0 0 30 --scale 1 2 1",
        _for(misread(parts.scaled_after_turning), *OF_PARTS),
    ),
    MistakeId.TRANSLATION_MISSING: Mistake(
        "The translation is missing.",
        "It is the last column: a matrix without it leaves the origin where it is.",
        "nmatrix world --translate 1 2 3",
        {
            **_for(misread(parts.not_moved), Subject.WORLD, Subject.AXES),
            Subject.VIEW: misplaced(view.not_moved),
            **_for(
                either(misread(parts.not_moved), misplaced(view.not_moved)),
                *LIGHTING,
                Subject.TRACE,
            ),
        },
        {Subject.VIEW: "nmatrix view --eye 3 1 2"},
    ),
    MistakeId.ROTATION_MISSING: Mistake(
        "The rotation is missing.",
        "The 3×3 block is a product with the rotation as one factor.",
        "nmatrix world --rotate 0 30 0",
        {
            **_for(misread(parts.not_turned), Subject.WORLD, Subject.NORMAL, Subject.AXES),
            Subject.VIEW: misplaced(view.not_turned),
            **_for(
                either(misread(parts.not_turned), misplaced(view.not_turned)),
                *LIGHTING,
                Subject.TRACE,
            ),
        },
        {Subject.VIEW: "nmatrix view --eye 3 1 2"},
    ),
    MistakeId.SCALE_MISSING: Mistake(
        "The scale is missing, or one factor was taken for all three axes.",
        "Each axis has its own factor, which multiplies its column of the 3×3 block.",
        "nmatrix world --scale 1 2 1",
        _for(misread(parts.not_scaled), Subject.WORLD, *LIGHTING, Subject.TRACE, Subject.AXES),
    ),
    MistakeId.WORLD_INVERTED: Mistake(
        "You gave the inverse: it leads from the world to the object.",
        "The world matrix takes the object's points to the world, M = T·R·S.",
        "nmatrix world --translate 1 2 3",
        _for(misplaced(whole_matrices.world_inverted), Subject.WORLD),
    ),
    MistakeId.QUATERNION_ORDER: Mistake(
        "You read the quaternion in another order: its w stands elsewhere.",
        "Here a quaternion is x y z w, with w last; other programs write w x y z.",
        "nmatrix world --quaternion 0 0.6 0 0.8",
        _for(misread(parts.quaternion_in_another_order), *OF_PARTS),
    ),
    MistakeId.QUATERNION_LENGTH: Mistake(
        "You used the quaternion without bringing it to length 1.",
        "The formulas of the matrix hold for length 1: divide the four numbers by their length.",
        "nmatrix world --quaternion 0 3 0 4",
        _for(misread(parts.quaternion_of_any_length), *OF_PARTS),
    ),
    MistakeId.AXES_CONJUGATED: Mistake(
        "You gave F·M·F, the same change of axes on both sides of M.",
        "From one axis system to another goes F·M·F⁻¹; within one system M stays as it is.",
        "nmatrix axes blender opengl",
        _for(misruled(axes.flipped_on_both_sides), Subject.WORLD, Subject.AXES),
    ),
    MistakeId.AXES_HALF_CONJUGATED: Mistake(
        "You changed the axes on one side of M alone.",
        "Both sides are told in the new axes, F·M·F⁻¹, or none is: M on its own.",
        "nmatrix axes blender opengl",
        _for(
            misruled(axes.flipped_on_the_left, axes.flipped_on_the_right),
            Subject.WORLD,
            Subject.AXES,
        ),
    ),
    MistakeId.UP_AXIS: Mistake(
        "You exchanged y and z, as between a system with y up and one with z up.",
        "From z up to y up it is (x, z, −y), with the sign, and on both sides of a matrix.",
        "nmatrix axes blender opengl",
        _for(misruled(*axes.OTHER_UPS), Subject.WORLD, Subject.AXES),
    ),
    MistakeId.NORMAL_ROTATION_ONLY: Mistake(
        "You used the rotation alone: scale and shear are left out.",
        "Normals need them too, the scale by its reciprocal: A⁻ᵀ = R·S⁻¹ for A = R·S.",
        "nmatrix derive nonuniform",
        _for(misread(parts.only_turned), Subject.NORMAL),
    ),
    MistakeId.NORMAL_TRANSLATED: Mistake(
        "You added the translation to the normal.",
        "A normal is a direction, and a translation moves no direction: take A⁻ᵀn alone.",
        "nmatrix derive translation",
        _for(misruled(normals.moved_normal, normals.moved_unit_normal), Subject.NORMAL),
    ),
    MistakeId.LIGHT_TOWARDS: Mistake(
        "You gave the direction to the lamp.",
        "The direction of a light is the one in which it travels; the l of the lighting formulas "
        "points to the lamp, against it.",
        "nmatrix light --light-direction 0 -1 0",
        _for(
            when(normals.is_light_direction, misread(light=normals.towards_the_lamp)), Subject.LIGHT
        ),
    ),
    MistakeId.W_NOT_DIVIDED: Mistake(
        "You did not divide by w.",
        "Normalised device coordinates are clip x, y and z divided by clip w.",
        "nmatrix trace --point 1 1 1",
        _for(misruled(tracing.not_divided), Subject.TRACE),
    ),
    MistakeId.WINDOW_Y: Mistake(
        "You counted y from the other side of the window.",
        "In OpenGL window y counts from the bottom; in Direct3D, Metal, Vulkan and WebGPU from "
        "the top.",
        "nmatrix trace --point 1 1 1 --api vulkan",
        _for(misruled(tracing.y_from_the_other_side), Subject.TRACE),
    ),
}
