"""Lines of a program that are right, a family of mistakes each; a test runs those in Python."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Cure:
    """Lines in one language, and where they belong."""

    language: str
    where: str
    lines: str


NORMAL = Cure(
    "glsl",
    "In the vertex shader, with a matrix that the program computes once for each object",
    """\
// normalMatrix = transpose(inverse(mat3(model))), computed outside
vec3 n = normalize(normalMatrix * normal);""",
)
NORMALISE = Cure(
    "glsl",
    "In the fragment shader, since interpolation shortens what the vertex shader normalised",
    """\
vec3 n = normalize(normalWorld);
float diffuse = max(dot(n, toLight), 0.0);""",
)
LIGHT = Cure(
    "glsl",
    "Before the lighting, for a light of the world and lighting in camera space",
    """\
vec3 direction = normalize(mat3(view) * lightDirection);       // a vector, w = 0
vec3 toSun = -direction;                                       // against the way it travels
vec3 toLamp = (view * vec4(lightPosition, 1.0)).xyz - position;  // a point, w = 1""",
)
COFACTORS = Cure(
    "python",
    "In NumPy, for any map: cofactors have no division, and the sign keeps normals outside",
    """\
def normal_matrix(world):
    a, b, c = world[:3, :3].T  # its columns
    cofactors = np.column_stack([np.cross(b, c), np.cross(c, a), np.cross(a, b)])
    return cofactors if a @ np.cross(b, c) >= 0 else -cofactors""",
)
LAYOUT = Cure(
    "js",
    "Where a matrix leaves the program: OpenGL, WebGL, glTF and three.js's elements count by columns",
    """\
const columns = [0, 1, 2, 3].flatMap((j) => rows.map((row) => row[j]));
gl.uniformMatrix4fv(place, false, columns);""",
)
EULER = Cure(
    "python",
    "In NumPy, R = Rx · Ry · Rz, by the right-hand rule, with sines of radians",
    """\
def rotation(degrees):
    (cx, cy, cz), (sx, sy, sz) = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    about_x = np.array([[1, 0, 0], [0, cx, -sx], [0, sx, cx]])
    about_y = np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])
    about_z = np.array([[cz, -sz, 0], [sz, cz, 0], [0, 0, 1]])
    return about_x @ about_y @ about_z""",
)
WORLD = Cure(
    "python",
    "In NumPy, M = T · R · S: the scale stands next to the vector, the translation comes last",
    """\
def world(translate, rotation, scale):
    matrix = np.eye(4)
    matrix[:3, :3] = rotation @ np.diag(scale)
    matrix[:3, 3] = translate
    return matrix""",
)
QUATERNION = Cure(
    "python",
    "In NumPy, of x y z w in this order, of any length but zero",
    """\
def rotation_of(quaternion):
    x, y, z, w = np.asarray(quaternion) / np.linalg.norm(quaternion)
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ])""",
)
LOOK_AT = Cure(
    "python",
    "In NumPy, for a right-handed camera that looks down −z: its axes are rows, the eye is turned too",
    """\
def look_at(eye, target, up):
    back = eye - target
    right = np.cross(up, back)
    axes = np.array([right, np.cross(back, right), back])
    axes = axes / np.linalg.norm(axes, axis=1, keepdims=True)
    view = np.eye(4)
    view[:3, :3] = axes
    view[:3, 3] = -axes @ eye
    return view""",
)
PERSPECTIVE = Cure(
    "python",
    "In NumPy, with OpenGL's depth from −1 to 1; for Vulkan negate the second row as well",
    """\
def perspective(fov_degrees, aspect, near, far, zero_to_one=False):
    focal = 1 / np.tan(np.radians(fov_degrees) / 2)
    depth = far if zero_to_one else far + near
    factor = 1 if zero_to_one else 2
    return np.array([
        [focal / aspect, 0, 0, 0],
        [0, focal, 0, 0],
        [0, 0, -depth / (far - near), -factor * far * near / (far - near)],
        [0, 0, -1, 0],
    ])""",
)
WINDOW = Cure(
    "python",
    "In NumPy, from OpenGL's clip space to pixels, with y from the bottom or, as mice and images count, from the top",
    """\
def window(clip, width, height, from_the_top=False):
    x, y, z = clip[:3] / clip[3]
    up = (1 - y) / 2 if from_the_top else (1 + y) / 2
    return np.array([(1 + x) / 2 * width, up * height, (1 + z) / 2])""",
)
AXES = Cure(
    "python",
    "In NumPy, from z up (Blender) to y up (OpenGL): (x, z, −y), on both sides of a matrix",
    """\
F = np.array([[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]])

def in_y_up(matrix):
    return F @ matrix @ np.linalg.inv(F)""",
)
CURES = (NORMAL, NORMALISE, LIGHT, COFACTORS, LAYOUT, EULER, WORLD, QUATERNION, LOOK_AT,
         PERSPECTIVE, WINDOW, AXES)  # fmt: skip
