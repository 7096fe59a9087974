"""The record of an effect: when a scene calls for it, what it reads and costs, what it can change.

Whatever a record does not say is taken for the worst: then the plan computes more, and stays right.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import inf
from typing import TYPE_CHECKING

from nmatrix.enums import Effect, LeftOut
from nmatrix.shaders.glsl import NOTHING, Glsl
from nmatrix.shaders.shaded import Shaded

if TYPE_CHECKING:
    from nmatrix.raster.loaded_scene import LoadedScene
    from nmatrix.raster.planning.facts import Facts
    from nmatrix.raster.planning.seen_body import SeenBody
    from nmatrix.scene.light import PlacedLight

BUDGET = 0.5 / 255  # that all that is left out of one object may move a channel by, together
ROUNDING = 1e-12


@dataclass(frozen=True)
class Decision:
    """The decision on an effect: on or off, why, and the most that leaving it out moves a channel.

    `is_asked` tells whether the scene asks for the effect at all. What is asked for counts in the
    bounds of other effects, even where it adds nothing. `is_possible` is False where what it reads
    is missing: then everything-on does without it too.
    """

    on: bool
    because: str
    kind: LeftOut = LeftOut.EXACT
    bound: float = 0.0
    is_asked: bool = True
    is_possible: bool = True


def called_for(because: str) -> Decision:
    """Turn an effect on."""
    return Decision(on=True, because=because)


def not_asked(because: str) -> Decision:
    """Leave out what the scene does not ask for."""
    return Decision(on=False, because=because, is_asked=False)


def adds_nothing(because: str) -> Decision:
    """Leave out what is asked for, and changes no bit here."""
    return Decision(on=False, because=because)


def impossible(because: str) -> Decision:
    """Leave out what is asked for in vain: what it reads is missing."""
    return Decision(on=False, because=because, is_possible=False)


def by_bound(bound: float, because: str) -> Decision:
    """Leave out what moves channels by rounding; propose to leave out what the budget can pay."""
    if bound <= ROUNDING:
        return Decision(on=False, because=because, kind=LeftOut.ROUNDING, bound=bound)
    if bound <= BUDGET:
        return Decision(on=False, because=because, kind=LeftOut.BOUNDED, bound=bound)
    return called_for(because if bound == inf else too_dear(because, bound))


def too_dear(because: str, bound: float) -> str:
    """Add to a reason what leaving the effect out could cost."""
    return f"{because}; it could move a channel by {bound * 255:.2g} of 255 levels"


@dataclass(frozen=True)
class Strength:
    """What an effect makes of a lamp's light: at most so many times as much, and its slope.

    `per_unit` is the most that this factor changes for a place that moves by one unit.
    """

    most: float = inf
    per_unit: float = inf


@dataclass(frozen=True)
class Influence:
    """The dependence of colours on normals and places by an effect; a field unsaid is at its worst.

    Parameters
    ----------
    most
        The most light that it adds to a channel.
    per_radian
        The most that a channel of linear light moves for a normal that turns by one radian.
    per_length
        The most that it moves for a normal that gets shorter, for each part of its length.
    per_unit
        The most that it moves for a fragment that moves by one unit of the world, or by as much as
        an attribute can differ; how lamps weaken on the way and turn, apart.
    gain
        How many times more the channel moves at the end than other effects have moved it.
    follows_lights
        The first three are for lights of brightness 1, and grow with their brightness; a light
        that turns counts like a normal that turns.
    jumps
        Colours jump where a normal passes an edge; no slope bounds that.
    strength
        What it makes of each lamp's light on its way.
    lights_backs
        Light from behind a surface changes it.
    brings_colour
        It can have a hue that neither the background nor lights nor the material's colours have.
    because
        The reason to renormalise where `per_length` is infinite.
    """

    most: float = inf
    per_radian: float = inf
    per_length: float = inf
    per_unit: float = inf
    gain: float = inf
    follows_lights: bool = False
    jumps: bool = True
    strength: Callable[[SeenBody, PlacedLight], Strength] = lambda _, __: Strength()
    lights_backs: bool = True
    brings_colour: bool = True
    because: str = "what shorter normals change is not known"


UNCHANGED = Strength(most=1.0, per_unit=0.0)

STEADY = Influence(
    most=0.0,
    per_radian=0.0,
    per_length=0.0,
    per_unit=0.0,
    gain=1.0,
    jumps=False,
    strength=lambda _, __: UNCHANGED,
    lights_backs=False,
    brings_colour=False,
)


@dataclass(frozen=True)
class Recipe:
    """Everything that is known of an effect.

    Parameters
    ----------
    says
        The effect in words.
    judge
        Decides for one body; None for what is on where others need it.
    picture_judge
        Decides for the whole picture, in place of `judge`.
    influence
        How colours depend on normals and places through it.
    attributes, passes
        Its inputs by name, and the passes over the picture that it takes.
    settings
        The fields of a material that it alone reads: where it is left out, they change nothing.
    needs
        The effects whose results it reads.
    per_vertex, per_sample, per_light
        Multiplications: mat4·vec4 16, mat3·vec3 9, dot 3, normalise 6, division and square root 1,
        at each vertex, at each sample, and for each light at each sample.
    is_shortcut
        Everything-on computes it even where the scene does not call for it.
    only_at_fragments
        Shading that evaluates light at vertices does without it.
    glsl
        Its lines in shaders, and the uniforms that these read.
    """

    says: str
    judge: Callable[[Facts], Decision] | None = None
    picture_judge: Callable[[LoadedScene, Sequence[Facts]], Decision] | None = None
    influence: Influence | Callable[[Facts], Influence] = Influence()
    attributes: tuple[str, ...] = ()
    passes: tuple[str, ...] = ()
    settings: tuple[str, ...] = ()
    needs: tuple[Effect, ...] = ()
    per_vertex: int = 0
    per_sample: int = 0
    per_light: int = 0
    is_shortcut: bool = False
    only_at_fragments: bool = False
    glsl: Glsl | Callable[[Shaded], Glsl] = NOTHING

    def decision(self, facts: Facts) -> Decision:
        """Decide for one body, or for the picture with that one body in it."""
        if self.picture_judge is not None:
            return self.picture_judge(facts.loaded, (facts,))
        return self.judge(facts) if self.judge is not None else called_for("others need it")

    @property
    def has_lines(self) -> bool:
        """Return True if shaders hold lines of it."""
        return self.glsl is not NOTHING

    def lines(self, shaded: Shaded) -> Glsl:
        """Return the lines of GLSL for one object."""
        return self.glsl if isinstance(self.glsl, Glsl) else self.glsl(shaded)
