"""`nmatrix explore` without a browser: what is written, how large, and what is refused."""

from __future__ import annotations

import json
import re
from base64 import b64encode
from hashlib import sha256
from pathlib import Path

import pytest

pytestmark = pytest.mark.usefixtures("own_folder")


def data(name: str) -> dict:
    text = Path(name).read_text(encoding="utf-8")
    return json.loads(re.search(r'id="nmatrix-explorer-data">(.*?)</script>', text, re.DOTALL)[1])


def start(name: str) -> dict:
    return data(name)["start"]


def test_one_small_file_that_fetches_nothing(nmatrix) -> None:
    code, out, err = nmatrix("explore -f json")
    assert (code, err) == (0, "")
    assert json.loads(out)["file"] == "explore.html"
    text = Path("explore.html").read_text(encoding="utf-8")
    assert len(text.encode()) < 250_000
    assert "default-src 'none'" in text
    assert not re.findall(r"(?:src|href)=\"", text)
    assert "http://" not in text
    assert "https://" not in text
    for tag, kind in (("script", ' type="module"'), ("style", "")):
        body = re.search(rf"<{tag}{kind}>(.*?)</{tag}>", text, re.DOTALL)[1]
        assert b64encode(sha256(body.encode()).digest()).decode() in text, "the policy allows it"


def test_the_same_scene_is_the_same_bytes(nmatrix) -> None:
    for name in ("a.html", "b.html"):
        assert nmatrix(f"explore --scale 1 2 1 -o {name}")[0] == 0
    assert Path("a.html").read_bytes() == Path("b.html").read_bytes()


def test_options_set_the_sliders(nmatrix) -> None:
    nmatrix("explore --scale -1 2 0.5 --rotate 10 20 30 --shear 1 0 0 --light-direction 0 -1 0")
    found = start("explore.html")
    assert [found[key] for key in ("sx", "mx", "sy", "sz")] == [1, 1, 2, 0.5]
    assert [found[key] for key in ("rx", "ry", "rz", "hxy")] == [10, 20, 30, 1]
    assert [found[key] for key in ("lx", "ly", "lz")] == [0, -1, 0]


def test_a_matrix_is_taken_apart_for_the_sliders(nmatrix) -> None:
    assert nmatrix('explore --world-matrix "0 -2 0; 1 0 0; 0 0 3" -o m.html')[0] == 0
    found = start("m.html")
    assert [abs(found[key]) for key in ("sx", "sy", "sz", "rz")] == [1, 2, 3, 90]
    code, _, err = nmatrix('explore --world-matrix "1 1 0; 1 1 0; 0 0 1" -o s.html')
    assert code == 3
    assert "singular" in err


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("explore", "the file exists"),
        ("explore -o no/x.html", "no folder"),
        ("explore -o x.pdf", ".html"),
    ],
)
def test_nothing_is_overwritten_or_put_nowhere(nmatrix, line: str, words: str) -> None:
    Path("explore.html").write_text("mine")
    code, _, err = nmatrix(line)
    assert code == 2
    assert words in err
    assert Path("explore.html").read_text() == "mine"


def test_without_a_scene_the_page_starts_where_there_is_something_to_see(nmatrix) -> None:
    assert nmatrix("explore")[0] == 0
    found = start("explore.html")
    assert [found[key] for key in ("sx", "sy", "sz")] == [1, 2, 1]
    assert [found[key] for key in ("lx", "ly", "lz")] == [-0.85, -0.55, -0.65]


def test_an_eye_that_was_given_keeps_its_distance(nmatrix) -> None:
    for words, fits in (("", True), ("--eye 0 0 20", False)):
        assert nmatrix(f"explore {words} -o page{fits}.html")[0] == 0
        assert data(f"page{fits}.html")["fits"] is fits


@pytest.mark.parametrize("lens", ["--fov 20 --far inf", "--ortho -2 2 -2 2", "--api vulkan"])
def test_every_lens_is_written_as_the_option_that_makes_it(nmatrix, lens: str) -> None:
    assert nmatrix(f"explore {lens} -o lens.html")[0] == 0
    said = data("lens.html")["options"]["lens"]
    answers = [nmatrix(f"projection {one} -f json")[1] for one in (lens, said)]
    matrices = [json.loads(one)["clip_from_camera"] for one in answers]
    assert matrices[0] == matrices[1]
