"""A scene's picture: the plan turned into drawables, drawn, and counted."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import Effect
from nmatrix.errors import printable, shortlist
from nmatrix.raster.loaded_scene import LoadedScene
from nmatrix.raster.planning.effects import per_sample, per_vertex
from nmatrix.raster.planning.plan import BodyPlan, Plan
from nmatrix.raster.planning.seen_body import SeenBody
from nmatrix.raster.shading.lighting import Lighting, ShadingLight, colour
from nmatrix.raster.shading.opacity import clear, opacity_inputs, solid
from nmatrix.raster.shading.outline import OF_HULLS, hull
from nmatrix.raster.shading.shadow import Occluded, ShadowMap, shadow_map
from nmatrix.raster.shading.space import ShadingSpace, as_array
from nmatrix.raster.shading.surface import PictureStyle, Surface
from nmatrix.raster.shading.texture import from_srgb, to_srgb
from nmatrix.raster.triangles.fragments import Fragments
from nmatrix.raster.triangles.picture import DepthMap, Drawable, Drawing, Picture
from nmatrix.raster.triangles.vertices import project
from nmatrix.scene.light import PlacedLight
from nmatrix.scene.words import LightKind

Array = NDArray[Any]
BLACK = 0.5 / 255 / 12.92  # no level of sRGB is reached by less light
ITS, THEIR = "its", "their"
MOST_REASONS, MOST_NAMED = 2, 4  # that a remark names
EVERY = 8  # of the points that are asked whether they are like the background
APART = 20 / 255  # of two levels that are told apart in a lit room
MOSTLY = 0.75  # of what is seen: a body that is lit from one side has a dark half

Change = Callable[[Surface], Surface]


@dataclass(frozen=True)
class Work:
    """The work of a picture, counted: the same on every machine."""

    vertices: int
    triangles: int
    fragments: int
    shaded_samples: int
    passes: int
    multiplications: int


@dataclass(frozen=True, eq=False)
class Rendered:
    """An image (height, width, 1 or 3) of levels in [0, 1], and the work that it took.

    `shaded` are the samples of each body that was drawn, of outlines last, and stand for `seen`
    samples of it. `remarks` tell of bodies that came out black although light was meant for them;
    `depth` is there where it was asked for. `faint` is the part of what was coloured that can
    hardly be told from the background, where that was to be chosen.
    """

    image: Array
    work: Work
    shaded: tuple[int, ...] = ()
    remarks: tuple[str, ...] = ()
    depth: DepthMap | None = None
    seen: tuple[int, ...] = ()
    faint: float = 0.0

    @property
    def rgb(self) -> Array:
        """Return the image with three channels."""
        return np.broadcast_to(self.image, (*self.image.shape[:2], 3))


def _as_it_is(surface: Surface) -> Surface:
    return surface


def render(
    plan: Plan,
    finish: Callable[[Array], Array] = np.asarray,
    change: Change = _as_it_is,
    *,
    keeps_depth: bool = False,
) -> Rendered:
    """Draw a plan's loaded scene; `finish` turns rows of levels into what is kept of them.

    `change` exchanges surfaces on their way, for pictures that show what a mistake looks like.

    Raises
    ------
    IllegalValueError
        For textures that cannot be read, or too many triangles.
    NoAnswerError
        For a shading space that a body does not have.
    """
    loaded = plan.loaded
    maps = _shadow_maps(plan)
    outlined = [one for one in plan.drawn if Effect.OUTLINE in one.effects]
    drawn = [*plan.drawn, *(_hull_plan(loaded, one) for one in outlined)]
    drawables = [_drawable(plan, body, maps, change) for body in drawn]
    background = np.array(loaded.settings.background[: plan.channels], np.float64)
    buffer = loaded.settings.depth
    drawing = Drawing(drawables, loaded.canvas, background, buffer, keeps_depth)
    has_gamma = plan.picture[Effect.GAMMA].on
    picture = drawing.picture(lambda rows: finish(to_srgb(rows) if has_gamma else rows))
    passes = 1 + sum(map(len, maps.values())) + bool(outlined)
    watched = [
        (body, one.fragment)
        for body, one, samples in zip(plan.drawn, drawables, picture.shaded, strict=False)
        if samples and isinstance(one.fragment, _Watched)
    ]
    black = [body for body, seen in watched if seen.is_black]
    dark = [(body, seen.dark_part) for body, seen in watched if not seen.is_black]
    remarks = (
        *_told_of_black(loaded, black),
        *_told_of_dark([(body, part) for body, part in dark if part > MOSTLY]),
    )
    work = _work(drawn, picture, passes)
    seen, faint = picture.seen, _faint(drawables, sum(picture.shaded))
    return Rendered(picture.image, work, picture.shaded, remarks, picture.depth, seen, faint)


def _faint(drawables: Sequence[Drawable], shaded: int) -> float:
    """Return the part of all coloured points that is like the background."""
    watched = (one.fragment for one in drawables)
    return sum(one.faint for one in watched if isinstance(one, _Watched)) / max(shaded, 1)


class _Watched:
    """A fragment shader, and what it has made so far: is it black, how much is dark, or faint.

    `darkest` is the light that can hardly be told from black, and `like` holds the least and the
    largest light (channels, 1) that looks like the background.
    """

    def __init__(
        self,
        fragment: Callable[[Fragments], Array],
        darkest: float,
        like: tuple[Array, Array] | None,
    ) -> None:
        self.fragment, self.darkest, self.like = fragment, darkest, like
        self.is_black = True
        self.asked = self.dark = self.faint = 0

    @property
    def dark_part(self) -> float:
        """The part of all points that can hardly be told from black."""
        return self.dark / max(self.asked, 1)

    def __call__(self, fragments: Fragments) -> Array:
        found = self.fragment(fragments)
        if self.is_black and len(fragments):
            self.is_black = float(found.max()) < BLACK
        few = found[:, ::EVERY]
        self.asked += few.shape[1]
        self.dark += int(np.count_nonzero((few < self.darkest).all(axis=0)))
        if self.like is not None:
            low, high = self.like
            like = ((few > low) & (few < high)).all(axis=0)
            self.faint += EVERY * int(np.count_nonzero(like))
        return found


def _like_background(plan: Plan, opacity: float) -> tuple[Array, Array] | None:
    """Return the least and the largest light that is less than `APART` from the background.

    It is found for scenes that leave the background open. Of glass the background is a part.
    """
    settings = plan.loaded.settings
    if settings.other_background is None:
        return None
    own = colour(settings.background, plan.channels)
    level = to_srgb(own) if settings.gamma else own
    ends = (level - APART, level + APART)
    if settings.gamma:
        ends = (from_srgb(ends[0]), from_srgb(ends[1]))
    low, high = (own + (one - own) / max(opacity, BLACK) for one in ends)
    return low, high


def _told_of_black(loaded: LoadedScene, black: Sequence[BodyPlan]) -> tuple[str, ...]:
    """Name the bodies that are black, those together that are so for the same reasons."""
    reasons = {id(one): _why_black(loaded, one, ITS) for one in black}
    alike = [
        [one for one in black if reasons[id(one)] == why] for why in dict.fromkeys(reasons.values())
    ]
    return tuple(
        f"{_are(some)} black: {_why_black(loaded, some[0], ITS if len(some) == 1 else THEIR)}."
        for some in alike
    )


def _told_of_dark(dark: Sequence[tuple[BodyPlan, float]]) -> tuple[str, ...]:
    """Name the bodies that can hardly be told from black, and how much of them."""
    if not dark:
        return ()
    least = min(part for _, part in dark)
    or_more, of = ("", "it") if len(dark) == 1 else (" or more", "each")
    return (
        f"{_are([body for body, _ in dark])} nearly black: about {100 * least:.0f} %{or_more} of "
        f"what is seen of {of} is darker than level {round(APART * 255)} of 255.",
    )


def _are(bodies: Sequence[BodyPlan]) -> str:
    names = shortlist((printable(one.body.name) for one in bodies), MOST_NAMED)
    return f"{names} {'is' if len(bodies) == 1 else 'are'}"


def _why_black(loaded: LoadedScene, body: BodyPlan, whose: str) -> str:
    """Find the reasons why bodies are black: of lamps, and of the light from everywhere."""
    lamps = [f"{one.placed.light.name} {one.because}" for one in body.light_decisions if not one.on]
    if body.lights:
        lamps.append(f"what {body.lights[0].light.name} sends falls on no side that is seen")
        if body.effects & {Effect.TEXTURE, Effect.VERTEX_COLOURS}:
            lamps[-1] += f", or {whose} texture or {whose} colours are black there"
    material = body.body.material
    sends = f"{whose} material sends" if whose == ITS else f"{whose} materials send"
    is_dark = not any(material.diffuse) and not material.shines
    if is_dark and not any(material.ambient):
        return f"{sends} no light back, neither of lamps nor ambient"
    if is_dark:
        lamps = [f"{sends} no light of lamps back"]
    reasons = [*lamps[:MOST_REASONS], *([] if lamps else ["the scene has no lamp"])]
    ambient = "what is sent back of ambient light makes no level"
    if not any(material.ambient):
        ambient = f"{sends} no ambient light back"
    elif not any(loaded.ambient_light):
        ambient = "the ambient light is black"
    return f"{'; '.join(reasons)}; {ambient}"


def _shadow_maps(plan: Plan) -> dict[str, list[ShadowMap]]:
    """Return the maps of every light whose shadows some body asks for."""
    size = plan.loaded.settings.shadow_map
    return {
        name: [shadow_map(view, size) for view in views] for name, views in plan.light_views.items()
    }


def _hull_plan(loaded: LoadedScene, body: BodyPlan) -> BodyPlan:
    """Return the plan of a body's outline: no light, so it is black, and the body's fog."""
    effects = body.effects & OF_HULLS
    seen = SeenBody(loaded, hull(loaded, body.body))
    return replace(body, seen=seen, light_decisions=(), effects=effects)


def _drawable(
    plan: Plan, body: BodyPlan, maps: dict[str, list[ShadowMap]], change: Change
) -> Drawable:
    loaded, front = plan.loaded, body.seen.front
    culled = 0 if Effect.BACK_FACES in body.effects else -front
    clip_from_object = as_array(body.seen.clip_from_object)
    projected = project(body.body.mesh, clip_from_object, loaded.canvas, loaded.clip, culled)
    right = surface_of(plan, body, maps, front)
    surface, even = change(right), None
    if body.rate is not None and surface is right:
        even = body.rate.even_triangles(loaded, body.body, projected)
    outputs = surface.vertex(projected)
    if body.body.material.is_clear:
        inputs = opacity_inputs(body.body, projected)
        outputs = replace(outputs, points={**outputs.points, **inputs})
    seen_through, kept = clear(body.body), solid(body.body, projected)
    like = _like_background(plan, body.body.material.opacity if seen_through else 1.0)
    darkest = float(from_srgb(np.array(APART))) if plan.picture[Effect.GAMMA].on else APART
    watched = _Watched(surface.fragment, darkest, like)
    return Drawable(projected, outputs, watched, seen_through, kept, even)


def surface_of(plan: Plan, body: BodyPlan, maps: dict[str, list[ShadowMap]], front: int) -> Surface:
    """Return the surface of one body under its plan."""
    settings = plan.loaded.settings
    space = body.seen.space
    uses_metric = Effect.METRIC in body.effects
    if space.uses_metric is not uses_metric:
        space = replace(space, uses_metric=uses_metric)
    lighting = Lighting(
        body.body.material,
        tuple(_light_in_space(one, space, body, maps, plan.channels) for one in body.lights),
        colour(plan.loaded.ambient_light, plan.channels),
        space.point(plan.loaded.eye),
        space.measure,
        body.effects,
    )
    style = PictureStyle(
        settings.shading,
        plan.channels,
        body.rule(settings.normals),
        settings.fog,
        plan.picture[Effect.GAMMA].on,
    )
    return Surface(space, lighting, style, body.effects, front)


def _light_in_space(
    placed: PlacedLight,
    space: ShadingSpace,
    body: BodyPlan,
    maps: dict[str, list[ShadowMap]],
    channels: int,
) -> ShadingLight:
    """Return a light in the body's shading space."""
    light = placed.light
    shadowed = maps.get(light.name) if Effect.SHADOWS in body.effects else None
    axis = None if placed.direction is None else space.direction(placed.direction)
    return ShadingLight(
        colour(placed.colour, channels),
        to_light=None if axis is None or placed.position is not None else -axis,
        position=None if placed.position is None else space.point(placed.position),
        axis=axis,
        attenuation=light.attenuation,
        range=light.range,
        cone=light.cone_cosines if light.kind is LightKind.SPOT else None,
        occlusion=Occluded(shadowed, space) if shadowed and light.shadows else None,
    )


def _work(bodies: Sequence[BodyPlan], picture: Picture, passes: int) -> Work:
    """Count the work of everything that was drawn; layers of glass are a pass of their own."""
    vertices = [len(one.body.mesh.positions) for one in bodies]
    layered = any(Effect.TRANSPARENCY in one.effects for one in bodies)
    at_vertices = sum(n * per_vertex(one.effects) for n, one in zip(vertices, bodies, strict=True))
    at_samples = sum(
        n * per_sample(one.effects, len(one.lights))
        for n, one in zip(picture.shaded, bodies, strict=True)
    )
    return Work(
        vertices=sum(vertices),
        triangles=sum(len(one.body.mesh.triangles) for one in bodies),
        fragments=picture.fragments,
        shaded_samples=sum(picture.shaded),
        passes=passes + layered,
        multiplications=at_vertices + at_samples,
    )
