"""Materials: the parts of light that a surface reflects, its images, the sides that are drawn."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

from nmatrix.enums import Reflection
from nmatrix.linear.angle import Angle
from nmatrix.scene.words import Filter, Pattern, Sides, Wrap

Colour = tuple[float, float, float]

AMBIENT_SHARE = 0.15  # of diffuse, where a file does not say


@dataclass(frozen=True)
class EmbeddedImage:
    """An image that a scene file holds itself: where it stands there, and its bytes."""

    name: str
    content: bytes

    def __str__(self) -> str:
        """Return the name, by which messages speak of it."""
        return self.name


ImageSource = Path | EmbeddedImage
Two = tuple[float, float]


@dataclass(frozen=True)
class Texture:
    """An image, and where coordinates (u, v) of a mesh fall on it, v upwards.

    Coordinates are scaled, turned counter-clockwise about 0 0, and moved, in this order. What then
    lies outside of the unit square is wrapped, along u and along v. An optional image that cannot
    be read is left out with a remark; any other stops the picture.
    """

    image: ImageSource | Pattern
    wrap: tuple[Wrap, Wrap] = (Wrap.REPEAT, Wrap.REPEAT)
    scale: Two = (1.0, 1.0)
    rotation_degrees: float = 0.0
    offset: Two = (0.0, 0.0)
    filter: Filter = Filter.LINEAR
    is_optional: bool = False

    @property
    def uv_map(self) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
        """The rows of the map from the mesh's coordinates (u, v, 1) to those on the image.

        Examples
        --------
        >>> Texture(Pattern.CHECKER, scale=(2, 3), rotation_degrees=90, offset=(5, 7)).uv_map
        ((0.0, -3.0, 5.0), (2.0, 0.0, 7.0))
        """
        angle = Angle.degrees(self.rotation_degrees)
        sine, cosine = float(angle.sine), float(angle.cosine)
        (across, up), (right, above) = self.scale, self.offset
        return (
            (cosine * across, -sine * up, float(right)),
            (sine * across, cosine * up, float(above)),
        )


CHECKER = Texture(Pattern.CHECKER)
SQUARES = 8  # of the checker, along a unit of u and of v
DARK = 0.35


def grey(level: float) -> Colour:
    """Return a colour with the three channels alike.

    Examples
    --------
    >>> grey(0.5)
    (0.5, 0.5, 0.5)
    """
    return (level, level, level)


WHITE, BLACK = grey(1.0), grey(0.0)


def colour(value: float | list[float]) -> Colour:
    """Return the colour of one level, or of three.

    Examples
    --------
    >>> colour(0.5), colour([1.0, 0.5, 0.0])
    ((0.5, 0.5, 0.5), (1.0, 0.5, 0.0))
    """
    if isinstance(value, list):
        red, green, blue = value
        return red, green, blue
    return grey(value)


def times(of: Colour, factor: float) -> Colour:
    """Make a colour brighter or darker.

    Examples
    --------
    >>> times((1.0, 0.5, 0.0), 0.5)
    (0.5, 0.25, 0.0)
    """
    red, green, blue = of
    return factor * red, factor * green, factor * blue


@dataclass(frozen=True)
class Material:
    """How much of each kind of light a surface sends back, channel by channel, in [0, 1].

    Parameters
    ----------
    ambient, diffuse, specular
        Reflected parts of red, green and blue.
    shininess
        The exponent of the highlight, not negative.
    reflection
        Lambert has no highlight; toon has bands in its place.
    unlit
        A colour that is shown as it is, whatever light falls on it; None where light is asked.
    emission
        Light that the surface sends out itself; it lights nothing else.
    opacity
        1 hides what is behind, 0 is glass.
    has_alpha
        Whether the alpha of the texture and of the vertices multiplies the opacity.
    alpha_cutoff
        What has less opacity is a hole, and the rest hides what is behind; None cuts no holes.
    texture
        An image, or `CHECKER`; it multiplies ambient, diffuse and unlit.
    emission_texture
        An image that multiplies the emission.
    normal_map
        An image of normals in tangent space.
    toon_steps
        Bands of toon reflection, 1 at least.
    outline
        A black line around the body, as thick as the rim of a ball of its size where the cosine of
        normal and eye is below this; 0 draws none.
    vertex_colours
        Whether the mesh's own colours multiply ambient, diffuse and unlit.
    sides
        Which sides are drawn; as needed: both where the mesh is open or the eye inside.
    """

    name: str = "default"
    ambient: Colour = (0.12, 0.12, 0.12)
    diffuse: Colour = (0.78, 0.78, 0.78)
    specular: Colour = (0.45, 0.45, 0.45)
    shininess: float = 32.0
    reflection: Reflection = Reflection.LAMBERT
    unlit: Colour | None = None
    emission: Colour = BLACK
    opacity: float = 1.0
    has_alpha: bool = False
    alpha_cutoff: float | None = None
    texture: Texture | None = None
    emission_texture: Texture | None = None
    normal_map: Texture | None = None
    toon_steps: int = 3
    outline: float = 0.0
    vertex_colours: bool = False
    sides: Sides = Sides.AS_NEEDED

    @property
    def shines(self) -> bool:
        """True if there is a highlight at all."""
        models = (Reflection.PHONG, Reflection.BLINN_PHONG)
        return self.unlit is None and self.reflection in models and any(self.specular)

    @property
    def is_clear(self) -> bool:
        """True if what is behind shows through."""
        return self.alpha_cutoff is None and (self.opacity < 1.0 or self.has_alpha)

    @property
    def textures(self) -> dict[str, Texture]:
        """The images and patterns that it has, by the names of their fields."""
        named = {
            "texture": self.texture,
            "normal_map": self.normal_map,
            "emission_texture": self.emission_texture,
        }
        return {name: one for name, one in named.items() if one is not None}

    def without_light(self) -> Material:
        """Show the diffuse colour as it is, and send no light back.

        Examples
        --------
        >>> Material(diffuse=WHITE).without_light().unlit
        (1.0, 1.0, 1.0)
        """
        return replace(self, unlit=self.diffuse, ambient=BLACK, diffuse=BLACK)


DEFAULT_MATERIAL = Material()
