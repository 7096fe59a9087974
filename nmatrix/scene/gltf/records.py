"""The parts of a glTF file that matter here, as typed records; msgspec checks their types."""

from __future__ import annotations

import msgspec

TRIANGLES, STRIP, FAN = 4, 5, 6  # modes of a primitive
POINTS, LINES, LINE_LOOP, LINE_STRIP = 0, 1, 2, 3


class NodeRecord(msgspec.Struct):
    """A node as the file has it."""

    name: str | None = None
    children: list[int] = []
    mesh: int | None = None
    camera: int | None = None
    matrix: list[float] | None = None
    translation: list[float] | None = None
    rotation: list[float] | None = None
    scale: list[float] | None = None
    skin: int | None = None
    weights: list[float] | None = None
    extensions: dict[str, object] = {}


class Primitive(msgspec.Struct):
    """A piece of a mesh: where its attributes and indices are."""

    attributes: dict[str, int] = {}
    indices: int | None = None
    mode: int = TRIANGLES
    material: int | None = None
    targets: list[dict[str, int]] = []
    extensions: dict[str, object] = {}

    @property
    def has_triangles(self) -> bool:
        """True for lists, strips and fans of triangles that have positions."""
        return self.mode in (TRIANGLES, STRIP, FAN) and "POSITION" in self.attributes


class MeshRecord(msgspec.Struct):
    """A mesh: its primitives, and how far each morph target is blended in."""

    primitives: list[Primitive] = []
    name: str | None = None
    weights: list[float] = []


class SparsePlace(msgspec.Struct, rename="camel"):
    """Where the numbers of a sparse accessor begin; indices have a component type of their own."""

    buffer_view: int
    byte_offset: int = 0
    component_type: int | None = None


class Sparse(msgspec.Struct):
    """The elements of an accessor that differ from the rest: how many, which, and what they are."""

    count: int
    indices: SparsePlace
    values: SparsePlace


class Accessor(msgspec.Struct, rename="camel"):
    """Numbers in a buffer view: their type, how many, where they begin."""

    component_type: int
    count: int
    type: str
    buffer_view: int | None = None
    byte_offset: int = 0
    normalized: bool = False
    sparse: Sparse | None = None
    min: list[float] | None = None
    max: list[float] | None = None


class BufferView(msgspec.Struct, rename="camel"):
    """A slice of a buffer."""

    buffer: int
    byte_length: int
    byte_offset: int = 0
    byte_stride: int | None = None
    extensions: dict[str, object] = {}


class Buffer(msgspec.Struct, rename="camel"):
    """A run of bytes, inside the file or beside it."""

    byte_length: int
    uri: str | None = None
    extensions: dict[str, object] = {}


class DracoRecord(msgspec.Struct, rename="camel"):
    """What of a primitive Draco packed: its bytes, and the number of each attribute in them."""

    buffer_view: int
    attributes: dict[str, int] = {}


class Instancing(msgspec.Struct):
    """The places of a mesh's instances, as accessors."""

    attributes: dict[str, int] = {}


class Skin(msgspec.Struct, rename="camel"):
    """The joints that carry a mesh, and the accessor of their inverse bind matrices."""

    joints: list[int]
    inverse_bind_matrices: int | None = None
    name: str | None = None


class AnimationSampler(msgspec.Struct):
    """The values of a channel over time, as accessors."""

    input: int
    output: int
    interpolation: str = "LINEAR"


class AnimationTarget(msgspec.Struct):
    """The node that an animation moves, and what of it."""

    path: str
    node: int | None = None


class AnimationChannel(msgspec.Struct):
    """What moves a node."""

    sampler: int
    target: AnimationTarget


class AnimationRecord(msgspec.Struct):
    """An animation: what moves what."""

    channels: list[AnimationChannel] = []
    samplers: list[AnimationSampler] = []


class Perspective(msgspec.Struct, rename="camel"):
    """A perspective camera; the angle is in radians."""

    yfov: float
    znear: float
    zfar: float | None = None
    aspect_ratio: float | None = None


class Orthographic(msgspec.Struct):
    """A parallel camera: half of its width and of its height."""

    xmag: float
    ymag: float
    zfar: float
    znear: float


class CameraRecord(msgspec.Struct):
    """A camera."""

    type: str
    perspective: Perspective | None = None
    orthographic: Orthographic | None = None


class TextureTransform(msgspec.Struct, rename="camel"):
    """Where coordinates fall on an image, by KHR_texture_transform; v runs down."""

    offset: tuple[float, float] = (0.0, 0.0)
    rotation: float = 0.0
    scale: tuple[float, float] = (1.0, 1.0)
    tex_coord: int | None = None


class TextureExtensions(msgspec.Struct):
    """The extension of references to textures that is read."""

    transform: TextureTransform = msgspec.field(
        default_factory=TextureTransform, name="KHR_texture_transform"
    )


class TextureReference(msgspec.Struct, rename="camel"):
    """A material's texture, the set of coordinates that it is read by, and where they fall."""

    index: int
    tex_coord: int = 0
    extensions: TextureExtensions = msgspec.field(default_factory=TextureExtensions)

    @property
    def coordinates(self) -> int:
        """The set of coordinates in the end: the extension may name another one."""
        own = self.extensions.transform.tex_coord
        return self.tex_coord if own is None else own


