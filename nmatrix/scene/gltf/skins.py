"""The skins of a glTF file: the joints that carry a mesh, exactly.

A vertex of a skinned mesh stands where Σ wᵢ · Jᵢ takes it, with Jᵢ = (world from joint) · (inverse
bind matrix) of the joint that its i-th weight belongs to. The transform of the mesh's own node does
not count (glTF 2.0, 3.7.3.3).
"""

from __future__ import annotations

from nmatrix.errors import counted
from nmatrix.linear.rational import AFFINE_ROW, RationalMatrix, product
from nmatrix.scene.gltf.file import GltfFile

LAST_ROW_SLACK = 1e-6  # files hold float32


def joint_matrices(file: GltfFile, skin_index: int) -> tuple[RationalMatrix, ...]:
    """Multiply each joint's world matrix and its inverse bind matrix, exactly.

    They are 4×4 matrices that take the mesh as it was modelled to the world, in the order of the
    skin's `joints`: what `JOINTS_n` counts. Without inverse bind matrices those are identities.

    Raises
    ------
    IllegalValueError
        For a skin or a joint that does not exist, and inverse bind matrices that are too few,
        beyond their buffer, or do not end in 0 0 0 1.
    """
    if skin_index not in file.kept.joints:
        file.kept.joints[skin_index] = _joint_matrices(file, skin_index)
    return file.kept.joints[skin_index]


def _joint_matrices(file: GltfFile, skin_index: int) -> tuple[RationalMatrix, ...]:
    skin = file.entry("skin", file.document.skins, skin_index)
    worlds = [
        file.entry("joint", file.nodes, joint, f"skins[{skin_index}].joints[{i}]").world_from_object
        for i, joint in enumerate(skin.joints)
    ]
    if skin.inverse_bind_matrices is None:
        return tuple(worlds)
    from nmatrix.scene.gltf.accessors import values

    what = f"the inverse bind matrices of skin {skin_index}"
    found = values(file, skin.inverse_bind_matrices, what, ("MAT4",))
    if len(found) < len(worlds):
        raise file.fault(f"{what} are {len(found)}, and it has {counted(len(worlds), 'joint')}")
    joints = []
    for i, world in enumerate(worlds):
        (entries,) = found.exact(slice(i, i + 1))
        rows = tuple(entries[j : j + 4] for j in range(0, 16, 4))
        if max(abs(x - y) for x, y in zip(rows[3], AFFINE_ROW, strict=True)) > LAST_ROW_SLACK:
            raise file.fault(f"inverse bind matrix {i} of skin {skin_index} ends not in 0 0 0 1")
        joints.append(product(world, (*rows[:3], AFFINE_ROW)))
    return tuple(joints)
