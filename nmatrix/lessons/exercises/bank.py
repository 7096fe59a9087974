"""What questions of understanding are drawn from: a line of code, a claim, and why."""

from __future__ import annotations

# The spaces, and what else people call them.
SPACE_OPTIONS: dict[str, tuple[str, ...]] = {
    "object": ("object space", "model", "model space", "local", "local space"),
    "world": ("world space",),
    "camera": ("camera space", "view", "view space", "eye", "eye space"),
    "clip": ("clip space",),
}

# A line of a shader, the space of what it computes, and the reason.
SPACES: tuple[tuple[str, str, str], ...] = (
    (
        "vec3 x = (camera_from_world * world_from_object * vec4(vertex_position, 1.0)).xyz;",
        "camera",
        "Read from the right: object to world, world to camera.",
    ),
    (
        "vec3 x = mat3(transpose(inverse(world_from_object))) * vertex_normal;",
        "world",
        "The inverse transpose carries a normal to where the matrix leads: to the world.",
    ),
    (
        "vec3 x = (inverse(world_from_object) * vec4(light_position, 1.0)).xyz;",
        "object",
        "The inverse of world_from_object leads from the world to the object.",
    ),
    (
        "vec3 x = mat3(camera_from_world) * light_direction;",
        "camera",
        "A direction moves by the 3×3 block, from the world to the camera.",
    ),
    (
        "vec4 x = clip_from_camera * camera_from_world * vec4(light_position, 1.0);",
        "clip",
        "The light is in the world; view and projection take it to clip space.",
    ),
    (
        "vec3 x = normalize(eye_position - (world_from_object * vec4(vertex_position, 1.0)).xyz);",
        "world",
        "The eye is in the world and the vertex has been moved there: so is their difference.",
    ),
    (
        "vec3 x = inverse(mat3(world_from_object)) * light_direction;",
        "object",
        "A direction moves by the inverse of the 3×3 block, from the world to the object.",
    ),
    (
        "vec3 x = normalize(-(camera_from_world * world_from_object * "
        "vec4(vertex_position, 1.0)).xyz);",
        "camera",
        "Both matrices lead to camera space; there the eye is the origin, so −p points to it.",
    ),
)

Said = tuple[str, str]  # an option, and what is to be said about it

# A question, the right option, and the wrong ones.
CONCEPTS: tuple[tuple[str, Said, tuple[Said, ...]], ...] = (
    (
        "Which w does a direction have, such as that of sunlight?",
        ("0", "A direction has no place, so no translation may touch it."),
        (
            ("1", "With w = 1 the translation would be added: that is a point."),
            ("any", "w decides whether the translation is added."),
            ("−1", "That would subtract the translation."),
        ),
    ),
    (
        "Which part of a shaded sphere moves when only the eye moves?",
        ("the highlight", "It depends on where the light is reflected to: the specular part."),
        (
            ("the bright half", "Lambert's term knows the light and the normal, not the eye."),
            ("the ambient part", "It is a constant."),
            ("the shadow", "A shadow knows the light and what stands in its way."),
        ),
    ),
    (
        "Gouraud shading evaluates light",
        ("at vertices", "And interpolates the colour: a highlight inside a triangle is lost."),
        (
            ("at fragments", "That is Phong shading."),
            ("at faces", "That is flat shading."),
            ("with the half vector", "That is Blinn and Phong's reflection, another matter."),
        ),
    ),
    (
        "A shader moves normals by A itself, and every rotated object looks right. Why is that no "
        "proof?",
        (
            "for every rotation A⁻ᵀ is A",
            "So that test cannot tell them apart: stretch the object.",
        ),
        (
            ("rotations have determinant 1", "So has a shear, where A is wrong."),
            ("rotations move no normals", "They do; both matrices move them alike."),
            ("floats are too coarse", "The identity is exact."),
        ),
    ),
    (
        "A mirror has a negative determinant. What becomes of the cofactor matrix times a normal?",
        ("it points inwards", "cofactor = det · inverse transpose: multiply by the sign of det."),
        (
            ("it is right", "That holds for positive determinants alone."),
            ("it is zero", "Only where the map flattens can it vanish."),
            ("it is not perpendicular", "It is; only its side is wrong."),
        ),
    ),
    (
        "Where is the eye in camera space?",
        ("at the origin", "That is what camera space is: so the vector to the eye is −p/|p|."),
        (
            ("at (0, 0, 1)", "Nothing stands there."),
            ("at the near plane", "That lies in front of the eye."),
            ("in the view matrix's last column", "That is −R · eye: where the world's origin is."),
        ),
    ),
    (
        "Normals of different lengths are interpolated and then normalised. The result",
        ("leans to the longer one", "Normalise before as well as after interpolation."),
        (
            ("is right", "Only for equal lengths."),
            ("is too short", "Its length was brought to 1."),
            ("leans to the shorter one", "The longer one weighs more."),
        ),
    ),
    (
        "n · l < 0 and r · v > 0. How bright is the highlight?",
        ("there is none", "The light is behind the surface: gate on n · l, not on r · v."),
        (
            ("as bright as can be", "r · v says so, and the surface is in its own shadow."),
            ("half as bright", "There is no half: no light arrives."),
            ("it depends on the shininess", "No light, no highlight; and 0⁰ must not glow."),
        ),
    ),
    (
        "How do tangents move, beside normals that move by A⁻ᵀ?",
        ("by A", "A tangent is a difference of two points of the surface."),
        (
            ("by A⁻ᵀ", "Then t · n = 0 would be lost under a stretch."),
            ("by A⁻¹", "That leads back to object space."),
            ("by Aᵀ", "Only rotations would forgive that, the other way round."),
        ),
    ),
)
