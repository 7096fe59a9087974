"""What people see and type into a search engine, for each mistake and each rule of `lint`.

The words of the tables themselves (what was done, which rule it broke) stay where they are; here
stand the symptom, other words for it, numbers that show it, its cure and its picture.
"""

from __future__ import annotations

from dataclasses import dataclass

from cures import (
    AXES,
    COFACTORS,
    EULER,
    LAYOUT,
    LIGHT,
    LOOK_AT,
    NORMAL,
    NORMALISE,
    PERSPECTIVE,
    QUATERNION,
    WINDOW,
    WORLD,
    Cure,
)

from nmatrix.lessons.check.mistake import MistakeId
from nmatrix.linting.rules import RuleId


@dataclass(frozen=True)
class Symptom:
    """A mistake as it is met.

    Parameters
    ----------
    seen
        What one sees: the heading of the page.
    searched
        Other words for it, as they are typed.
    example
        What stands behind `nmatrix check` to show it: a question, and the wrong answer to it.
    cure
        Lines of a program that are right.
    picture
        The proof in which it is seen, where there is one.
    """

    seen: str
    searched: tuple[str, ...]
    example: str
    cure: Cure
    picture: str | None = None

    @property
    def command(self) -> str:
        """The command line that names the mistake."""
        return f"nmatrix check {self.example}"


_LENS = "--fov 90 --aspect 2 --near 1 --far 10"

