"""What hands and eyes find on the explorer: stories, dragging, keys, a phone, paper, names."""

from __future__ import annotations

import io
import json
import re
from base64 import b64decode

import numpy as np
import pytest
from browser.inside import inside
from PIL import Image

from nmatrix.canvas.theme import PALETTES
from nmatrix.enums import Space, Theme
from nmatrix.output.explorer.page import page
from nmatrix.scene.camera import View
from nmatrix.scene.lens import Lens
from nmatrix.scene.setup import Light, Setup
from nmatrix.scene.world import World

pytestmark = pytest.mark.slow

SETUP = Setup(
    World(scale=(1, 2, 1)),
    View(eye=(3.6, 1.5, 9.2)),
    Lens(fov_degrees=30),
    Light((-0.85, -0.55, -0.65)),
)
PHONE = {"viewport": {"width": 390, "height": 844}, "has_touch": True, "is_mobile": True}


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    path = tmp_path_factory.mktemp("explorer") / "explore.html"
    path.write_bytes(page(SETUP, fits=True))
    return path


def state(found) -> dict:
    return json.loads(found.locator("#state").text_content())


def settled(found) -> dict:
    """The state once everything is drawn and the address is written."""
    found.evaluate(
        inside(
            """async () => { const rest = () => new Promise(done => setTimeout(done, 20));
            while (isBusy) await rest(); }"""
        )
    )
    return state(found)


def picture(found, canvas: str) -> np.ndarray:
    """The levels (height, width, 3) of a canvas."""
    address = found.locator(canvas).evaluate("c => c.toDataURL()")
    image = Image.open(io.BytesIO(b64decode(address.partition(",")[2])))
    return np.asarray(image.convert("RGB"), int)


def chosen(found, name: str) -> dict:
    found.get_by_role("button", name=name, exact=True).click()
    return settled(found)


def test_each_story_keeps_what_its_name_claims(opened, file) -> None:
    found = opened(file)
    said = found.locator("#sentence")
    claims = {
        "Stretch": (lambda s: s["largest"] == pytest.approx(36.8699, abs=1e-3), "Stretched 2×"),
        "Mirror": (lambda s: s["largest"] == 180 and s["det"] == -1, "Mirrored along x"),
        "Flatten": (lambda s: s["largest"] == pytest.approx(90) and s["N"] is None, "Flattened"),
        "Shear": (lambda s: s["largest"] == pytest.approx(48.1897, abs=1e-3), "Sheared"),
        "Stuck light": (lambda s: s["largest"] > 30 and s["brightness"] > 0.3, "Turned 60°"),
        "Only turn: proves nothing": (lambda s: s["isSame"], "proves nothing"),
        "Even scale: proves nothing": (lambda s: s["isSame"], "proves nothing"),
    }
    names = found.locator("#stories button").all_inner_texts()
    assert names == list(claims)
    for name, (holds, words) in claims.items():
        seen = chosen(found, name)
        assert holds(seen), name
        assert words in said.text_content()
        assert seen["errors"] == []
        same = seen["isSame"]
        assert same == ("proves nothing" in name)
        assert found.locator("#same").is_visible() is same
        badges = found.locator(".view:visible .tag").evaluate_all(
            "all => all.map(e => e.className)"
        )
        assert badges == ["tag wrong", "tag right"], "a wrong rule stays wrong where nothing shows"
        if same:
            assert found.locator("#number").text_content() == "0°"
    assert found.complaints == []


def test_a_mirror_is_seen_on_the_letter(opened, file) -> None:
    found = opened(file, "#sy=1&shape=R&yaw=0")
    script = inside("""() => { const m = meaningNow();
        const front = p => onStage(m, point(m.M, [...p, 0.24]), 1);
        return [[-0.45, 0.6], [0.45, 0.4]].map(p => front(p)[0]); }""")
    stem, bowl = found.evaluate(script)
    assert stem < bowl
    found.locator("#more-mirror").click()
    found.locator("#mx").click()
    stem, bowl = found.evaluate(script)
    assert stem > bowl


