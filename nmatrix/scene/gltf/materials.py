"""The materials of a glTF file as far as they are drawn, and a remark for what is not."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import cos, degrees, sin
from urllib.parse import unquote

from nmatrix.errors import printable, shortlist
from nmatrix.reading.files import existing_file
from nmatrix.scene.beside import beside
from nmatrix.scene.gltf.file import GltfFile
from nmatrix.scene.gltf.records import MaterialRecord, MetallicRoughness, Sampler, TextureReference
from nmatrix.scene.material import AMBIENT_SHARE, EmbeddedImage, ImageSource, Material, Texture
from nmatrix.scene.words import Sides, Wrap

MOST_NAMED = 4  # files that a remark names
NEAREST = 9728
WRAPS = {10497: Wrap.REPEAT, 33071: Wrap.CLAMP, 33648: Wrap.MIRROR}


@dataclass
class Materials:
    """The materials of one file; it collects what they could not bring along."""

    file: GltfFile
    missing: list[str] = field(default_factory=list)
    left_out: set[str] = field(default_factory=set)

    def material(self, index: int | None, *, vertex_colours: bool) -> Material:
        """Return a primitive's material; without an index, the format's default.

        Raises
        ------
        IllegalValueError
            For a material, a texture or an image that does not exist.
        """
        records = self.file.document.materials
        record = MaterialRecord() if index is None else self.file.entry("material", records, index)
        surface = record.pbr_metallic_roughness or MetallicRoughness()
        red, green, blue, alpha = (min(max(one, 0.0), 1.0) for one in surface.base_color_factor)
        if index is not None:
            self._note(record, surface)
        return Material(
            name=record.name or ("default" if index is None else f"material {index}"),
            ambient=(AMBIENT_SHARE * red, AMBIENT_SHARE * green, AMBIENT_SHARE * blue),
            diffuse=(red, green, blue),
            opacity=alpha if record.alpha_mode == "BLEND" else 1.0,
            texture=self._texture(surface.base_color_texture),
            normal_map=self._texture(record.normal_texture),
            vertex_colours=vertex_colours,
            sides=Sides.BOTH if record.double_sided else Sides.FRONT,
        )

    @property
    def remarks(self) -> tuple[str, ...]:
        """Return a sentence for all that is not drawn, and one for images that are missing."""
        found = []
        if self.left_out:
            found.append(f"Not drawn of the materials: {', '.join(sorted(self.left_out))}.")
        if self.missing:
            names = shortlist(dict.fromkeys(self.missing), MOST_NAMED)
            found.append(f"Images are missing: {names}.")
        return tuple(found)

    def _note(self, record: MaterialRecord, surface: MetallicRoughness) -> None:
        self.left_out |= {"metallic and roughness"}
        if record.occlusion_texture is not None:
            self.left_out.add("occlusion")
        if record.emissive_texture is not None or any(record.emissive_factor):
            self.left_out.add("emission")
        if record.alpha_mode == "MASK":
            self.left_out.add("alpha cut-outs")
        for one in (surface.base_color_texture, record.normal_texture):
            if one is not None and one.coordinates != 0:
                self.left_out.add("textures by a second set of coordinates")

    def _texture(self, reference: TextureReference | None) -> Texture | None:
        """Return a texture as its reference and its sampler place it, if its image is there.

        The file's v runs down and ours up: both the extension's turn and the place that it turns
        about are told in v upwards.
        """
        if reference is None or reference.coordinates != 0:
            return None
        document = self.file.document
        record = self.file.entry("texture", document.textures, reference.index)
        image = None if record.source is None else self._image(record.source)
        if image is None:
            return None
        sampler = Sampler()
        if record.sampler is not None:
            sampler = self.file.entry("sampler", document.samplers, record.sampler)
        if sampler.mag_filter == NEAREST:
            self.left_out.add("filters that take the nearest texel")
        given = reference.extensions.transform
        (right, down), (across, up) = given.offset, given.scale
        return Texture(
            image,
            (WRAPS.get(sampler.wrap_s, Wrap.REPEAT), WRAPS.get(sampler.wrap_t, Wrap.REPEAT)),
            (across, up),
            degrees(given.rotation),
            (right + up * sin(given.rotation), 1.0 - down - up * cos(given.rotation)),
        )

    def _image(self, source: int) -> ImageSource | None:
        """Return an image, inside the file or beside it, if it is there."""
        document = self.file.document
        record = self.file.entry("image", document.images, source)
        uri = record.uri
        if uri is None or uri.startswith("data:"):
            name = f"{self.file.path} (image {source})"
            return EmbeddedImage(name, self.file.image(record))
        name = unquote(uri)
        named = beside(self.file.path, name, allow_outside=self.file.allow_outside)
        path = existing_file(str(named))
        if path is None:
            self.missing.append(printable(name))
        return path
