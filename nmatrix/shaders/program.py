"""The one generator of GLSL: it puts the lines of effects in order and declares what they read.

A name is declared where a line reads it and nowhere else, and lines that make what nobody reads
are left out. So what is printed compiles, and each uniform that it declares has a value.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from nmatrix.enums import NormalRule, Shading, Space
from nmatrix.linear import rational
from nmatrix.linear.exact import LinearMap
from nmatrix.linear.projection import ClipSpace
from nmatrix.report import Value
from nmatrix.scene.light import PlacedLight
from nmatrix.shaders.glsl import RENORMALISE, SAFE_UNIT_NORMAL, Glsl, Sampler, Uniform
from nmatrix.shaders.shaded import PLAIN_TARGET, CullFace, FrontFace, Shaded
from nmatrix.spaces.shading_spaces import PROFILES

HEADER = ("#version 300 es", "precision highp float;")
IN_RIGID_SPACES = {
    "vector_length": "length",
    "unit_vector": "normalize",
    "vector_dot": "dot",
    "unit_normal": "normalize",
}
ATTRIBUTES = {
    "vertex_position": "vec3",
    "vertex_normal": "vec3",
    "face_position": "vec3",
    "face_normal": "vec3",
    "hull_normal": "vec3",
    "vertex_uv": "vec2",
    "vertex_colour": "vec3",
    "vertex_alpha": "float",
    "vertex_tangent": "vec4",
}
SUMS = ("matte", "gloss")  # light that takes a texture's colour, and light that does not
SIDES = ("front", "back")
OF_SIDES = tuple(f"{one}_{side}" for side in SIDES for one in SUMS)

_WORD = re.compile(r"[A-Za-z_]\w*")
_ASSIGNED = re.compile(r"(?:if \([^()]*\)\s+)?(?:(?:float|vec[234]) )?(\w+) [-+*/]?= ")


@dataclass(frozen=True)
class Program:
    """A pair of shaders, with a value for every uniform and what to bind to every sampler."""

    vertex_shader: str
    fragment_shader: str
    uniforms: tuple[Uniform, ...]
    samplers: tuple[Sampler, ...]
    front_face: FrontFace
    cull_face: CullFace | None
    target: str
    clip: ClipSpace

    def reads(self, name: str) -> bool:
        """Return True if a uniform has the name."""
        return any(one.name == name for one in self.uniforms)

    @property
    def data(self) -> dict[str, Value]:
        """The program under the keys of the command-line contract."""
        return {
            "vertex_shader": self.vertex_shader,
            "fragment_shader": self.fragment_shader,
            "uniforms": {one.key: one.value for one in self.uniforms},
            "samplers": {one.name: one.bind for one in self.samplers},
            "front_face": self.front_face.value,
            "cull_face": self.cull_face and self.cull_face.value,
            "target": self.target,
            "depth_range": self.clip.depth.value,
            "clip_y": self.clip.clip_y.value,
        }


def program(shaded: Shaded, terms: Iterable[Glsl]) -> Program:
    """Write the two shaders that draw one object with the lines of its effects.

    Parameters
    ----------
    shaded
        The object in its space, and its lights.
    terms
        The lines of the effects that are computed, in the order of their table.
    """
    return _Assembly(shaded, tuple(terms)).program()


@dataclass(frozen=True)
class _Assembly:
    """The lines of both shaders, before and after what they read is declared."""

    shaded: Shaded
    terms: tuple[Glsl, ...]

    def program(self) -> Program:
        fragment = self._written(self._fragment(), ("fragment_color",))
        varyings = [name for name in self._varyings if name in _words(fragment)]
        vertex = self._written(self._vertex(varyings), ("gl_Position", *varyings))
        read = _words([*vertex, *fragment, *self._called([*vertex, *fragment])])
        return Program(
            self._text("vertex", self._passed("out", varyings), vertex),
            self._text(
                "fragment",
                [*self._passed("in", varyings), "out vec4 fragment_color;"],
                fragment,
            ),
            tuple(one for one in self._uniforms if one.name in read),
            tuple(one for one in self._samplers if one.name in read),
            self.shaded.front_face,
            self.shaded.cull_face,
            self.shaded.target,
            self.shaded.clip,
        )

    def _passed(self, way: str, varyings: Iterable[str]) -> list[str]:
        """Declare what goes from the vertices to the fragments."""
        flat = "flat " if self.shaded.shading is Shading.FLAT else ""
        return [
            f"{flat if name in OF_SIDES else ''}{way} {self._varyings[name][0]} {name};"
            for name in varyings
        ]

    def _text(self, stage: str, passed: Sequence[str], lines: Sequence[str]) -> str:
        """Write a shader: what its lines read, what it passes on, its functions and its main."""
        functions = self._called(lines)
        read = _words([*lines, *functions])
        return "\n".join(
            (
                *HEADER,
                f"// {stage} shader, {self.shaded.space} space",
                *self._notes(stage),
                *_declared(one for one in self._uniforms if one.name in read),
                *_declared(one for one in self._samplers if one.name in read),
                *(self._attribute(name) for name in ATTRIBUTES if name in read),
                *passed,
                *functions,
                "void main() {",
                *(f"    {part}" for line in lines for part in line.split("\n")),
                "}",
                "",
            )
        )

    def _attribute(self, name: str) -> str:
        declared = f"in {ATTRIBUTES[name]} {name};"
        if not name.endswith(("position", "normal")):
            return declared
        space = PROFILES[self.shaded.space].mesh_space
        if name == "hull_normal":
            space = Space.WORLD
        return f"{declared}  // {space} space{_length_of(name)}"

    def _notes(self, stage: str) -> Iterator[str]:
        """Yield what a stage relies on and cannot say in its lines."""
        if stage == "vertex" and self.shaded.front_face is FrontFace.CW:
            yield "// front faces run clockwise here: glFrontFace(GL_CW)"
        if stage == "fragment" and self.shaded.target != PLAIN_TARGET:
            yield f"// linear light, to be mixed before it becomes sRGB: {self.shaded.target}"

    # --- the vertex shader

    def _vertex(self, varyings: Sequence[str]) -> Iterator[str]:
        clip = "clip_from_object * vec4(vertex_position, 1.0)"
        if self.shaded.swollen_by:
            yield "vec3 step_world = outline_width * hull_normal;"
            yield f"vec3 p = {self._position('vertex')} + vector_space_from_world * step_world;"
            clip += "\n    + clip_from_world * vec4(step_world, 0.0)"
        else:
            yield from self._lit_vertex()
        yield from (f"{one} = {self._varyings[one][1]};" for one in varyings if one not in OF_SIDES)
        yield f"gl_Position = {clip};"

    def _lit_vertex(self) -> Iterator[str]:
        of = "face" if self.shaded.shading is Shading.FLAT else "vertex"
        sided = self._lit_at_vertices and self.shaded.is_sided
        yield f"vec3 p = {self._position(of)};"
        yield from self._normal(of, "outward" if sided else "n")
        if sided:
            yield "for (int side = 0; side < 2; side++) {  // front, back"
            yield from _indented(
                ("vec3 n = side == 0 ? outward : -outward;", *self._light(), *self._kept_by_side())
            )
            yield "}"
        elif self._lit_at_vertices:
            yield from self._light()
            yield from (f"{one}_front = {one};" for one in self._sums)

    def _kept_by_side(self) -> Iterator[str]:
        for begin, side in zip(("if (side == 0)", "else"), SIDES, strict=True):
            kept = " ".join(f"{one}_{side} = {one};" for one in self._sums)
            yield f"{begin} {{ {kept} }}"

    def _position(self, of: str) -> str:
        if not self.shaded.moves_vertices:
            return f"{of}_position"
        return f"(space_from_object * vec4({of}_position, 1.0)).xyz"

    def _normal(self, of: str, name: str) -> Iterator[str]:
        """Yield the lines that bring a normal into the space, at true length one."""
        found, given = self.shaded.normal_transform, f"{of}_normal"
        if not self.shaded.moves_vertices:
            own_length = found is not None and found.components == 4
            measured = "unit_normal" in self._functions and not own_length
            yield f"vec3 {name} = {f'unit_normal({given})' if measured else given};"
        elif found is None:
            yield f"vec3 {name} = vec3(0.0);  // {self._rule}: it has no answer here"
        elif found.components == 4:
            yield f"// {self._rule}"
            yield f"vec4 carried = normal_matrix * vec4({given}, {float(found.w)});"
            yield f"vec3 {name} = carried.xyz / length(carried);"
        elif found.w:
            carried = f"(normal_matrix * vec4({given}, {float(found.w)})).xyz"
            yield f"vec3 {name} = unit_normal({carried});  // {self._rule}"
        else:
            yield f"vec3 {name} = unit_normal(normal_matrix * {given});  // {self._rule}"
        if self.shaded.is_flattened:
            yield f"if (dot({name}, eye - p) < 0.0) {name} = -{name};  // its sides are alike"

    @property
    def _rule(self) -> str:
        """The rule that carries normals, in words."""
        rule = self.shaded.rule
        if rule is NormalRule.NONE:
            return "A itself"
        if rule is not NormalRule.EXACT:
            return f"the rule {rule}"
        exists = LinearMap.of(rational.linear_part(self.shaded.space_from_vertex)).determinant_sign
        return "the inverse transpose" if exists else "the cofactors: no inverse exists"

    # --- the fragment shader

    def _fragment(self) -> Iterator[str]:
        yield "vec3 p = fragment_position;"
        is_long_enough = not self._lit_at_vertices and RENORMALISE not in self.terms
        told = "  // of unit length, as near as can be seen" if is_long_enough else ""
        yield f"vec3 n = fragment_normal;{told}"
        if self._lit_at_vertices:
            yield from (f"vec3 {one} = {self._of_side(one)};" for one in self._sums)
        else:
            yield from self._lines("bump")
            yield from self._lines("normal")
            yield from self._light()
        yield from self._lines("matte")
        yield f"vec3 color = min({' + '.join(self._sums)}, 1.0);"
        yield from self._lines("color")
        yield "fragment_color = vec4(color, 1.0);"
        yield from self._lines("last")

    def _of_side(self, name: str) -> str:
        if not self.shaded.is_sided:
            return f"{name}_front"
        return f"gl_FrontFacing ? {name}_front : {name}_back"

    # --- the light, at vertices or at fragments

    def _light(self) -> Iterator[str]:
        yield from (f"vec3 {one} = vec3(0.0);" for one in self._sums)
        yield from self._lines("base")
        yield "vec3 v = unit_vector(eye - p);"
        for i, placed in enumerate(self.shaded.lights):
            yield f"{{  // {placed.light.kind} light"
            yield from _indented(self._of_light(i, placed))
            yield "}"

    def _of_light(self, i: int, placed: PlacedLight) -> Iterator[str]:
        own = self._of_lights[i]
        to_light = "-light_direction"
        if placed.position is not None:
            to_light = "unit_vector(light_position - p)"
        lines = (
            f"vec3 l = {to_light};",
            "vec3 light = light_color;",
            "float n_dot_l = dot(n, l);",
            "float shade = max(n_dot_l, 0.0);",
            *(line for one in (*self.terms, own) for line in one.arriving),
            *(line for one in self.terms for line in one.lit),
        )
        names = [one.name for one in own.uniforms] + [one.name for one in own.samplers]
        numbered = {name: self._numbered(name, i) for name in names}
        yield from (_renamed(line, numbered) for line in lines)

    def _numbered(self, name: str, i: int) -> str:
        """Add a light's number to the name of its uniform, where there are several lights."""
        return name if len(self.shaded.lights) == 1 else f"{name}_{i}"

    @property
    def _lit_at_vertices(self) -> bool:
        return self.shaded.shading is not Shading.PHONG

    @cached_property
    def _sums(self) -> tuple[str, ...]:
        """The sums of light that some line adds to."""
        lit = [line for one in self.terms for line in one.lit if self.shaded.lights]
        return SUMS if "gloss" in _words(lit) else SUMS[:1]

    # --- what lines read

    def _lines(self, place: str) -> Iterator[str]:
        yield from (line for one in self.terms for line in getattr(one, place))

    def _written(self, lines: Iterable[str], outputs: Iterable[str]) -> list[str]:
        """Keep the lines that make the outputs, in GLSL's own words where no function measures."""
        own = {word: one for word, one in IN_RIGID_SPACES.items() if word not in self._functions}
        return _without_unread([_renamed(line, own) for line in lines], outputs)

    @cached_property
    def _functions(self) -> dict[str, str]:
        found = [SAFE_UNIT_NORMAL] if self.shaded.normals_can_vanish else []
        found += [one for term in self.terms for one in term.functions]
        return {_function_name(one): one for one in found}

    def _called(self, lines: Iterable[str]) -> list[str]:
        """List the functions that lines call, and those that these call."""
        read, size = _words(lines), -1
        while size != len(read):
            size = len(read)
            read |= _words(text for name, text in self._functions.items() if name in read)
        return [text for name, text in self._functions.items() if name in read]

    @cached_property
    def _uniforms(self) -> tuple[Uniform, ...]:
        """Everything that lines may read, with its value."""
        shaded = self.shaded
        return (
            Uniform("mat4", "clip_from_object", shaded.clip_from_vertex),
            Uniform("mat4", "space_from_object", shaded.space_from_vertex),
            *self._normal_matrix(),
            *self._of_hull(),
            Uniform("vec3", "eye", shaded.maps.eye_in(shaded.space)),
            *(uniform for one in self.terms for uniform in one.uniforms),
            *(
                replace(uniform, name=self._numbered(uniform.name, i))
                for i, one in enumerate(self._of_lights)
                for uniform in one.uniforms
            ),
        )

    def _normal_matrix(self) -> Iterator[Uniform]:
        found = self.shaded.normal_transform
        if found is None:
            return
        if found.w or found.components == 4:
            yield Uniform("mat4", "normal_matrix", found.matrix)
            return
        of_space = LinearMap.of(rational.linear_part(self.shaded.space_from_vertex))
        inverse_transpose = None
        if self.shaded.rule is NormalRule.EXACT:
            inverse_transpose = of_space.normal_matrix
        yield Uniform(
            "mat3", "normal_matrix", inverse_transpose or rational.linear_part(found.matrix)
        )

    def _of_hull(self) -> Iterator[Uniform]:
        shaded = self.shaded
        if shaded.swollen_by:
            to_space = shaded.maps.space_from_world(shaded.space).exact
            yield Uniform("mat4", "clip_from_world", shaded.clip_from_world)
            yield Uniform("mat3", "vector_space_from_world", rational.linear_part(to_space))
            yield Uniform("float", "outline_width", shaded.swollen_by)

    @cached_property
    def _of_lights(self) -> tuple[Glsl, ...]:
        """For each light what it has of its own, under names without its number."""
        return tuple(map(self._of_one, self.shaded.lights))

    def _of_one(self, placed: PlacedLight) -> Glsl:
        uniforms = [Uniform("vec3", "light_color", placed.colour)]
        if placed.position is not None:
            uniforms.append(Uniform("vec3", "light_position", self.shaded.point(placed.position)))
        if placed.direction is not None:
            direction = self.shaded.direction(placed.direction)
            uniforms.append(Uniform("vec3", "light_direction", direction))
        own = [one.of_light(placed) for one in self.terms if one.of_light is not None]
        return Glsl(
            (*uniforms, *(uniform for one in own for uniform in one.uniforms)),
            tuple(sampler for one in own for sampler in one.samplers),
            arriving=tuple(line for one in own for line in one.arriving),
        )

    @cached_property
    def _samplers(self) -> tuple[Sampler, ...]:
        return (
            *(sampler for one in self.terms for sampler in one.samplers),
            *(
                replace(sampler, name=self._numbered(sampler.name, i))
                for i, one in enumerate(self._of_lights)
                for sampler in one.samplers
            ),
        )

    @cached_property
    def _varyings(self) -> dict[str, tuple[str, str]]:
        """What the vertex shader can hand on: types, and what stands for it there."""
        of_tangent = "mat3(space_from_object) * " if self.shaded.moves_vertices else ""
        at_vertex = self._position("vertex") if self.shaded.shading is Shading.FLAT else "p"
        return {
            **dict.fromkeys(OF_SIDES, ("vec3", "")),
            "fragment_normal": ("vec3", "n"),
            "fragment_position": ("vec3", at_vertex),
            "fragment_uv": ("vec2", "vertex_uv"),
            "fragment_colour": ("vec3", "vertex_colour"),
            "fragment_alpha": ("float", "vertex_alpha"),
            "fragment_tangent": (
                "vec4",
                f"vec4({of_tangent}vertex_tangent.xyz, vertex_tangent.w)",
            ),
        }


