"""One object under one camera, lens and light, and every question that can be asked about it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from numbers import Real
from pathlib import Path
from typing import Any

from nmatrix import report
from nmatrix.api.report import Report
from nmatrix.enums import (
    NORMAL_METHODS,
    NormalRule,
    Reflection,
    Shading,
    Space,
    chosen,
)
from nmatrix.linear.values import flag, named_file, number, plain_value, real, refused, vector
from nmatrix.report import Displayed
from nmatrix.samples import file_or_sample
from nmatrix.scene import setup
from nmatrix.scene.camera import View
from nmatrix.scene.given import hand_of, lens_of, light_of, view_of, world_of
from nmatrix.scene.lens import Lens
from nmatrix.scene.setup import Light
from nmatrix.scene.world import World
from nmatrix.spaces.shading_spaces import space_named

Part = Any  # a frozen value, a mapping of the options' names, or a matrix


@dataclass(frozen=True, init=False, repr=False)
class Setup(Displayed):
    """An object's place, a camera, a lens and a light; its methods are the commands.

    Each part is a frozen value (`World`, `View`, `Lens`, `Light`), or a mapping with the names of
    the command line's options in snake case, angles in degrees or as `Angle`; the first three may
    also be a matrix. What is not given is the command line's default: an object at the origin, an
    eye at (0, 0, 5) that looks at it, 60° of view, light along (−1, −1, −1).

    Parameters
    ----------
    world, view, lens, light
        The four parts.
    space_matrix
        `space_from_world` of the custom space, 3×3 or affine 4×4.
    tolerance
        How far columns may be off, relatively, for the kind of a map.

    Raises
    ------
    IllegalValueError
        For a name, a value or a contradiction that the command line refuses too.

    Examples
    --------
    >>> stretched = Setup(world={"scale": (1, 2, 1)})
    >>> stretched.normal([(1, 1, 0)]).data["normals"][0]["transformed"]
    [0.8944271909999159, 0.4472135954999579, 0.0]
    >>> stretched.light("object").data["position"] is None
    True
    """

    values: setup.Setup

    def __init__(
        self,
        world: Part = None,
        view: Part = None,
        lens: Part = None,
        light: Part = None,
        *,
        space_matrix: object = None,
        tolerance: float | None = None,
    ) -> None:
        more = {"space_matrix": space_matrix, "tolerance": tolerance}
        values = setup.Setup(
            world_part(world),
            _view(view, lens),
            _part(lens, Lens, lens_of, "projection_matrix"),
            _part(light, Light, light_of, None),
            **{name: value for name, value in more.items() if value is not None},  # type: ignore[arg-type]  # read there
        )
        object.__setattr__(self, "values", values)

    def __repr__(self) -> str:
        """Show the parts that are not the usual ones."""
        usual, mine = setup.Setup(), self.values
        names = ("world", "view", "lens", "light", "space_matrix", "tolerance")
        parts = ((name, getattr(mine, name)) for name in names)
        shown = (f"{name}={one!r}" for name, one in parts if one != getattr(usual, name))
        return f"Setup({', '.join(shown)})"

    def _repr_report_(self) -> report.Report:
        """Tell the matrices, the eye and the light."""
        return self.values._repr_report_()

    @classmethod
    def from_scene(
        cls,
        file: str | Path,
        *,
        object: str | None = None,
        light: str | None = None,
        allow_outside: bool = False,
    ) -> Setup:
        """Return one object of a scene file under one of its lights: the first, or by name.

        A node without triangles is found by its name or path too. What the file names lies in its
        folder, unless more is allowed.

        Raises
        ------
        IllegalValueError
            For a file that is no scene, or a name that is not in it.
        """
        from nmatrix.scene.chosen import setup_of
        from nmatrix.scene.open import scene_of

        found = cls.__new__(cls)
        scene = scene_of(file_or_sample(named_file(file, "file")), allow_outside=allow_outside)
        values = setup_of(scene, object, light)
        found.__dict__["values"] = values
        return found

    def world(self, *, steps: bool = False) -> Report:
        """Return the world matrix, what kind of map it is, its parts and its normal matrix.

        Parameters
        ----------
        steps
            Whether to add, line by line, how the matrices come about.
        """
        from nmatrix.answers.world import world

        return Report(world(self.values, steps=flag(steps, "steps")))

    def view(self, *, steps: bool = False) -> Report:
        """Return the view matrix, its two factors and the camera's axes.

        Parameters
        ----------
        steps
            Whether to add, line by line, how the matrix comes about.
        """
        from nmatrix.answers.view import view

        return Report(view(self.values, steps=flag(steps, "steps")))

    def projection(
        self, *, at: object = (), depth_value: object = (), steps: bool = False
    ) -> Report:
        """Return the projection matrix and the gaps between surfaces that its depth can tell.

        Parameters
        ----------
        at
            Distances whose window depth is asked for.
        depth_value
            Stored depths, from 0 to 1, whose distance is asked for.
        steps
            Whether to add, line by line, how the matrix comes about.
        """
        from nmatrix.answers.depth import DepthRequest
        from nmatrix.answers.projection import projection

        asked = DepthRequest(_numbers(at, "at"), _numbers(depth_value, "depth_value"))
        return Report(projection(self.values, asked, steps=flag(steps, "steps")))

    def normal(
        self,
        normals: object = (),
        *,
        space: str | Space = Space.WORLD,
        method: str | NormalRule = NormalRule.EXACT,
        steps: bool = False,
    ) -> Report:
        """Return the normal matrix from object space, and what becomes of some normals.

        A normal without an image is None with its status; `failure` then says why.

        Parameters
        ----------
        normals
            One normal or several, in object space.
        method
            exact, or inverse, cofactor, none to compare with.
        steps
            Whether to add, line by line, how the matrix and each normal come about.
        """
        from nmatrix.answers.normal import NormalRequest, normal

        request = NormalRequest(
            _vectors(normals, "normals"),
            space_named(space),
            chosen(NormalRule, method, "method", NORMAL_METHODS),
        )
        return Report(normal(self.values, request, steps=flag(steps, "steps")))

    def light(self, space: str | Space | None = None) -> Report:
        """Return the light's direction and position in a space, or in the four usual ones."""
        from nmatrix.answers.light import light

        return Report(light(self.values, None if space is None else space_named(space)))

    def eye(self, space: str | Space | None = None) -> Report:
        """Return the eye in a space, or in the four usual ones."""
        from nmatrix.answers.light import eye

        return Report(eye(self.values, None if space is None else space_named(space)))

    def space(
        self,
        space: str | Space = Space.WORLD,
        *,
        shading: str | Shading = Shading.PHONG,
        reflection: str | Reflection = Reflection.BLINN_PHONG,
    ) -> Report:
        """Return the sheet of a shading space: its data, uniforms, cost and shaders."""
        from nmatrix.answers.space import space as answer
        from nmatrix.shaders.sheet import Request

        request = Request(
            space_named(space),
            chosen(Shading, shading, "shading"),
            chosen(Reflection, reflection, "reflection"),
        )
        return Report(answer(self.values, request))

    def trace(
        self,
        point: object = None,
        *,
        normal: object = None,
        pixel: object = None,
        depth_value: object = None,
        viewport: object = None,
    ) -> Report:
        """Return one vertex in every frame from object space to the window, or a pixel's ray.

        Parameters
        ----------
        point, normal
            In object space; the origin where neither it nor a pixel is given.
        pixel
            x and y from the upper left corner instead; the first pixel's middle is (0.5, 0.5).
        depth_value
            The window depth there, from 0 to 1: then the point is known too.
        viewport
            Width and height in pixels; the lens's own, else 512 × 512.

        Raises
        ------
        IllegalValueError
            For a vertex and a pixel at once, or a depth outside 0 to 1.
        NoAnswerError
            For a depth that is infinitely far away.

        Examples
        --------
        >>> seen = Setup(lens={"fov": 90, "near": 1}).trace(pixel=(256, 256), depth_value=0)
        >>> seen.data["point_world"]
        [0.0, 0.0, 4.0]
        """
        from nmatrix.answers.trace import answer_to
        from nmatrix.linear.viewport import Viewport, read_viewport

        own = self.values.lens.viewport or Viewport(512, 512)
        given = {
            "point": None if point is None else vector(point, "point"),
            "normal": None if normal is None else vector(normal, "normal"),
            "pixel": None if pixel is None else vector(pixel, "pixel", size=2),
            "depth_value": None if depth_value is None else number(depth_value, "depth_value"),
        }
        window = own if viewport is None else read_viewport(viewport, "viewport")
        return Report(answer_to(given, self.values, window))