MISTAKES = {
    MistakeId.NOT_TRANSPOSED: Symptom(
        "Normals point the wrong way after a rotation: inverted, but not transposed",
        (
            "normal matrix inverse without transpose",
            "normals wrong when object rotates",
            "inverse(mat3(model)) normals wrong",
        ),
        'normal "0.8660 0.5 0; -0.25 0.4330 0; 0 0 1" --scale 1 2 1 --rotate 0 0 30',
        NORMAL,
        "normals",
    ),
    MistakeId.NOT_INVERTED: Symptom(
        "Normals wrong after a non-uniform scale: transposed, but not inverted",
        (
            "normals wrong after non-uniform scale",
            "normal matrix transpose without inverse",
            "shading wrong on scaled object",
        ),
        'normal "0.8660 0.5 0; -1 1.7321 0; 0 0 1" --scale 1 2 1 --rotate 0 0 30',
        NORMAL,
        "normals",
    ),
    MistakeId.USED_WORLD_MATRIX: Symptom(
        "Normals wrong under a non-uniform scale: the model matrix itself was used",
        (
            "normals wrong non-uniform scale",
            "lighting wrong on stretched object",
            "why inverse transpose for normals",
            "mat3(model) * normal wrong",
            "multiply normal by model matrix",
        ),
        'normal "0.8660 -1 0; 0.5 1.7321 0; 0 0 1" --scale 1 2 1 --rotate 0 0 30',
        NORMAL,
        "normals",
    ),
    MistakeId.TRANSPOSED_LAYOUT: Symptom(
        "The matrix is transposed: row-major or column-major",
        (
            "row major column major",
            "matrix transposed opengl",
            "translation in the last row instead of the last column",
            "object disappears after uploading matrix",
            "glUniformMatrix4fv transpose",
        ),
        'world "1 0 0 0; 0 1 0 0; 0 0 1 0; 1 2 3 1" --translate 1 2 3',
        LAYOUT,
    ),
    MistakeId.MISSING_NORMALISE: Symptom(
        "Lighting too dark or too bright: a normal that is not normalised",
        (
            "normals not normalized",
            "object gets darker when scaled",
            "object gets brighter when scaled",
            "lighting too bright after scaling",
        ),
        'normal "1 0.5 0" --scale 1 2 1 --normal 1 1 0 --unit',
        NORMALISE,
        "interpolation",
    ),
    MistakeId.COFACTOR_SIGN: Symptom(
        "Black faces with a negative scale: cofactors without the sign of the determinant",
        (
            "black faces negative scale",
            "normals flipped after mirror",
            "normals inverted negative determinant",
            "inside out lighting after mirroring",
        ),
        'normal "2 0 0; 0 -1 0; 0 0 -2" --scale -1 2 1',
        COFACTORS,
        "mirror",
    ),
    MistakeId.TRANSLATED: Symptom(
        "Lighting changes when the object moves: the normal had w = 1",
        (
            "lighting changes when object moves",
            "normal with w 1",
            "normals affected by translation",
            "vec4(normal, 1.0)",
        ),
        'normal "3.7071 1.4142 0" --scale 1 2 1 --translate 3 0 0 --normal 1 1 0',
        NORMAL,
        "translation",
    ),
    MistakeId.FOUR_COMPONENT_NORMALISE: Symptom(
        "Normals too short far from the origin: normalised over four components",
        (
            "normalize vec4 normal",
            "normalise four components w",
            "lighting gets darker away from origin",
        ),
        'normal "0.3123 0.1562 0" --scale 1 2 1 --translate 3 0 1 --normal 1 1 0 --unit',
        NORMAL,
        "translation",
    ),
    MistakeId.USED_MODEL_VIEW: Symptom(
        "Lighting changes when the object rotates: the light went through view · model",
        (
            "lighting changes when object rotates",
            "light rotates with the object",
            "light direction multiplied by model view matrix",
            "light moves with the model",
        ),
        'light "0.9928 -4 0.1196" --space camera --scale 1 2 1 --rotate 0 30 0 --eye 3 0 4 '
        "--light-direction 1 -2 0",
        LIGHT,
        "stuck-light",
    ),
    MistakeId.DIRECTION_AS_POINT: Symptom(
        "A directional light changes when the camera moves: the direction had w = 1",
        (
            "light direction w 1 or 0",
            "directional light changes when camera moves",
            "sun moves with the camera",
            "vec4(lightDir, 1.0)",
        ),
        'light "0 -1 -5" --space camera --eye 3 0 4 --light-direction 0 -1 0',
        LIGHT,
    ),
    MistakeId.COURSE_LIGHT_RULE: Symptom(
        "Light direction in object space is wrong: it was moved like a normal",
        (
            "light direction inverse transpose",
            "transform light direction to object space",
            "transform light to model space",
            "light direction transposed model matrix",
        ),
        'light "0.3 0.225 0.2" --space object --scale 1 1/4 1 --light-direction 0.3 0.9 0.2',
        LIGHT,
        "object-rule",
    ),
    MistakeId.DEGREES_AS_RADIANS: Symptom(
        "Rotated by a strange angle: degrees taken for radians",
        (
            "degrees or radians",
            "rotation angle wrong radians degrees",
            "sin cos expect radians",
            "object rotated by wrong angle",
        ),
        'world "0.1543 0.9880 0 0; -0.9880 0.1543 0 0; 0 0 1 0; 0 0 0 1" --rotate 0 0 30',
        EULER,
    ),
    MistakeId.ROTATION_ORDER: Symptom(
        "Rotation wrong with more than one axis: Euler angles in another order",
        (
            "euler angles order",
            "rotation order xyz zyx",
            "rotations do not commute",
            "yaw pitch roll order wrong",
        ),
        'world "0.5 0.4330 0.75 0; 0 0.8660 -0.5 0; -0.8660 0.25 0.4330 0; 0 0 0 1" '
        "--rotate 30 60 0",
        EULER,
    ),
    MistakeId.ROTATION_SIGN: Symptom(
        "The object turns the other way: a rotation with the wrong sign",
        (
            "object rotates in the wrong direction",
            "rotation matrix sign of sine",
            "clockwise or counterclockwise rotation matrix",
            "right hand rule rotation",
        ),
        'world "0.8660 0 -0.5 1; 0 1 0 2; 0.5 0 0.8660 3; 0 0 0 1" '
        "--rotate 0 30 0 --translate 1 2 3",
        EULER,
    ),
    MistakeId.POLIMI_ANGLES_SWAPPED: Symptom(
        "Rotation about the wrong axis: the three angles belong to other axes",
        (
            "rotates around the wrong axis",
            "yaw pitch roll convention",
            "pitch and yaw swapped",
            "polimi angles",
        ),
        'world "1 0 0 1; 0 0.8660 -0.5 2; 0 0.5 0.8660 3; 0 0 0 1" '
        "--rotate 0 30 0 --translate 1 2 3",
        EULER,
    ),
    MistakeId.WRONG_HANDEDNESS: Symptom(
        "The camera looks the wrong way: left-handed or right-handed lookAt",
        (
            "camera looks the wrong way lookAt",
            "lookAt left handed right handed",
            "lookAtLH lookAtRH",
            "scene is behind the camera",
            "scene mirrored left right",
        ),
        'view "-0.8 0 0.6 0; 0 1 0 0; -0.6 0 -0.8 5; 0 0 0 1" --eye 3 0 4',
        LOOK_AT,
    ),
    MistakeId.DEPTH_RANGE: Symptom(
        "Near objects are clipped, or half of the depth is unused: −1 to 1, or 0 to 1",
        (
            "depth range -1 to 1 or 0 to 1",
            "opengl projection matrix in vulkan depth",
            "GLM_FORCE_DEPTH_ZERO_TO_ONE",
            "near objects clipped in vulkan direct3d",
        ),
        f'projection "0.5 0 0 0; 0 1 0 0; 0 0 -1.1111 -1.1111; 0 0 -1 0" {_LENS}',
        PERSPECTIVE,
        "depth",
    ),
    MistakeId.ASPECT_INVERTED: Symptom(
        "The picture is stretched: the aspect ratio is the wrong way round",
        (
            "picture stretched aspect ratio",
            "circle looks like an ellipse",
            "aspect ratio height over width",
            "scene distorted when window is resized",
        ),
        f'projection "2 0 0 0; 0 1 0 0; 0 0 -1.2222 -2.2222; 0 0 -1 0" {_LENS}',
        PERSPECTIVE,
    ),
    MistakeId.HORIZONTAL_FOV: Symptom(
        "Everything is too near or too far away: horizontal or vertical field of view",
        (
            "horizontal or vertical fov",
            "field of view too wide",
            "zoom wrong fovx fovy",
        ),
        f'projection "1 0 0 0; 0 2 0 0; 0 0 -1.2222 -2.2222; 0 0 -1 0" {_LENS}',
        PERSPECTIVE,
    ),
    MistakeId.NEAR_FAR_SWAPPED: Symptom(
        "Far objects are drawn over near ones: near and far are swapped",
        (
            "near and far swapped",
            "far objects drawn in front",
            "depth test inverted",
            "reversed z projection",
        ),
        f'projection "0.5 0 0 0; 0 1 0 0; 0 0 1.2222 2.2222; 0 0 -1 0" {_LENS}',
        PERSPECTIVE,
        "depth",
    ),
    MistakeId.SCALE_BEFORE_TRANSLATE: Symptom(
        "The object is at the wrong place: translation and scale in the wrong order",
        (
            "order of translate rotate scale",
            "translation scaled too",
            "object orbits instead of rotating in place",
            "matrix multiplication order TRS",
        ),
        'world "2 0 0 2; 0 2 0 0; 0 0 2 0; 0 0 0 1" --scale 2 2 2 --translate 1 0 0',
        WORLD,
    ),
    MistakeId.VIEW_NOT_INVERTED: Symptom(
        "The world moves with the camera: the camera's pose is not inverted",
        (
            "view matrix is inverse of camera matrix",
            "camera moves in the wrong direction",
            "camera pose instead of view matrix",
            "camera to world or world to camera",
        ),
        'view "0.8 0 0.6 3; 0 1 0 0; -0.6 0 0.8 4; 0 0 0 1" --eye 3 0 4',
        LOOK_AT,
    ),
    MistakeId.CLIP_Y: Symptom(
        "The picture is upside down: y in clip space, Vulkan or OpenGL",
        (
            "image upside down vulkan",
            "flip y projection matrix",
            "proj[1][1] *= -1",
            "vulkan y axis down",
        ),
        f'projection "0.5 0 0 0; 0 -1 0 0; 0 0 -1.2222 -2.2222; 0 0 -1 0" {_LENS}',
        PERSPECTIVE,
    ),
    MistakeId.VIEW_TRANSLATION: Symptom(
        "The camera stands at the wrong place: the eye itself in the last column",
        (
            "view matrix last column",
            "lookAt translation eye position",
            "view matrix translation is not minus eye",
            "dot(right, eye) lookAt",
        ),
        'view "0.8 0 -0.6 -3; 0 1 0 0; 0.6 0 0.8 -4; 0 0 0 1" --eye 3 0 4',
        LOOK_AT,
    ),
    MistakeId.VIEW_ROTATION_TRANSPOSED: Symptom(
        "The camera turns the wrong way: the rotation of lookAt is transposed",
        (
            "lookAt rotation transposed",
            "camera axes rows or columns",
            "view matrix right up forward columns",
            "camera rotates the wrong way",
        ),
        'view "0.8 0 0.6 0; 0 1 0 0; -0.6 0 0.8 -5; 0 0 0 1" --eye 3 0 4',
        LOOK_AT,
    ),
    MistakeId.VIEW_TRANSLATION_SIGN: Symptom(
        "The scene is behind the camera: the signs of the view's translation",
        (
            "lookAt negative dot product sign",
            "view matrix sign of translation",
            "nothing on screen after lookAt",
        ),
        'view "0.8 0 -0.6 0; 0 1 0 0; 0.6 0 0.8 5; 0 0 0 1" --eye 3 0 4',
        LOOK_AT,
    ),
    MistakeId.CAMERA_AXES: Symptom(
        "The picture is upside down and behind the camera: OpenCV's axes in OpenGL",
        (
            "opencv to opengl camera",
            "opencv camera coordinates y down z forward",
            "nerf colmap pose to opengl",
            "camera extrinsics flipped",
        ),
        'view "0.8 0 -0.6 0; 0 -1 0 0; -0.6 0 -0.8 5; 0 0 0 1" --eye 3 0 4',
        LOOK_AT,
    ),
    MistakeId.HALF_ANGLE: Symptom(
        "The field of view is twice as wide, or half: tan(fov) for tan(fov/2)",
        (
            "tan fov half angle",
            "perspective matrix 1/tan(fov/2)",
            "field of view halved twice",
        ),
        'projection "0.4195 0 0 0; 0 0.8391 0 0; 0 0 -1.2222 -2.2222; 0 0 -1 0" '
        "--fov 50 --aspect 2 --near 1 --far 10",
        PERSPECTIVE,
    ),
    MistakeId.FOCAL_INVERTED: Symptom(
        "Zooming in zooms out: tan(fov/2) for the focal length 1/tan(fov/2)",
        (
            "zoom inverted field of view",
            "focal length reciprocal tangent",
            "cotangent perspective matrix",
        ),
        'projection "0.2332 0 0 0; 0 0.4663 0 0; 0 0 -1.2222 -2.2222; 0 0 -1 0" '
        "--fov 50 --aspect 2 --near 1 --far 10",
        PERSPECTIVE,
    ),
    MistakeId.ASPECT_MISSING: Symptom(
        "The picture is squashed in a wide window: the aspect ratio is missing",
        (
            "aspect ratio missing projection",
            "picture squashed in wide window",
            "cube looks wide in widescreen",
        ),
        f'projection "1 0 0 0; 0 1 0 0; 0 0 -1.2222 -2.2222; 0 0 -1 0" {_LENS}',
        PERSPECTIVE,
    ),
    MistakeId.PERSPECTIVE_ROW: Symptom(
        "No perspective, or everything is clipped: the last row of the projection",
        (
            "projection matrix last row 0 0 -1 0",
            "no perspective objects same size",
            "w negative everything clipped",
        ),
        f'projection "0.5 0 0 0; 0 1 0 0; 0 0 -1.2222 -2.2222; 0 0 1 0" {_LENS}',
        PERSPECTIVE,
    ),
    MistakeId.DEPTH_SIGN: Symptom(
        "Depth test wrong: signs in the third row of the projection",
        (
            "projection matrix third row sign",
            "depth values negative",
            "everything clipped at near plane",
        ),
        f'projection "0.5 0 0 0; 0 1 0 0; 0 0 -1.2222 2.2222; 0 0 -1 0" {_LENS}',
        PERSPECTIVE,
    ),
    MistakeId.DEPTH_FACTOR: Symptom(
        "Depth values out of range: the factor of far · near / (far − near)",
        (
            "projection matrix 2fn/(f-n)",
            "depth not between 0 and 1",
            "depth buffer all zero",
        ),
        f'projection "0.5 0 0 0; 0 1 0 0; 0 0 -1.2222 -1.1111; 0 0 -1 0" {_LENS}',
        PERSPECTIVE,
    ),
    MistakeId.SCALE_AFTER_ROTATION: Symptom(
        "The rotated object is sheared or stretched along the world: scaled after the rotation",
        (
            "object sheared when scaled and rotated",
            "scale before rotation or after",
            "rotate then scale skews",
        ),
        'world "0 -1 0 0; 2 0 0 0; 0 0 1 0; 0 0 0 1" --rotate 0 0 90 --scale 1 2 1',
        WORLD,
    ),
    MistakeId.TRANSLATION_MISSING: Symptom(
        "The object stays at the origin: the translation is missing",
        (
            "object stays at the origin",
            "translation has no effect",
            "model matrix translation not applied",
        ),
        'world "2 0 0 0; 0 2 0 0; 0 0 2 0; 0 0 0 1" --scale 2 2 2 --translate 1 0 0',
        WORLD,
    ),
    MistakeId.ROTATION_MISSING: Symptom(
        "The camera or the object does not rotate: the rotation is missing",
        (
            "rotation has no effect",
            "object does not rotate",
            "lookAt does not turn the camera",
        ),
        'view "1 0 0 -3; 0 1 0 0; 0 0 1 -4; 0 0 0 1" --eye 3 0 4',
        LOOK_AT,
    ),
    MistakeId.SCALE_MISSING: Symptom(
        "The object has the wrong size: the scale is missing or the same for all axes",
        (
            "scale has no effect",
            "object has the wrong size",
            "uniform scale instead of non-uniform scale",
        ),
        'world "2 0 0 0; 0 2 0 0; 0 0 2 0; 0 0 0 1" --scale 1 2 3',
        WORLD,
    ),
    MistakeId.WORLD_INVERTED: Symptom(
        "The object moves the opposite way: the world matrix is inverted",
        (
            "object moves in the opposite direction",
            "model matrix inverted",
            "world to object instead of object to world",
        ),
        'world "1 0 0 -1; 0 1 0 -2; 0 0 1 -3; 0 0 0 1" --translate 1 2 3',
        WORLD,
    ),
    MistakeId.QUATERNION_ORDER: Symptom(
        "The quaternion gives another rotation: w first or w last",
        (
            "quaternion order wxyz xyzw",
            "quaternion w first or last",
            "quaternion rotation wrong",
        ),
        'world "-0.28 0 0.96 0; 0 -1 0 0; 0.96 0 0.28 0; 0 0 0 1" --quaternion 0 0.6 0 0.8',
        QUATERNION,
    ),
    MistakeId.QUATERNION_LENGTH: Symptom(
        "The quaternion scales or skews the object: it is not normalised",
        (
            "quaternion not normalized",
            "object grows when rotating with quaternion",
            "quaternion to matrix scaling",
        ),
        'world "7 0 24 0; 0 25 0 0; -24 0 7 0; 0 0 0 1" --quaternion 0 3 0 4',
        QUATERNION,
    ),
    MistakeId.AXES_CONJUGATED: Symptom(
        "Imported objects are turned after a change of axes: F · M · F instead of F · M · F⁻¹",
        (
            "convert matrix between coordinate systems",
            "change of basis matrix F M F inverse",
            "imported model rotated wrong axes",
        ),
        'axes "0 0 -1 1; 0 -1 0 3; -1 0 0 -2; 0 0 0 1" --from blender --to opengl '
        "--rotate 0 0 90 --translate 1 2 3",
        AXES,
    ),
    MistakeId.AXES_HALF_CONJUGATED: Symptom(
        "Imported objects lie on their side: the axes are changed on one side alone",
        (
            "imported model lies on its side",
            "model rotated by 90 degrees after import",
            "convert transform z up to y up",
        ),
        'axes "0 -1 0 1; 0 0 1 3; -1 0 0 -2; 0 0 0 1" --from blender --to opengl '
        "--rotate 0 0 90 --translate 1 2 3",
        AXES,
    ),
    MistakeId.UP_AXIS: Symptom(
        "The model is mirrored after y up to z up: swapped without the sign",
        (
            "y up to z up",
            "swap y and z mirrored",
            "blender to opengl axes",
            "model mirrored after import",
        ),
        'axes "1 0 0; 0 0 1; 0 1 0" --from blender --to opengl',
        AXES,
    ),
    MistakeId.NORMAL_ROTATION_ONLY: Symptom(
        "Normals ignore the scale: only the rotation was used",
        (
            "normals ignore scale",
            "rotate normal only rotation matrix",
            "normals wrong on ellipsoid",
            "quaternion rotate normal scaled object",
        ),
        'normal "0 -1 0; 1 0 0; 0 0 1" --rotate 0 0 90 --scale 1 2 1',
        NORMAL,
        "normals",
    ),
    MistakeId.NORMAL_TRANSLATED: Symptom(
        "Normals all lean one way: the translation was added to the normal",
        (
            "translation added to normal",
            "normals all point in one direction",
            "translate normals",
        ),
        'normal "4 0.5 0" --scale 1 2 1 --translate 3 0 0 --normal 1 1 0',
        NORMAL,
        "translation",
    ),
    MistakeId.LIGHT_TOWARDS: Symptom(
        "The lit side is dark: the light's direction has the wrong sign",
        (
            "light comes from the wrong side",
            "light direction sign negative dot",
            "wrong side of the object is lit",
            "dot(normal, lightDir) negative",
        ),
        'light "-1 2 0" --space world --light-direction 1 -2 0',
        LIGHT,
    ),
    MistakeId.W_NOT_DIVIDED: Symptom(
        "The vertex is far off the screen: not divided by w",
        (
            "divide by w perspective divide",
            "clip space to ndc",
            "screen position wrong far from the camera",
        ),
        'trace "1.4852 3.2636 4.8809 5.0709" --point 1 2 0 --eye 3 1 5',
        WINDOW,
        "interpolation",
    ),
    MistakeId.WINDOW_Y: Symptom(
        "The mouse picks the mirrored place: y of the window counts from the other side",
        (
            "screen y flipped",
            "mouse y inverted picking",
            "window origin top left or bottom left",
            "ndc to pixel coordinates y",
        ),
        'trace "403.1384 156.8616 0.9810" --point 1 1 0 --eye 0 0 5 --window --viewport 640 480',
        WINDOW,
    ),
}