@pytest.mark.parametrize("story", ["", "hxy=1&sy=1", "sy=0", "sy=1&mx=1&shape=R", "shape=torus"])
def test_arrows_stand_on_the_surface_and_end_where_their_tip_is_projected(opened, file, story):
    found = opened(file, f"#{story}")
    seen = state(found)
    ends = found.evaluate(
        inside("""() => { const m = meaningNow();
            const end = (t, W) => arrowOf(t, W, m.isFlat, m.radii.far);
            return tacksOf(m).map(t => (
                { up: t.upright, ends: [end(t, m.wrong), end(t, m.right)] })); }""")
    )
    assert len(ends) >= 4
    V = np.array(seen["camera"])
    P = np.array(found.evaluate(inside("() => data.clip_from_camera")))
    for side, which in (("wrong", 0), ("right", 1)):
        drawn = [one for one in ends if one["ends"][which]]
        assert len(drawn) == len(seen["arrows"][side])
        for one, (start, tip) in zip(drawn, seen["arrows"][side], strict=True):
            for p, q in zip(one["ends"][which], (start, tip), strict=True):
                x, y, _, w = P @ V @ np.array([*p, 1])
                assert np.allclose([(x / w + 1) / 2, (1 - y / w) / 2], q, atol=1e-9)
            if side == "right":
                a, b = np.array(one["ends"][1])
                assert (b - a) @ one["up"] / np.linalg.norm(b - a) == pytest.approx(1, abs=1e-9)


def test_dragging_moves_the_camera_of_both_views_and_the_address(opened, file) -> None:
    found = opened(file)
    before = state(found)["eye"]
    box = found.locator("#wrong").bounding_box()
    found.mouse.move(box["x"] + 60, box["y"] + 300)
    found.mouse.down()
    found.mouse.move(box["x"] + 160, box["y"] + 330, steps=4)
    found.mouse.up()
    after = settled(found)["eye"]
    assert np.linalg.norm(np.subtract(before, after)) > 1
    assert np.linalg.norm(after) == pytest.approx(np.linalg.norm(before), rel=1e-4)
    assert after[0] < before[0], "the eye walks to the left where the hand goes to the right"
    assert after[1] > before[1]
    settled(found)
    assert "yaw=" in found.url
    found.reload()
    assert state(found)["eye"] == after


def test_a_finger_drags_too(opened, file) -> None:
    found = opened(file, **PHONE)
    before = state(found)["eye"]
    found.evaluate(
        inside("""() => { const at = byId("both"), finger = { pointerType: "touch", pointerId: 1 };
            const send = (kind, x) => at.dispatchEvent(
                new PointerEvent(kind, { ...finger, clientX: x, clientY: 300, bubbles: true }));
            at.setPointerCapture = () => {};
            send("pointerdown", 100); send("pointermove", 160); send("pointerup", 160); }""")
    )
    assert settled(found)["eye"] != before
    assert found.locator("#both").evaluate("e => getComputedStyle(e).touchAction") == "none"


def test_the_light_is_dragged_by_hand_and_by_keys(opened, file) -> None:
    found = opened(file)
    sun = found.locator("#light-right")
    before, box = state(found)["light"], sun.bounding_box()
    found.mouse.move(box["x"] + 24, box["y"] + 24)
    found.mouse.down()
    found.mouse.move(box["x"] + 24, box["y"] + 224, steps=5)
    found.mouse.up()
    low = settled(found)["light"]
    assert low[1] > before[1] + 0.3, "a sun that was carried down shines up more"
    assert sun.bounding_box()["y"] > box["y"] + 60, "and is drawn lower"
    sun.focus()
    found.keyboard.press("ArrowUp")
    found.keyboard.press("ArrowLeft")
    assert settled(found)["light"] != low
    assert found.evaluate(inside("() => root.activeElement.id")) == "light-right"


def test_the_keyboard_moves_a_slider_the_view_and_the_address(opened, file) -> None:
    found = opened(file)
    found.locator("#sy").focus()
    found.keyboard.press("ArrowRight")
    assert settled(found)["A"][1][1] == pytest.approx(2.05)
    settled(found)
    assert "sy=2.05" in found.url
    found.reload()
    assert state(found)["A"][1][1] == pytest.approx(2.05)
    found.locator("#reset").press("Enter")
    assert settled(found)["A"][1][1] == 2
    eye = state(found)["eye"]
    found.locator("#right").focus()
    found.keyboard.press("ArrowLeft")
    assert settled(found)["eye"] != eye


