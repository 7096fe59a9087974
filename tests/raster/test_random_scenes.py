"""Random scenes: the plan moves no channel of any by more than it says, and never visibly."""

from __future__ import annotations

import numpy as np
import pytest
from random_scenes import KINDS, random_scene

from nmatrix.raster.loaded_scene import loaded
from nmatrix.raster.planning.plan import everything, planned
from nmatrix.raster.planning.recipe import BUDGET, ROUNDING
from nmatrix.raster.render import render

QUICK, SLOW = 3, 100  # scenes of each kind


@pytest.mark.parametrize(
    ("kind", "seed"),
    [
        pytest.param(kind, seed, id=f"{kind}-{seed}", marks=[pytest.mark.slow] * (seed >= QUICK))
        for kind in KINDS
        for seed in range(SLOW)
    ],
)
def test_the_plan_changes_no_channel_of_a_random_scene_by_more_than_it_says(
    kind: str, seed: int
) -> None:
    ready = loaded(random_scene(kind, seed))
    plan = planned(ready)
    bound = max(body.bound for body in plan.bodies)
    found, full = render(plan), render(everything(ready))
    assert bound <= BUDGET
    assert np.abs(found.rgb - full.rgb).max() <= bound + ROUNDING
    assert found.work.multiplications <= full.work.multiplications
