"""The explorer in a notebook: a widget of the very module that `nmatrix explore` writes."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import replace
from math import isfinite
from typing import Any

from nmatrix.api.setup import Part, Setup, world_part
from nmatrix.errors import IllegalValueError
from nmatrix.output.explorer.page import module, page_data
from nmatrix.output.explorer.sliders import (
    LARGEST,
    Sliders,
    first_look,
    light_of,
    sliders_of,
    world_of,
)
from nmatrix.requirements import missing
from nmatrix.scene import setup
from nmatrix.scene.world import World

try:
    from anywidget import AnyWidget
    from traitlets import Dict, validate
except ImportError:
    raise missing("the explorer in a notebook", "anywidget") from None


class Explorer(AnyWidget):
    """The explorer of a setup, with sliders that Python reads and moves.

    It shows the same module as the page of `nmatrix explore`, in a tree of its own, so that neither
    it nor the notebook spoils the other's looks; any number may stand on one page.

    Parameters
    ----------
    given
        What it begins with; parts that are not given stand where there is something to see.

    Attributes
    ----------
    state
        What differs from the start: the sliders' names and numbers, and what is chosen.

    Raises
    ------
    NoAnswerError
        If the world matrix is singular and not given by its parts: sliders cannot show it.
    """

    _esm = module()
    data = Dict().tag(sync=True)
    state = Dict().tag(sync=True)

    def __init__(self, given: Setup) -> None:
        usual, values = setup.Setup(), given.values
        parts = [one for one in ("world", "view", "lens", "light")
                 if getattr(values, one) != getattr(usual, one)]  # fmt: skip
        self._begun = first_look(values, parts)
        data = page_data(self._begun, fits="view" not in parts)
        super().__init__(data=json.loads(json.dumps(data)), state={})

    @property
    def world(self) -> World:
        """The object's place by the sliders; set it to a `World`, a mapping or a matrix."""
        return world_of(self._sliders)

    @world.setter
    def world(self, given: Part) -> None:
        moved = sliders_of(world_part(given))
        start = self.data["start"]
        kept = {key: value for key, value in self.state.items() if key not in moved}
        self.state = kept | {key: value for key, value in moved.items() if value != start[key]}

    @property
    def setup(self) -> Setup:
        """The setup by the sliders: its world and its light; camera and lens are the first ones."""
        light = light_of(self._sliders, self._begun.light)
        values = replace(self._begun, world=self.world, light=light)
        found = Setup.__new__(Setup)
        found.__dict__["values"] = values
        return found

    @property
    def _sliders(self) -> Sliders:
        start: Mapping[str, Any] = self.data["start"]
        return {**start, **{key: one for key, one in self.state.items() if key in start}}

    @validate("state")
    def _checked(self, proposal: Mapping[str, Any]) -> dict[str, Any]:
        """Refuse numbers that no slider takes; the page would leave them out without a word."""
        found: dict[str, Any] = proposal["value"]
        for key, usual in self.data["start"].items():
            value = found.get(key, usual)
            if isinstance(usual, str) or (value == usual and not isinstance(value, bool)):
                continue
            is_number = isinstance(value, int | float) and not isinstance(value, bool)
            if not (is_number and isfinite(value) and abs(value) < LARGEST):
                raise IllegalValueError(
                    f"state[{key!r}] ({value!r})",
                    f"a slider takes numbers below {LARGEST:,.0f}",
                    "give a smaller number",
                )
        return found