class MetallicRoughness(msgspec.Struct, rename="camel"):
    """The base colour of a material, and how it reflects."""

    base_color_factor: tuple[float, float, float, float] = (1.0, 1.0, 1.0, 1.0)
    base_color_texture: TextureReference | None = None
    metallic_factor: float = 1.0
    roughness_factor: float = 1.0
    metallic_roughness_texture: TextureReference | None = None

    @property
    def reflects(self) -> bool:
        """True if it does anything but scatter light evenly."""
        return self.metallic_factor > 0 or self.roughness_factor < 1


class SpecularGlossiness(msgspec.Struct, rename="camel"):
    """The diffuse part of a material by KHR_materials_pbrSpecularGlossiness."""

    diffuse_factor: tuple[float, float, float, float] = (1.0, 1.0, 1.0, 1.0)
    diffuse_texture: TextureReference | None = None


class EmissiveStrength(msgspec.Struct, rename="camel"):
    """How many times a material's emission is as strong."""

    emissive_strength: float = 1.0


class MaterialExtensions(msgspec.Struct):
    """The extensions of materials that are read."""

    unlit: object = msgspec.field(default=None, name="KHR_materials_unlit")
    emissive: EmissiveStrength = msgspec.field(
        default_factory=EmissiveStrength, name="KHR_materials_emissive_strength"
    )
    specular_glossiness: SpecularGlossiness | None = msgspec.field(
        default=None, name="KHR_materials_pbrSpecularGlossiness"
    )


class MaterialRecord(msgspec.Struct, rename="camel"):
    """A material as the file has it."""

    name: str | None = None
    pbr_metallic_roughness: MetallicRoughness | None = None
    normal_texture: TextureReference | None = None
    occlusion_texture: TextureReference | None = None
    emissive_texture: TextureReference | None = None
    emissive_factor: tuple[float, float, float] = (0.0, 0.0, 0.0)
    alpha_mode: str = "OPAQUE"
    alpha_cutoff: float = 0.5
    double_sided: bool = False
    extensions: MaterialExtensions = msgspec.field(default_factory=MaterialExtensions)


class OtherImage(msgspec.Struct):
    """The image of a texture in a format that the specification itself does not know."""

    source: int | None = None


class OtherImages(msgspec.Struct):
    """The images that a texture has in other formats."""

    basisu: OtherImage = msgspec.field(default_factory=OtherImage, name="KHR_texture_basisu")
    webp: OtherImage = msgspec.field(default_factory=OtherImage, name="EXT_texture_webp")
    avif: OtherImage = msgspec.field(default_factory=OtherImage, name="EXT_texture_avif")


class TextureRecord(msgspec.Struct):
    """A texture: its image, and how it is read."""

    source: int | None = None
    sampler: int | None = None
    extensions: OtherImages = msgspec.field(default_factory=OtherImages)

    @property
    def image(self) -> int | None:
        """The image in a format that every reader knows, else in another one."""
        other = self.extensions
        sources = (self.source, other.webp.source, other.avif.source, other.basisu.source)
        return next((one for one in sources if one is not None), None)


class Sampler(msgspec.Struct, rename="camel"):
    """How an image is read, in the numbers of OpenGL."""

    mag_filter: int | None = None
    wrap_s: int = 10497
    wrap_t: int = 10497


class ImageRecord(msgspec.Struct, rename="camel"):
    """An image, inside the file or beside it."""

    uri: str | None = None
    buffer_view: int | None = None


class SpotCone(msgspec.Struct, rename="camel"):
    """The half angles of a spot light, in radians."""

    inner_cone_angle: float = 0.0
    outer_cone_angle: float = 0.7853981633974483


class PunctualLight(msgspec.Struct):
    """A light of the extension KHR_lights_punctual."""

    type: str
    name: str | None = None
    color: tuple[float, float, float] = (1.0, 1.0, 1.0)
    intensity: float = 1.0
    range: float | None = None
    spot: SpotCone | None = None


class PunctualLights(msgspec.Struct):
    """The lights that nodes refer to, each to be read by itself."""

    lights: list[object] = []


class PunctualReference(msgspec.Struct):
    """The light that a node carries."""

    light: int


class SceneRecord(msgspec.Struct):
    """The roots of what is drawn."""

    nodes: list[int] = []


class Asset(msgspec.Struct, rename="camel"):
    """The version of glTF that a file is written in, and the least that its reader must know."""

    version: str
    min_version: str | None = None


class Document(msgspec.Struct, rename="camel"):
    """The parts of a glTF file that matter here.

    A list that may hold None has it where a record cannot be read: that costs the record alone.
    """

    asset: Asset
    nodes: list[NodeRecord] = []
    meshes: list[MeshRecord] = []
    accessors: list[Accessor] = []
    buffer_views: list[BufferView] = []
    buffers: list[Buffer] = []
    scene: int | None = None
    scenes: list[SceneRecord] = []
    cameras: list[CameraRecord | None] = []
    materials: list[MaterialRecord | None] = []
    textures: list[TextureRecord | None] = []
    samplers: list[Sampler | None] = []
    images: list[ImageRecord | None] = []
    skins: list[Skin | None] = []
    animations: list[AnimationRecord | None] = []
    extensions: dict[str, object] = {}
    extensions_used: list[str] = []
    extensions_required: list[str] = []