def test_all_is_reached_by_tab_with_a_focus_that_is_seen_and_a_name_of_its_own(opened, file):
    found = opened(file)
    places = found.evaluate(
        inside(
            """() => [...root.querySelectorAll("button, input, select, summary, [tabindex]")]
            .filter(e => e.checkVisibility() && e.tabIndex >= 0).map(e => e.id || e.textContent)"""
        )
    )
    reached, names = [], []
    found.locator("body").press("Tab")
    for _ in range(len(places) + 2):
        now, name, outline = found.evaluate(
            inside(
                """() => { const e = root.activeElement, label = e?.labels && e.labels[0];
                if (!e) return [null, "", ""];
                const name = e.getAttribute("aria-label") || (label || e).textContent;
                return [e.id || e.textContent, name, getComputedStyle(e).outlineStyle]; }"""
            )
        )
        if now is None or now in reached:
            break
        assert outline != "none", now
        reached.append(now)
        names.append(name.strip())
        found.keyboard.press("Tab")
    assert set(places) <= set(reached)
    assert len(set(names)) == len(names), "no two have one name"
    assert all(len(name) > 2 for name in names)


def test_only_the_sliders_of_the_story_are_shown_with_their_full_names(opened, file) -> None:
    found = opened(file)
    shown = "#sliders label:visible"
    assert found.locator(shown).all_inner_texts() == [f"stretch along {a}" for a in "xyz"]
    chosen(found, "Shear")
    assert found.locator(shown).first.inner_text() == "shear x along y"
    found.locator("#more-turn").click()
    assert "turn about z, in degrees" in found.locator(shown).all_inner_texts()


def test_a_divider_parts_wrong_from_right(opened, file) -> None:
    found = opened(file, "#layout=divider&mode=plain")
    before = picture(found, "#both")
    near, far = before.shape[1] // 3, 2 * before.shape[1] // 3
    found.locator("#divider").focus()
    for _ in range(10):
        found.keyboard.press("ArrowRight")
    settled(found)
    assert found.locator("#divider").get_attribute("aria-valuenow") == "100"
    after = picture(found, "#both")
    assert (after[:, near] == before[:, near]).all()
    assert (after[:, far] != before[:, far]).any()
    handle, box = found.locator("#divider").bounding_box(), found.locator("#both").bounding_box()
    found.mouse.move(handle["x"] + 20, handle["y"] + 20)
    found.mouse.down()
    found.mouse.move(box["x"] + box["width"] / 2, handle["y"] + 20, steps=4)
    found.mouse.up()
    settled(found)
    assert 40 < int(found.locator("#divider").get_attribute("aria-valuenow")) < 60


def test_the_map_and_its_bar_end_at_the_number(opened, file) -> None:
    found = opened(file, "#mode=heat")
    assert found.locator("#bar-top").text_content() == found.locator("#number").text_content()
    top = [int(PALETTES[Theme.LIGHT].heat[-1][i : i + 2], 16) for i in (1, 3, 5)]
    wrong, right = picture(found, "#wrong"), picture(found, "#right")
    assert (np.abs(wrong - top).max(axis=2) < 12).any(), "somewhere it is off by the most"
    assert not (np.abs(right - top).max(axis=2) < 12).any(), "the right normals nowhere are"


def test_a_space_is_chosen_where_it_is_drawn_and_the_picture_stays(opened, file) -> None:
    found = opened(file, "#mode=plain&ry=25")
    assert found.locator(".place strong").all_inner_texts() == [space.value for space in Space]
    before = picture(found, "#right")
    for space in Space:
        found.locator(f".place[data-space={space}]").click()
        found.locator(f".place[data-space={space}]").scroll_into_view_if_needed()
        found.wait_for_timeout(100)
        settled(found)
        after = picture(found, "#right")
        assert (np.abs(before - after) > 3).mean() < 0.005, space
        stage = picture(found, f".place[data-space={space}] canvas")
        assert len(np.unique(stage.reshape(-1, 3), axis=0)) > 50, "its stage is drawn"