RULES: dict[RuleId, tuple[str, ...]] = {
    RuleId.NORMAL_BY_MATRIX: (
        "normals wrong non-uniform scale shader",
        "mat3(model) * normal",
        "mat3(transpose(inverse(model)))",
    ),
    RuleId.NORMAL_WITH_W: (
        "vec4(aNormal, 1.0) in vertex shader",
        "normal w component 0 or 1",
    ),
    RuleId.TANGENT_BY_NORMAL_MATRIX: (
        "tangent transform normal matrix",
        "TBN matrix tangent wrong",
        "normal map wrong on scaled object",
    ),
    RuleId.NORMAL_BY_PROJECTION: (
        "normal multiplied by mvp matrix",
        "normal matrix from model view projection",
    ),
    RuleId.HALF_INVERSE_TRANSPOSE: (
        "inverse(model) normal without transpose",
        "transpose(model) normal shader",
    ),
    RuleId.SPACES_MIXED: (
        "view space and world space mixed in shader",
        "dot product of vectors in different spaces",
        "lighting wrong when camera rotates",
    ),
    RuleId.LIGHT_BY_MODEL_VIEW: (
        "light position multiplied by modelview",
        "light rotates with object shader",
    ),
    RuleId.WRONG_W: ("vec4 w 1 for position 0 for direction", "direction moved by translation"),
    RuleId.PRODUCT_ORDER: (
        "matrix multiplication order shader",
        "model * view * projection wrong order",
        "mvp order glsl",
    ),
    RuleId.EYE_AT_ORIGIN: (
        "view direction normalize(-position) world space",
        "specular highlight wrong world space",
        "specular does not follow the camera",
    ),
    RuleId.STUCK_LIGHT: (
        "light moves with camera shader",
        "light position in world space normal in view space",
    ),
    RuleId.NOT_NORMALISED: (
        "normalize interpolated normal in fragment shader",
        "faceted or dark spots in smooth shading",
    ),
    RuleId.FOUR_COMPONENTS: ("normalize(vec4)", "normalize vec4 includes w"),
    RuleId.REFLECTED_WRONG_WAY: (
        "reflect(-lightDir, normal)",
        "glsl reflect direction sign",
        "specular highlight on the wrong side",
    ),
    RuleId.W_NOT_DIVIDED: (
        "shadow map coordinates divide by w",
        "projective texture divide by w",
        "gl_Position to ndc in shader",
    ),
    RuleId.POWER_OF_NEGATIVE: (
        "pow negative base NaN",
        "black pixels specular pow",
        "specular on the back side",
    ),
    RuleId.HALFWAY_NOT_UNIT: (
        "halfway vector normalize blinn phong",
        "blinn phong highlight too dim",
    ),
    RuleId.INVERSE_IN_SHADER: (
        "inverse() in vertex shader slow",
        "compute normal matrix on cpu",
        "transpose(inverse(model)) performance",
    ),
}
