"""The extensions of glTF: those that are read, those that pack meshes, those that are left out."""

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum, auto


class Treatment(Enum):
    """What becomes of an extension.

    READ: all of it. PACKING: meshes are packed by it. IMAGES: another format of images, which is
    not read. LEFT_OUT: it changes how light is sent back, or adds what no picture shows.
    UNKNOWN: nobody here knows what it means.
    """

    READ = auto()
    PACKING = auto()
    IMAGES = auto()
    LEFT_OUT = auto()
    UNKNOWN = auto()


LIGHTS = "KHR_lights_punctual"
TEXTURE_TRANSFORM = "KHR_texture_transform"
UNLIT = "KHR_materials_unlit"
EMISSIVE_STRENGTH = "KHR_materials_emissive_strength"
SPECULAR_GLOSSINESS = "KHR_materials_pbrSpecularGlossiness"
QUANTIZATION = "KHR_mesh_quantization"
INSTANCING = "EXT_mesh_gpu_instancing"
DRACO = "KHR_draco_mesh_compression"
MESHOPT = ("EXT_meshopt_compression", "KHR_meshopt_compression")

READ = (LIGHTS, TEXTURE_TRANSFORM, UNLIT, EMISSIVE_STRENGTH, QUANTIZATION, INSTANCING)
PACKING = {DRACO: "Draco", **dict.fromkeys(MESHOPT, "meshopt")}  # and what they are called
IMAGES = {"KHR_texture_basisu": "KTX2", "EXT_texture_webp": "WebP", "EXT_texture_avif": "AVIF"}
LEFT_OUT = (
    SPECULAR_GLOSSINESS,
    "KHR_xmp",
    "KHR_xmp_json_ld",
    "KHR_animation_pointer",
    "KHR_node_visibility",
    "KHR_node_hoverability",
    "KHR_node_selectability",
    "EXT_lights_image_based",
    "EXT_texture_procedurals",
    "MSFT_lod",
    "MSFT_packing_normalRoughnessMetallic",
    "MSFT_packing_occlusionRoughnessMetallic",
)
OF_MATERIALS = ("KHR_materials_", "EXT_materials_", "ADOBE_materials_")


def treatment(extension: str) -> Treatment:
    """Tell what becomes of an extension.

    Examples
    --------
    >>> treatment("KHR_materials_clearcoat"), treatment("ACME_teapot")
    (<Treatment.LEFT_OUT: 4>, <Treatment.UNKNOWN: 5>)
    """
    if extension in READ:
        return Treatment.READ
    if extension in PACKING:
        return Treatment.PACKING
    if extension in IMAGES:
        return Treatment.IMAGES
    if extension in LEFT_OUT or extension.startswith(OF_MATERIALS):
        return Treatment.LEFT_OUT
    return Treatment.UNKNOWN


def treated(extensions: Sequence[str], *kinds: Treatment) -> list[str]:
    """List those of some extensions that one of these becomes of, each once.

    Examples
    --------
    >>> treated(["ACME_teapot", "KHR_lights_punctual", "ACME_teapot"], Treatment.UNKNOWN)
    ['ACME_teapot']
    """
    return [one for one in dict.fromkeys(extensions) if treatment(one) in kinds]
