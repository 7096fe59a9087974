"""The explorer in a notebook, seen from Python: its module, its state, and what it refuses."""

from __future__ import annotations

import json
import subprocess
import sys

import pytest

import nmatrix
from nmatrix.output.explorer.page import module, page
from nmatrix.output.explorer.sliders import first_look, sliders_of, world_of
from nmatrix.scene.setup import Setup as Values

pytest.importorskip("anywidget", reason="the extra notebook is not installed")

TURNED = nmatrix.World((1, 0, -2), (10, 20, 30), None, (1, -2, 0.5), (0.5, 0, 0))


def shown(**parts) -> object:
    return nmatrix.Setup(**parts).explore()


def test_page_and_widget_hold_the_same_module_byte_for_byte() -> None:
    widget, text = shown(), page(Values()).decode()
    script = text.partition('<script type="module">')[2].partition("</script>")[0]
    assert str(widget._esm) == script == module()
    assert len(script) > 50_000
    assert "export function mount" in script


def test_it_begins_with_what_was_given_and_else_where_there_is_something_to_see() -> None:
    assert shown().world == first_look(Values()).world
    assert shown(world=TURNED).world == TURNED
    assert shown(world=TURNED).data["fits"]
    assert not shown(view={"eye": (0, 0, 20)}).data["fits"]
    assert shown(view={"eye": (0, 0, 20)}).data["eye"] == [0, 0, 20]


def test_the_world_is_read_from_the_sliders_and_moves_them() -> None:
    widget = shown()
    widget.state = {"sx": 3, "mx": 1, "ry": 45, "hxy": 0.5, "tz": -1, "shape": "torus"}
    there = widget.world
    assert (there.scale, there.rotate_degrees) == ((-3, 2, 1), (0, 45, 0))
    assert (there.shear, there.translate) == ((0.5, 0, 0), (0, 0, -1))
    told = []
    widget.observe(lambda change: told.append(change["new"]), "state")
    widget.world = TURNED
    assert widget.world == TURNED
    assert told[-1]["shape"] == "torus", "what is no slider of the world stays"
    widget.world = {"scale": (1, 2, 1)}
    assert widget.state == {"shape": "torus"}, "the start is told by nothing"
    widget.world = [[0, -2, 0], [1, 0, 0], [0, 0, 3]]
    assert [round(abs(x), 12) for x in widget.world.scale] == [1, 2, 3]


def test_its_setup_answers_for_what_is_seen() -> None:
    widget = shown(light={"light_position": (2, 3, 4)})
    widget.state = {"sy": 4.0, "px": -1.5}
    found = widget.setup
    assert found.world().data["determinant"] == 4
    assert found.light("world").data["position"] == [-1.5, 3, 4]
    assert found.light("world").data["direction"] is None


@pytest.mark.parametrize("world", [TURNED, nmatrix.World(scale=(0, 2, -0.5))])
def test_sliders_tell_the_world_that_they_were_set_to(world) -> None:
    assert world_of(sliders_of(world)) == world


@pytest.mark.parametrize("value", [1e6, -1e300, float("nan"), float("inf"), "2", True, None])
def test_a_number_that_no_slider_takes_is_refused(value) -> None:
    widget = shown()
    with pytest.raises(nmatrix.IllegalValueError, match=r"state\['sx'\]") as found:
        widget.state = {"sx": value}
    assert "1,000,000" in str(found.value)
    assert widget.state == {}


def test_what_it_holds_is_json() -> None:
    widget = shown(world={"scale": (0.1, 2, -1)})
    assert json.loads(json.dumps(widget.data, allow_nan=False)) == widget.data


def test_without_the_package_one_sentence_says_what_brings_it() -> None:
    script = (
        "import sys; sys.modules['anywidget'] = None\n"
        "import nmatrix\n"
        "try: nmatrix.Setup().explore()\n"
        "except nmatrix.MissingPackageError as error: print(error.exit_code, error)"
    )
    found = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=True
    )
    code, _, sentence = found.stdout.strip().partition(" ")
    assert code == "4"
    assert sentence.endswith("pip install 'anywidget>=0.9'")
    assert "\n" not in sentence
