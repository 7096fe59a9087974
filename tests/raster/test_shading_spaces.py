"""Every shading space gives the same picture: the metric's whole claim."""

from __future__ import annotations

import numpy as np
import pytest
from small_scenes import BLINN, BULB, LAMBERT, PHONG, SUN, TOON, single

from nmatrix.enums import Effect, Space
from nmatrix.errors import NoAnswerError
from nmatrix.linear.rational import rational_matrix
from nmatrix.raster.loaded_scene import loaded
from nmatrix.raster.planning.plan import planned
from nmatrix.raster.planning.recipe import Decision
from nmatrix.raster.render import render
from nmatrix.raster.shading.space import Measure
from nmatrix.scene.light import SceneLight
from nmatrix.scene.scene import Scene
from nmatrix.scene.words import LightKind
from nmatrix.scene.world import World

WORLDS = {
    "scale": World(scale=(1, 2, 0.5), rotate_degrees=(10, 20, 30)),
    "shear": World(shear=(0.5, 0.2, -0.3)),
    "mirror": World(scale=(-1, 1.5, 1), rotate_degrees=(0, 40, 10)),
    "hard": World(scale=(1, 0.02, 1), rotate_degrees=(40, 0, 30), shear=(0.5, 0, 0)),
}
SPOT = SceneLight(
    "spot", LightKind.SPOT, position=(2, 3, 2), direction=(-2, -3, -2), cone_degrees=(10, 25)
)
SKEWED = rational_matrix([[1, 0.5, 0, 1], [0, 2, 0, 0], [0.25, 0, 1, -3], [0, 0, 0, 1]])
OTHERS = tuple(space for space in Space if space is not Space.WORLD)


def image(scene: Scene) -> np.ndarray:
    return render(planned(loaded(scene))).rgb


def differences(world: World, **scene: object) -> dict[Space, float]:
    reference = image(single(world, **scene))
    return {
        space: float(
            np.abs(
                image(single(world, space=space, space_matrix=SKEWED, **scene)) - reference
            ).max()
        )
        for space in OTHERS
    }


@pytest.mark.parametrize("name", WORLDS)
@pytest.mark.parametrize("lights", [(SUN,), (BULB,), (SUN, BULB, SPOT)])
@pytest.mark.parametrize("material", [LAMBERT, PHONG, BLINN])
def test_all_spaces_give_one_picture(name: str, lights: tuple, material: object) -> None:
    found = differences(WORLDS[name], lights=lights, material=material)
    assert max(found.values()) <= 1e-12, found


@pytest.mark.parametrize("scale", [(1, 0, 1.5), (0.8, 1, 0)])
@pytest.mark.parametrize("lights", [(SUN,), (SUN, BULB, SPOT)])
def test_a_flattened_body_looks_alike_in_every_space_that_it_has(
    scale: tuple, lights: tuple
) -> None:
    """A shear after the flattening: rounded by entries the map would have rank 3."""
    world = World(scale=scale, shear=(0.7, -0.3, 0.55), rotate_degrees=(20, 35, 50))
    reference = image(single(world, lights=lights, material=BLINN))
    for space in OTHERS:
        scene = single(world, space=space, space_matrix=SKEWED, lights=lights, material=BLINN)
        if space is Space.OBJECT:
            with pytest.raises(NoAnswerError, match="M flattens space to rank 2"):
                image(scene)
        else:
            assert np.abs(image(scene) - reference).max() <= 1e-12, space
    assert len(np.unique(reference)) > 1


def test_the_pictures_are_not_empty() -> None:
    shown = image(single(WORLDS["shear"], lights=(SUN, BULB), material=PHONG))
    assert len(np.unique(np.rint(shown * 255))) > 60


@pytest.mark.parametrize("material", [TOON])
def test_bands_differ_at_most_at_their_edges(material: object) -> None:
    reference = image(single(WORLDS["scale"], material=material))
    for space in OTHERS:
        other = image(single(WORLDS["scale"], material=material, space=space, space_matrix=SKEWED))
        assert (np.abs(other - reference).max(axis=2) > 1e-12).mean() < 1e-4


@pytest.mark.parametrize("space", [Space.OBJECT, Space.CUSTOM])
def test_without_the_metric_the_pictures_part(
    monkeypatch: pytest.MonkeyPatch, space: Space
) -> None:
    monkeypatch.setattr(Measure, "vector_in_world", lambda self, v: v)
    monkeypatch.setattr(Measure, "normal_in_world", lambda self, n: n)
    reference = image(single(WORLDS["scale"], material=PHONG))
    other = image(single(WORLDS["scale"], material=PHONG, space=space, space_matrix=SKEWED))
    assert np.abs(other - reference).max() > 0.02


def test_a_direction_moved_as_a_covector_would_be_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    from nmatrix.linear import rational as exact
    from nmatrix.raster.shading.space import ShadingSpace

    right = ShadingSpace.direction

    def transposed(self: ShadingSpace, vector: tuple) -> np.ndarray:
        M = exact.linear_part(self.body.world_from_object.exact)
        return right(self, exact.apply(exact.transpose(M), exact.apply(M, vector)))

    monkeypatch.setattr(ShadingSpace, "direction", transposed)
    reference = image(single(WORLDS["scale"]))
    monkeypatch.undo()
    assert np.abs(image(single(WORLDS["scale"])) - reference).max() > 0.02


def test_rigid_spaces_do_without_the_metric() -> None:
    for space in (Space.WORLD, Space.CAMERA, Space.LIGHT):
        (body,) = planned(loaded(single(WORLDS["scale"], space=space))).bodies
        assert "metric" not in body.effects
    assert isinstance(body.decisions[Effect.METRIC], Decision)