def _declared(inputs: Iterable[Uniform | Sampler]) -> Iterator[str]:
    """Declare uniforms and samplers, an array once for all of its elements."""
    sizes: dict[str, int] = {}
    for one in inputs:
        element = getattr(one, "element", None)
        sizes[f"{one.kind} {one.name}"] = 0 if element is None else element + 1
    for name, size in sizes.items():
        yield f"uniform {name}{f'[{size}]' if size else ''};"


def _words(lines: Iterable[str]) -> set[str]:
    """Collect the words of some lines, comments aside."""
    return {word for line in lines for word in _WORD.findall(re.sub(r"//.*", "", line))}


def _renamed(line: str, names: Mapping[str, str]) -> str:
    return _WORD.sub(lambda found: names.get(found[0], found[0]), line)


def _without_unread(lines: Sequence[str], outputs: Iterable[str]) -> list[str]:
    """Drop lines that assign to what neither a later line nor the next stage reads."""
    read, kept = set(outputs), []
    for line in reversed(lines):
        assigned = _ASSIGNED.match(line.lstrip())
        if assigned is None or assigned[1] in read:
            kept.append(line)
            read |= _words([line])
    return kept[::-1]


def _indented(lines: Iterable[str]) -> Iterator[str]:
    yield from ("    " + line.replace("\n", "\n    ") for line in lines)


def _function_name(text: str) -> str:
    return text.split("(", 1)[0].split()[-1]


def _length_of(name: str) -> str:
    return ", unit length" if name.endswith("normal") else ""
