"""MTL files: the materials that an OBJ file names, as far as they are drawn."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from nmatrix.enums import Reflection
from nmatrix.errors import IllegalValueError, printable, shortlist
from nmatrix.reading.files import existing_file
from nmatrix.scene.beside import asset_bytes, beside
from nmatrix.scene.material import AMBIENT_SHARE, BLACK, Colour, Material, Texture, grey, times
from nmatrix.scene.meshes.text import FIGURE, lines_of, readable
from nmatrix.scene.words import Wrap

MOST_NAMED = 4
UNLIT, MATT = "0", "1"  # of illum: the colour alone; no highlight
OPTIONS = {
    **dict.fromkeys(("-blendu", "-blendv", "-cc", "-clamp", "-imfchan", "-type"), 1),
    **dict.fromkeys(("-texres", "-bm", "-boost", "-colorspace"), 1),
    "-mm": 2,
}
_COMMENT = re.compile(r"\s+#(\s.*)?$")
PLACES = ("-o", "-s", "-t")  # one to three numbers follow
NOT_DRAWN = {
    "map_ka": "images of ambient light",
    "map_ks": "images of highlights",
    "map_ns": "images of shininess",
    "map_d": "images of opacity",
    "map_bump": "bumps",
    "bump": "bumps",
    "norm": "images of normals",
    "disp": "displacement",
    "map_disp": "displacement",
    "decal": "decals",
    "refl": "reflections",
    "tf": "transmission filters",
    "kt": "transmission filters",
    "pr": "roughness",
    "map_pr": "roughness",
    "pm": "metals",
    "map_pm": "metals",
    "ps": "sheen",
    "map_ps": "sheen",
    "pc": "clear coats",
    "pcr": "clear coats",
    "aniso": "anisotropy",
    "anisor": "anisotropy",
}
DULLEST = 1.0  # the least shininess; exporters write 0 where they know none
TRANSPARENT = ("4", "6", "7", "9")  # of illum: models of glass


@dataclass(frozen=True)
class _Line:
    """A line of a library, as it was written."""

    file: Path
    number: int
    text: str

    @property
    def value(self) -> str:
        """What stands behind the first word."""
        return self.text.partition(" ")[2].strip()

    def __str__(self) -> str:
        return f"{self.file.name}, line {self.number}"


@dataclass
class Materials:
    """The materials of an OBJ file by name; it collects what they could not bring along.

    `lines` are those of the OBJ file that name each material first.
    """

    path: Path
    lines: Mapping[str, int] = field(default_factory=dict)
    allow_outside: bool = False
    found: dict[str, Material] = field(default_factory=dict)
    missing: dict[str, str] = field(default_factory=dict)
    unknown: list[str] = field(default_factory=list)
    left_out: Counter[str] = field(default_factory=Counter)
    remarks_on_lines: list[str] = field(default_factory=list)

    def read(self, libraries: Mapping[str, int]) -> None:
        """Read the libraries that are there; one line may name several.

        Raises
        ------
        IllegalValueError
            For a name that leads out of the folder, unless that is allowed.
        """
        for named, number in libraries.items():
            line = f"{self.path.name}, line {number}"
            words = [named] if self._path(named, line) else _uncommented(named).split()
            for name in words:
                file = self._path(name, line)
                try:
                    content = None if file is None else asset_bytes(file)
                except IllegalValueError as error:
                    told = f"{printable(name)} ({line}) is not read: {error.parts[1]}."
                    self.remarks_on_lines.append(told)
                    continue
                if file is None or content is None:
                    self.missing.setdefault(name, line)
                else:
                    self._read(file, content)

    def material(self, name: str, *, vertex_colours: bool) -> Material | None:
        """Find a material by its name; faces without one are white where vertices have colours."""
        found = self.found.get(name) or self.found.get(_uncommented(name))
        if found is None:
            if name:
                line = self.lines.get(name)
                place = "" if line is None else f" ({self.path.name}, line {line})"
                self.unknown.append(f"{name}{place}")
            return coloured() if vertex_colours else None
        return replace(found, vertex_colours=vertex_colours)

    @property
    def remarks(self) -> tuple[str, ...]:
        """A sentence for each kind of thing that is missing or not drawn."""
        told = [*self.remarks_on_lines]
        if self.left_out:
            told.append(f"Not drawn of the materials: {', '.join(sorted(self.left_out))}.")
        if self.missing:
            missing = [f"{name} ({line})" for name, line in self.missing.items()]
            told.append(f"Files are missing: {_listed(missing)}.")
        if self.unknown:
            told.append(f"Materials are missing: {_listed(self.unknown)}.")
        return tuple(told)

    @property
    def counts(self) -> dict[str, int]:
        """How many materials have what is not drawn, and how many files and materials miss."""
        found = {f"material with {what}": count for what, count in sorted(self.left_out.items())}
        missing = {
            "missing file": len(set(self.missing)),
            "missing material": len(set(self.unknown)),
        }
        return found | {what: count for what, count in missing.items() if count}

    def _path(self, name: str, line: str) -> Path | None:
        """Find a file by the name on a line, with or without what may be a comment there."""
        meant = _uncommented(name)
        for one in dict.fromkeys((meant, name)):
            try:
                named = beside(self.path, one.replace("\\", "/"), allow_outside=self.allow_outside)
            except IllegalValueError as error:
                if one != meant:
                    continue  # what leads out is in the comment
                what, *why = error.parts
                raise IllegalValueError(f"{what} ({line})", *why) from None
            if found := existing_file(str(named)):
                return found
        return None

    def _read(self, file: Path, content: bytes) -> None:
        name: str | None = None
        values: dict[str, _Line] = {}
        for number, text in lines_of(content):
            line = _Line(file, number, readable(text).strip())
            word = line.text.partition(" ")[0].lower()
            if word == "newmtl":
                self._add(name, values)
                name, values = line.value, {}
            elif word and not word.startswith("#"):
                values[word] = line
        self._add(name, values)

    def _add(self, name: str | None, values: dict[str, _Line]) -> None:
        if name is None or name in self.found:
            return
        read = _Values(values, self.remarks_on_lines)
        illumination = values["illum"].value.split("#")[0].strip() if "illum" in values else ""
        texture = self._texture(values.get("map_kd"))
        diffuse = read.colour("kd", grey(0.8))
        if texture is not None and not any(diffuse):  # it would black out the image
            self.left_out.update(["a black Kd over an image, taken for white"])
            diffuse = grey(1.0)
        ambient = read.colour("ka", diffuse)
        if not any(ambient):  # exporters write 0 where they know none
            ambient = diffuse
        specular = read.colour("ks", BLACK)
        opacity = read.number("d", self._see_through(name, values, read))
        shininess = max(read.number("ns", Material.shininess), 0.0)
        shines = any(specular) and illumination not in (UNLIT, MATT)
        if shines and shininess < DULLEST:  # a highlight of the whole surface shows no shape
            self.left_out.update(["highlights of a shininess (Ns) below 1"])
            shines = False
        found = Material(
            name=name,
            ambient=times(ambient, AMBIENT_SHARE),
            diffuse=diffuse,
            specular=specular if shines else Material.specular,
            shininess=shininess if shines else Material.shininess,
            reflection=Reflection.BLINN_PHONG if shines else Reflection.LAMBERT,
            emission=read.colour("ke", BLACK),
            opacity=min(max(opacity, 0.0), 1.0),
            texture=texture,
            emission_texture=self._texture(values.get("map_ke")),
        )
        is_lit = illumination != UNLIT
        matt = replace(found, diffuse=times(diffuse, 1.0 - AMBIENT_SHARE))
        self.found[name] = matt if is_lit else found.without_light()
        self.found.setdefault(_uncommented(name), self.found[name])
        for word, what in NOT_DRAWN.items():
            self.left_out.update([what] if word in values else [])

    def _see_through(self, name: str, values: dict[str, _Line], read: _Values) -> float:
        """Return the opacity that `Tr` leaves; some programs write 1 for what hides all."""
        clear = read.number("tr", 0.0)
        illumination = values["illum"].value.split("#")[0].strip() if "illum" in values else ""
        if clear < 1.0 or "d" in values or illumination in TRANSPARENT:
            return 1.0 - clear
        told = f"{values['tr']} (Tr 1): material {printable(name)} would let all through"
        self.remarks_on_lines.append(f"{told}, and is drawn as hiding all, which some write so.")
        return 1.0

    def _texture(self, line: _Line | None) -> Texture | None:
        """Read an image with its options: `-s 2 2 -clamp on brick wall.png`."""
        if line is None or not line.value:
            return None
        words, wrap = line.value.split(), Wrap.REPEAT
        placed: dict[str, list[float]] = {}
        at = 0
        while at < len(words) - 1:
            option = words[at].lower()
            if option in PLACES:
                end = at + 1
                while end < min(len(words) - 1, at + 4) and _is_number(words[end]):
                    end += 1
                placed[option] = [float(word) for word in words[at + 1 : end]]
                at = end
            elif option in OPTIONS:
                if option == "-clamp" and words[at + 1].lower() == "on":
                    wrap = Wrap.CLAMP
                at += 1 + OPTIONS[option]
            else:
                break
        name = " ".join(words[at:])
        if at == 0:
            name = line.value
        file = self._path(name, f"{line}") if name else None
        if file is None:
            self.missing.setdefault(_uncommented(name), f"{line}")
            return None
        return Texture(
            file,
            (wrap, wrap),
            _two(placed.get("-s"), 1.0),
            offset=_two(placed.get("-o"), 0.0),
            is_optional=True,
        )


@dataclass(frozen=True)
class _Values:
    """The values of one material, word by word; what is no number is told and left as usual."""

    values: dict[str, _Line]
    remarks: list[str]

    def colour(self, word: str, usual: Colour) -> Colour:
        """Read three levels, or one for all, in [0, 1]."""
        if word not in self.values:
            return usual
        words = self.values[word].value.split("#")[0].split()
        if len(words) in (1, 2):
            words = words[:1] * 3
        if len(words) < 3 or not all(map(_is_number, words[:3])):
            self._tell(word, usual)
            return usual
        red, green, blue = (min(max(float(one), 0.0), 1.0) for one in words[:3])
        return red, green, blue

    def number(self, word: str, usual: float) -> float:
        """Read one number, the last: `d -halo 0.5` has a word before it."""
        if word not in self.values:
            return usual
        words = self.values[word].value.split("#")[0].split()
        if words and _is_number(words[-1]):
            return float(words[-1])
        self._tell(word, (usual,))
        return usual

    def _tell(self, word: str, usual: Sequence[float]) -> None:
        line, taken = self.values[word], " ".join(f"{one:g}" for one in usual)
        shown = printable(line.text[:40])
        self.remarks.append(f"{line} ({shown}): it was not understood; {taken} is taken.")


def coloured(name: str = "default") -> Material:
    """Make the material of a mesh that brings its own colours, or an image: white beneath them."""
    ambient, diffuse = grey(AMBIENT_SHARE), grey(1.0 - AMBIENT_SHARE)
    return Material(name, ambient=ambient, diffuse=diffuse, vertex_colours=True)


def _uncommented(name: str) -> str:
    """Cut a comment off a name; a # within a name has no blank behind it.

    Examples
    --------
    >>> _uncommented("x.mtl # old"), _uncommented("Material #25")
    ('x.mtl', 'Material #25')
    """
    return _COMMENT.sub("", name)


def _is_number(word: str) -> bool:
    return FIGURE.fullmatch(word.encode()) is not None


def _two(values: list[float] | None, usual: float) -> tuple[float, float]:
    """Take u and v of one to three numbers; v is usual where it is not given."""
    u, v = [*(values or []), usual, usual][:2] if values else (usual, usual)
    return u, v


def _listed(names: Iterable[str]) -> str:
    return shortlist((printable(one) for one in dict.fromkeys(names)), MOST_NAMED)