@pytest.mark.parametrize("theme", [Theme.LIGHT, Theme.DARK])
def test_page_and_stage_follow_the_scheme_and_the_switch(opened, file, theme) -> None:
    found = opened(file, color_scheme=theme.value)
    palette = PALETTES[theme]
    paper = inside("() => getComputedStyle(root.host).backgroundColor")
    stage = inside(
        "() => [...byId('right').getContext('2d').getImageData(4, 4, 1, 1).data].slice(0, 3)"
    )

    def rgb(colour: str) -> list[int]:
        return [int(colour[i : i + 2], 16) for i in (1, 3, 5)]

    assert [int(x) for x in re.findall(r"\d+", found.evaluate(paper))] == rgb(palette.paper)
    assert found.evaluate(stage) == rgb(palette.stage)
    found.locator("#theme").click()
    other = PALETTES[Theme.LIGHT if theme is Theme.DARK else Theme.DARK]
    assert found.evaluate(stage) == rgb(other.stage)
    found.emulate_media(media="print")
    found.evaluate("window.dispatchEvent(new Event('beforeprint'))")
    assert found.evaluate(stage) == rgb(PALETTES[Theme.PRINT].stage)
    assert [int(x) for x in re.findall(r"\d+", found.evaluate(paper))] == [255, 255, 255]


def test_paper_shows_pictures_and_numbers_and_no_controls(opened, file) -> None:
    found = opened(file)
    found.emulate_media(media="print")
    for shown in ("#wrong", "#right", "#map", "#number", "#sentence", "#matrices", ".place canvas"):
        assert found.locator(shown).first.is_visible(), shown
    for hidden in ("#sliders", "#stories", "#hands", "#mode", "#theme"):
        assert found.locator(hidden).is_hidden(), hidden
    levels = picture(found, "#right")
    assert (levels.max(axis=2) - levels.min(axis=2)).max() <= 2, "one channel of grey"


@pytest.mark.parametrize("scheme", ["light", pytest.param("dark", marks=pytest.mark.slow)])
def test_on_a_phone_nothing_scrolls_sideways_and_a_thumb_meets_all(opened, file, scheme) -> None:
    found = opened(file, color_scheme=scheme, **PHONE)
    for story in found.locator("#stories button").all():
        story.click()
        settled(found)
        for more in found.locator("#more button:visible").all():
            more.click()
        assert found.evaluate("document.documentElement.scrollWidth") <= 390
        small = found.evaluate(
            inside(
                """() => [...root.querySelectorAll("button, input, select, summary, [role=slider]")]
                .filter(e => e.checkVisibility()).filter(e => {
                    const { width, height } = e.getBoundingClientRect();
                    return Math.min(width, height) < 40; })
                .map(e => e.id || e.textContent)"""
            )
        )
        assert small == []
    found.evaluate("window.scrollTo(0, 500)")
    assert found.locator("#both").bounding_box()["y"] < 20, "the picture stays at the top"
    assert found.complaints == []


def test_nothing_is_drawn_while_nothing_moves(opened, file) -> None:
    found = opened(file, reduced_motion="reduce")
    settled(found)
    before = found.evaluate(inside("() => framesDrawn"))
    found.wait_for_timeout(400)
    assert found.evaluate(inside("() => framesDrawn")) == before
    moving = found.evaluate(inside("() => getComputedStyle(byId('reset')).transitionDuration"))
    assert moving == "0s"


def test_a_lamp_that_has_a_place_is_dragged_and_told(opened, tmp_path) -> None:
    path = tmp_path / "lamp.html"
    lamp = Setup(World(scale=(1, 2, 1)), View(eye=(0, 1, 8)), light=Light(position=(2, 2, 3)))
    path.write_bytes(page(lamp))
    found = opened(path)
    assert state(found)["errors"] == []
    found.locator("#light-right").focus()
    found.keyboard.press("ArrowRight")
    settled(found)
    words = found.locator("#shader-command").text_content()
    x = float(re.search(r"--light-position (\S+)", words)[1])
    assert x > 2
    chosen(found, "Stuck light")
    assert "seen from the model" in found.locator("#sentence").text_content()
    assert found.complaints == []
