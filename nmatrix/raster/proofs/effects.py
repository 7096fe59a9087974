"""The proof that the plan of a scene is the same picture as everything, for less work."""

from __future__ import annotations

import numpy as np

from nmatrix.raster.image import Panel, compose, levels
from nmatrix.raster.loaded_scene import loaded
from nmatrix.raster.planning.plan import everything, planned
from nmatrix.raster.proofs.proof import (
    Proof,
    ProofSettings,
    drawn_plan,
    level_difference,
)
from nmatrix.raster.proofs.showpiece import showpiece
from nmatrix.report import Value

AMPLIFIED = 50  # a difference in levels is drawn so many times brighter


def effects(settings: ProofSettings) -> Proof:
    """Draw a scene with everything on and by its plan: the same picture for less work."""
    ready = loaded(showpiece(settings.picture))
    started = settings.clock()
    full = drawn_plan(everything(ready))
    between = settings.clock()
    plan = drawn_plan(planned(ready))
    ended = settings.clock()
    difference = np.abs(full.rendered.rgb - plan.rendered.rgb)
    worst = float(difference.max())
    most, needed = (one.rendered.work.multiplications for one in (full, plan))
    numbers: dict[str, Value] = {
        "difference": worst,
        "multiplications_everything": most,
        "multiplications_planned": needed,
        "milliseconds_everything": (between - started) * 1000,
        "milliseconds_planned": (ended - between) * 1000,
    }
    panels = (
        Panel(full.levels, "Everything on", f"{most:,} multiplications"),
        Panel(plan.levels, "What the scene calls for", f"{needed:,}"),
        Panel(levels(difference * AMPLIFIED), f"Difference × {AMPLIFIED}", f"at most {worst:.0e}"),
    )
    return Proof.of(
        settings.subject,
        compose("The plan leaves out what cannot be seen", panels),
        f"The plan saves {1 - needed / most:.0%} of the multiplications; no channel moves by more "
        f"than {worst:.0e}.",
        [full, plan],
        numbers=numbers,
        max_level_difference=level_difference(full, plan),
    )
