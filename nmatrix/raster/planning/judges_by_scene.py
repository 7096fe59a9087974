"""Effects that are on where the scene names them, and else add exactly nothing."""

from __future__ import annotations

from nmatrix.enums import Reflection, Shading
from nmatrix.raster.planning.decision import Verdict
from nmatrix.raster.planning.facts import Facts
from nmatrix.scene.words import LightKind


def ambient(facts: Facts) -> Verdict:
    """Decide on light from everywhere."""
    if not any(facts.body.material.ambient):
        return False, "the material sends none of it back"
    return True, "the material sends some of it back"


def diffuse(facts: Facts) -> Verdict:
    """Decide on Lambert's cosine."""
    if not any(facts.body.material.diffuse):
        return False, "the material has no diffuse part"
    if not facts.lights:
        return False, "no light reaches it"
    return True, f"{len(facts.lights)} of {len(facts.loaded.lights)} lamps can reach it"


def specular(facts: Facts) -> Verdict:
    """Decide on highlights."""
    if not facts.body.material.shines:
        return False, "the material has no highlight"
    return (True, "the material shines") if facts.lights else (False, "no light reaches it")


def toon(facts: Facts) -> Verdict:
    """Decide on bands."""
    if facts.body.material.reflection is Reflection.TOON:
        return True, f"the material has {facts.body.material.toon_steps} bands"
    return False, "the material is smooth"


def outline(facts: Facts) -> Verdict:
    """Decide on lines where a surface turns away."""
    if not facts.body.material.outline:
        return False, "the material has no outline"
    if facts.loaded.settings.shading is not Shading.PHONG:
        return False, "an outline is drawn only where normals reach the fragments"
    return True, "the material has an outline"


def attenuation(facts: Facts) -> Verdict:
    """Decide on light that fades or ends."""
    fading = [
        one.light.name for one in facts.lights if one.position is not None and one.light.fades
    ]
    if fading:
        return True, f"{', '.join(fading)} fades with distance"
    return False, "no lamp that reaches it fades or ends"


def spot(facts: Facts) -> Verdict:
    """Decide on cones of light."""
    spots = [one.light.name for one in facts.lights if one.light.kind is LightKind.SPOT]
    return (True, f"{', '.join(spots)} has a cone") if spots else (False, "no lamp has a cone")


def texture(facts: Facts) -> Verdict:
    """Decide on images and patterns."""
    if facts.body.material.texture is None:
        return False, "the material has no texture"
    if facts.body.mesh.uv is None:
        return False, "the mesh has no texture coordinates"
    return True, "the material has a texture"


def normal_map(facts: Facts) -> Verdict:
    """Decide on normals from an image."""
    if facts.body.material.normal_map is None:
        return False, "the material has no normal map"
    if facts.body.mesh.tangents is None or facts.loaded.settings.shading is not Shading.PHONG:
        return False, "the mesh has no tangents, or light is not evaluated at fragments"
    return True, "the material has a normal map"


def vertex_colours(facts: Facts) -> Verdict:
    """Decide on colours of the vertices."""
    if facts.body.material.vertex_colours and facts.body.mesh.colours is not None:
        return True, "the mesh has colours"
    return False, "the mesh has no colours of its own"


def transparency(facts: Facts) -> Verdict:
    """Decide on what lets light through."""
    opacity = facts.body.material.opacity
    return (True, f"opacity {opacity:g}") if opacity < 1.0 else (False, "everything is opaque")


def fog(facts: Facts) -> Verdict:
    """Decide on fog."""
    fog = facts.loaded.settings.fog
    return (True, f"fog ends at {fog.end:g}") if fog else (False, "the scene has no fog")
