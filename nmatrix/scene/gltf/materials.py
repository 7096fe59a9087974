"""The materials of a glTF file as far as they are drawn, and a remark for what is not."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from math import cos, degrees, sin
from urllib.parse import unquote

from nmatrix.errors import IllegalValueError, printable, shortlist
from nmatrix.reading.files import existing_file
from nmatrix.scene.beside import beside
from nmatrix.scene.gltf.file import Entry, GltfFile
from nmatrix.scene.gltf.records import MaterialRecord, MetallicRoughness, Sampler, TextureReference
from nmatrix.scene.material import (
    BLACK,
    Colour,
    EmbeddedImage,
    ImageSource,
    Material,
    Texture,
    times,
)
from nmatrix.scene.words import Filter, Sides, Wrap

MOST_NAMED = 4  # files that a remark names
AMBIENT_PART = 0.05  # of all light that a surface sends back; in sRGB it is a quarter of white
ALPHA_MODES = ("OPAQUE", "MASK", "BLEND")
NEAREST = 9728
WRAPS = {10497: Wrap.REPEAT, 33071: Wrap.CLAMP, 33648: Wrap.MIRROR}


@dataclass
class Materials:
    """The materials of one file; it collects what they could not bring along."""

    file: GltfFile
    missing: list[str] = field(default_factory=list)
    damaged: list[str] = field(default_factory=list)
    left_out: dict[str, set[int]] = field(default_factory=dict)

    def material(self, index: int | None, *, vertex_colours: bool) -> Material:
        """Return a primitive's material; without an index, the format's default.

        A colour is what a surface sends back of all light: a share of it answers to light from
        everywhere and the rest to lamps, so that white is just as bright as the brightest light.
        """
        given = self._record(index)
        record = given or MaterialRecord()
        surface = _base(record)
        red, green, blue, alpha = (min(max(one, 0.0), 1.0) for one in surface.base_color_factor)
        base = (red, green, blue)
        coordinates = self.coordinates(index)
        emission_texture = self._texture(record.emissive_texture, coordinates)
        emission_is_lost = record.emissive_texture is not None and emission_texture is None
        found = Material(
            name=record.name or ("default" if given is None else f"material {index}"),
            ambient=times(base, AMBIENT_PART),
            diffuse=times(base, 1.0 - AMBIENT_PART),
            emission=BLACK if emission_is_lost else _emission(record),
            opacity=1.0 if record.alpha_mode == "OPAQUE" else alpha,
            has_alpha=record.alpha_mode != "OPAQUE",
            alpha_cutoff=record.alpha_cutoff if record.alpha_mode == "MASK" else None,
            texture=self._texture(surface.base_color_texture, coordinates),
            emission_texture=emission_texture,
            normal_map=self._texture(record.normal_texture, coordinates),
            vertex_colours=vertex_colours,
            sides=Sides.BOTH if record.double_sided else Sides.FRONT,
        )
        if index is not None and given is not None:
            self._note(index, record, surface, coordinates)
        if record.extensions.unlit is None:
            return found
        return replace(found, diffuse=base, normal_map=None).without_light()

    def coordinates(self, index: int | None) -> int:
        """Find the set of texture coordinates that a material is read by: a mesh keeps one.

        It is that of the base colour, or of the first other image.
        """
        asked = _references(self._record(index) or MaterialRecord())
        return asked[0].coordinates if asked else 0

    def _record(self, index: int | None) -> MaterialRecord | None:
        if index is None:
            return None
        records = self.file.document.materials
        return self._entry("material", records, index, "A material is drawn as the default one")

    def _entry(
        self, kind: str, entries: Sequence[Entry | None], index: int, otherwise: str
    ) -> Entry | None:
        """Look up a part of a material; where that fails a remark tells what happens otherwise."""
        try:
            return self.file.entry(kind, entries, index)
        except IllegalValueError as error:
            self.damaged.append(f"{otherwise}: {error.parts[1]}.")
            return None

    @property
    def remarks(self) -> tuple[str, ...]:
        """Return a sentence for all that is not drawn, and one for images that are missing."""
        found = []
        if self.left_out:
            parts = (f"{what} ({len(of)})" for what, of in sorted(self.left_out.items()))
            found.append(f"Not drawn of the materials (and of how many): {', '.join(parts)}.")
        if self.missing:
            names = shortlist(dict.fromkeys(self.missing), MOST_NAMED)
            found.append(f"Images are missing: {names}.")
        return (*found, *dict.fromkeys(self.damaged))

    def _note(
        self, index: int, record: MaterialRecord, surface: MetallicRoughness, coordinates: int
    ) -> None:
        """Count what a picture lacks of a material."""
        is_unlit = record.extensions.unlit is not None
        glossy = record.extensions.specular_glossiness
        lacking = {
            "metallic and roughness": not is_unlit and surface.reflects and glossy is None,
            "specular and glossiness": not is_unlit and glossy is not None,
            "occlusion": record.occlusion_texture is not None and not is_unlit,
            "textures by another set of coordinates": any(
                one.coordinates != coordinates for one in _references(record)
            ),
            f"alpha mode {printable(record.alpha_mode)}": record.alpha_mode not in ALPHA_MODES,
        }
        for what, applies in lacking.items():
            if applies:
                self.left_out.setdefault(what, set()).add(index)

    def _texture(self, reference: TextureReference | None, coordinates: int) -> Texture | None:
        """Return a texture as its reference and its sampler place it, if its image is there.

        The file's v runs down and ours up: both the extension's turn and the place that it turns
        about are told in v upwards.
        """
        if reference is None or reference.coordinates != coordinates:
            return None
        document = self.file.document
        textures, samplers = document.textures, document.samplers
        record = self._entry("texture", textures, reference.index, "A texture is not drawn")
        image = None if record is None or record.image is None else self._image(record.image)
        if record is None or image is None:
            return None
        sampler = None
        if record.sampler is not None:
            default = "A texture is read as by default"
            sampler = self._entry("sampler", samplers, record.sampler, default)
        sampler = sampler or Sampler()
        given = reference.extensions.transform
        (right, down), (across, up) = given.offset, given.scale
        return Texture(
            image,
            (WRAPS.get(sampler.wrap_s, Wrap.REPEAT), WRAPS.get(sampler.wrap_t, Wrap.REPEAT)),
            (across, up),
            degrees(given.rotation),
            (right + up * sin(given.rotation), 1.0 - down - up * cos(given.rotation)),
            Filter.NEAREST if sampler.mag_filter == NEAREST else Filter.LINEAR,
            is_optional=True,
        )

    def _image(self, source: int) -> ImageSource | None:
        """Return an image, inside the file or beside it, if it is there."""
        document = self.file.document
        record = self._entry("image", document.images, source, "An image is not drawn")
        if record is None:
            return None
        uri = record.uri
        if uri is None or uri.startswith("data:"):
            name = f"{self.file.path} (image {source})"
            try:
                return EmbeddedImage(name, self.file.image(record))
            except IllegalValueError as error:
                self.damaged.append(f"An image is not drawn: image {source}: {error.parts[1]}.")
                return None
        name = unquote(uri)
        named = beside(self.file.path, name, allow_outside=self.file.allow_outside)
        path = existing_file(str(named))
        if path is None:
            self.missing.append(printable(name))
        return path


def _base(record: MaterialRecord) -> MetallicRoughness:
    """Find the base colour; without any, the diffuse part of the older model stands for it."""
    glossy = record.extensions.specular_glossiness
    if glossy is None:
        return record.pbr_metallic_roughness or MetallicRoughness()
    return MetallicRoughness(glossy.diffuse_factor, glossy.diffuse_texture)


def _references(record: MaterialRecord) -> list[TextureReference]:
    """List the textures that are drawn, the base colour's first."""
    asked = (_base(record).base_color_texture, record.emissive_texture, record.normal_texture)
    return [one for one in asked if one is not None]


def _emission(record: MaterialRecord) -> Colour:
    strength = max(record.extensions.emissive.emissive_strength, 0.0)
    red, green, blue = (max(one, 0.0) for one in record.emissive_factor)
    return times((red, green, blue), strength)