def setup_values(given: object) -> setup.Setup:
    """Return the frozen values of a setup that was given as `setup`."""
    if isinstance(given, Setup):
        return given.values
    raise refused(given, "setup", "it is no Setup", "give nmatrix.Setup(...)")


def world_part(world: Part) -> World:
    """Return a world from a frozen value, a mapping or a matrix."""
    found: World = _part(world, World, world_of, "world_matrix")
    return found


def _view(view: Part, lens: Part) -> View:
    """Return the view; where it names no hand, that of the lens is its own."""
    found: View = _part(view, View, view_of, "view_matrix")
    named = view.get("handed") if isinstance(view, Mapping) else view
    hand = hand_of(lens) if named is None and isinstance(lens, Mapping) else None
    return found if hand is None else replace(found, handed=hand)


def _part(given: Part, kind: type[Any], read: Any, matrix: str | None) -> Any:  # noqa: ANN401
    """Return a part of a setup from whatever described it."""
    if isinstance(given, kind):
        return given
    if given is None or isinstance(given, Mapping) or matrix is None:
        return read({} if given is None else given)
    if isinstance(given, Real):
        words = f"give a dict of them, a {kind.__name__} or a matrix"
        raise refused(given, kind.__name__.lower(), "it is described by names and values", words)
    return read({matrix: given})


def _numbers(given: object, name: str) -> tuple[Any, ...]:
    """Return numbers, from one or from several."""
    listed = plain_value(given, name)
    if not isinstance(listed, tuple | list):
        return (real(given, name),)
    return tuple(real(one, f"{name}[{i}]") for i, one in enumerate(listed))


def _vectors(given: object, name: str) -> tuple[Any, ...]:
    """Return vectors of three, from one or from several."""
    listed = plain_value(given, name)
    if isinstance(listed, tuple | list) and listed and not hasattr(listed[0], "__len__"):
        return (vector(listed, name),)
    if not isinstance(listed, tuple | list):
        return (vector(given, name),)
    return tuple(vector(one, f"{name}[{i}]") for i, one in enumerate(listed))
