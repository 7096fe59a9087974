"""Unknown words: by meaning first, then by spelling, and no wild guess; every hint exists."""

from __future__ import annotations

import os
import re
import shlex
from functools import cache

import pytest
from typer.core import TyperOption

from nmatrix.cli.app import load
from nmatrix.cli.catalogue import COMMANDS
from nmatrix.cli.meanings import meanings, meant_by, names_of
from nmatrix.errors import did_you_mean
from nmatrix.lessons.check.question import Subject

# What is typed, and what the hint must name; alternatives where the better one may not exist yet.
WANTED = {
    # three.js
    "lookat": "view", "unproject": "trace --pixel|the commands are", "decompose": "world",
    "compose": "world", "getnormalmatrix": "normal", "determinant": "calc", "multiply": "calc",
    "makerotationaxis": "world", "makescale": "world --scale",
    "quaternion": "world --quaternion|", "directionallight": "light", "pointlight": "light",
    "raycast": "trace --pixel|the commands are", "wireframe": "render teapot --show wireframe",
    "euler": "world --rotate", "inverse": "calc",
    # GLM
    "perspective": "projection", "ortho2d": "projection", "frustummatrix": "projection",
    "inversetranspose": "normal", "transpose": "calc", "cross": "calc", "angleaxis": "world",
    "radians": "world --rotate", "project": "trace --point", "infiniteperspective": "projection",
    "dual-quaternion": "the commands are", "slerp": "the commands are",
    # OpenCV
    "rodrigues": "world", "intrinsics": "projection", "extrinsics": "view",
    "calibration": "projection", "rvec": "world", "cameramatrix": "projection",
    # Unity, Unreal and Blender
    "localscale": "world --scale", "screenpointtoray": "trace --pixel|the commands are",
    "localtoworld": "world", "zup": "the commands are", "worldtoscreen": "trace", "mvp": "calc",
    "animate": "--frames", "draw": "render", "raytrace": "render", "resize": "world --scale",
    # NumPy and shells
    "inv": "calc", "det": "calc", "dot": "calc", "svd": "world", "matmul": "calc", "eval": "calc",
    "bench": "cost", "test": "stress", "verify": "check", "quiz": "handout",
    "docs": "help --docs", "prove": "derive", "man": "help --docs", "guess": "identify",
    "audit": "inspect",
    # with a command
    "world --rotation": "--rotate", "world --translation": "--translate",
    "world --size3": "--scale", "world --stretch": "--scale", "world --skew": "--shear",
    "world --quat": "--quaternion", "view --axis-angle": "world --axis-angle",
    "world --euler-order": "--order", "world --model": "--world-matrix",
    "world --matrix": "--world-matrix", "world --fov": "projection",
    "world --lens": "projection --fov", "world --pitch": "--rotate",
    "world --fx": "projection --", "world --eye": "view --eye", "world --at": "option of nmatrix",
    "world --offset": "--translate", "world --pos": "--translate",
    "world --precision": "--digits", "world --decimals": "--digits", "world --yaml": "--json",
    "world --column-major": "--input-layout", "world --colmajor": "--input-layout",
    "world --radians": "--rotate", "world --numpy": "-f numpy", "world --latex": "-f latex",
    "world --nocolor": "--color never", "world --unproject": "trace --pixel|see --help",
    "view --lookat": "--target", "view --center": "--target", "view --from": "--eye",
    "view --camera": "--eye", "view --yaw": "--angle", "view --pitch": "--elevation",
    "view --bank": "--roll", "view --upvector": "--up", "view --c2w": "--view-matrix|--pose",
    "view --lh": "--handed", "view --position": "--eye", "projection --fovy": "--fov",
    "projection --lens": "--fov", "projection --zoom": "--fov",
    "projection --fx": "--fov|--intrinsics", "projection --znear": "--near",
    "projection --zfar": "--far", "projection --far-plane": "--far",
    "projection --ratio": "--aspect", "projection --reverse-z": "--depth reversed",
    "projection --zero-to-one": "--depth zero-to-one", "projection --flip-y": "--clip-y",
    "projection --vulkan": "--api vulkan", "projection --d3d": "--api",
    "projection --orthographic": "--ortho", "projection --infinite": "--far",
    "projection --hfov": "--aspect|--fov-x", "light --sun": "--light-direction",
    "light --lamp": "--light-position", "render --dark": "--theme dark",
    "render --open": "explore", "render --resolution": "--size", "render --msaa": "--samples",
    "render --threads": "--workers", "render --animate": "--frames",
    "render --outfile": "--output", "render --overwrite": "--force", "render --teapot": "--mesh",
    "render --wireframe": "--show wireframe", "render --width": "--size",
    "render --node": "--object", "trace --resolution": "--viewport", "space --glsl": "-f glsl",
}  # fmt: skip
OWN_NUMBERS = {
    "world --euler 10 20 30": "--rotate 10 20 30?", "world --euler=10,20,30": "--rotate 10 20 30?",
    "view --position 1 -2 0 --up 0 1 0": "--eye 1 -2 0?", "world --fovy 45": "--fov 45?",
    "world --eye 1 2 3": "nmatrix view --eye 1 2 3?", "render --aa 16": "--samples 16?",
    "view --c2w '1 0 0; 0 1 0; 0 0 1'": '--pose "1 0 0; 0 1 0; 0 0 1"?',
    # Another unit, another order, another count, other coordinates: not their numbers.
    "world --radians 0 1.57 0": "--rotate 0 1.5708rad 0?", "world --wxyz 1 0 0 0": "=0,0,0,1?",
    "projection --width 640": "--viewport 640 480?", "trace --ndc 0 0 0": "--point=1,1,1?",
    "view --c2w --json": '--pose "1 0 0 0; 0 1 0 0; 0 0 1 5; 0 0 0 1"?',
    "view --c2w '1 0 0\n0 1 0\n0 0 1'": '--pose "1 0 0 0; 0 1', "view --c2w 'a\"b'": '--pose "1',
    f"world --fovy {'4' * 99}": "--fov 60?", "view --eye-z 4": "write --eye 0 0 4",
    # An option for each axis.
    "world --rotate-y 45": "write --rotate 0 45 0", "world --scaleX=2 --scaleY 3": "--scale 2 3 1",
    "world --rotation-x 5 --json": "--rotate 5 0 0", f"view --eye-z {'4' * 99}": "see --help",
}  # fmt: skip
NO_GUESS = [
    "normal --tang", "cost --n 3", "bbox", "gram-schmidt", "jacobian", "world --fps 3",
    "stress --n 3", "host", "post", "world --null", "world --pull", "fiew",
    "render --titlecase", "world --zzz", "world --quux", "render --pen", "world --shout",
    "view --banana", "calc M --quz", "normal --abc", "xyzzy", "frobnicate", "plugh", "render --hop",
]  # fmt: skip
SLIPS = {
    "wrold": "world", "veiw": "view", "projecton": "projection", "nromal": "normal",
    "redner": "render", "identfy": "identify", "chekc": "check", "proj": "projection",
    "world --sacle": "--scale", "world --rotte": "--rotate", "world --tranlsate": "--translate",
    "world --trans": "--translate", "view --taget": "--target", "world --fromat": "--format",
    "projection --aspct": "--aspect", "render --smaples": "--samples", "world --digit": "--digits",
}  # fmt: skip


def test_a_hundred_words_of_other_tools_are_known() -> None:
    assert len(WANTED) >= 100


@pytest.mark.parametrize("line", WANTED)
def test_a_word_of_another_tool_leads_to_what_it_is_here(nmatrix, line: str) -> None:
    found = nmatrix(line)
    assert (found.code, found.is_one_line) == (2, True)
    hint = found.err.partition("; ")[2]
    assert any(wanted in hint for wanted in WANTED[line].split("|")), found.err


@pytest.mark.parametrize("line", OWN_NUMBERS)
def test_a_hint_has_the_numbers_that_were_typed(nmatrix, line: str) -> None:
    found = nmatrix(line)
    assert (found.code, found.is_one_line) == (2, True)
    assert OWN_NUMBERS[line] in found.err


# Words of the field and of its programs, bare or dressed, and what each is here.
WORDS = {
    "gluUnProject": "trace --pixel", "glm::lookAt": "view --eye",
    "XMMatrixPerspectiveFovRH": "--fov",
    "Quaternion.Euler": "--rotate", "setFromRotationMatrix": "--rotate", "TBN": "--show tangents",
    "dolly": "view --eye", "orbit": "view --eye", "gimbal": "world --quaternion", "NDC": "--point",
    "modelview": 'calc "V @ M"', "MVP": 'calc "P @ V @ M"', "viewport": "--viewport 640 480",
    "worldspace": "space world", "pivot": "calc", "plane": "inverse_transpose", "mat4": "world",
    "frustum": "projection --frustum", "cubemap": "--fov 90", "stereo": "--angles",
    "quaternion": "world --quaternion 0 0 0 1",
    "homogeneous": "trace --point", "lineardepth": "--depth-value", "depth": "projection --depth",
    "norm": 'calc "length', "version": "nmatrix --version",
    "rotate": "world --rotate", "pixel": "trace --pixel", "makeOrthographic": "--ortho",
}  # fmt: skip


@pytest.mark.parametrize("word", WORDS)
def test_words_of_the_field_lead_to_a_command(nmatrix, word: str) -> None:
    found = nmatrix(word)
    assert (found.code, found.is_one_line) == (2, True)
    assert WORDS[word] in found.err.partition("did you mean ")[2]


@pytest.mark.parametrize("line", NO_GUESS)
def test_nothing_is_guessed_where_nothing_is_near(nmatrix, line: str) -> None:
    found = nmatrix(line)
    assert (found.code, found.is_one_line) == (2, True)
    assert "did you mean" not in found.err


@pytest.mark.parametrize("line", SLIPS)
def test_a_slip_is_understood(nmatrix, line: str) -> None:
    found = nmatrix(line)
    assert (found.code, found.is_one_line) == (2, True)
    assert f"did you mean {SLIPS[line]}?" in found.err


@pytest.mark.parametrize("known", [(), ("",), ("world", "")])
def test_nothing_is_meant_by_nothing(known: tuple[str, ...]) -> None:
    assert did_you_mean("", known, "see the list") == "see the list"
    assert did_you_mean("--", known, "see the list") == "see the list"


def hints(command: str) -> set[str]:
    return {found for word in meanings() if (found := meant_by(f"--{word}", command))}


@cache
def options_of(command: str) -> set[str]:
    options = [one for one in load(command).params if isinstance(one, TyperOption)]
    return {name for one in options for name in one.opts}


@pytest.mark.parametrize("command", COMMANDS)
def test_every_hint_is_understood_by_the_command_that_it_names(command: str) -> None:
    for hint in hints(command):
        words = hint.split()
        owner = command if words[0].startswith("-") else words[1]
        if owner == "help":
            continue
        known = options_of(owner)
        assert {word for word in words if word[:1] == "-" and word[1:2].isalpha()} <= known
        assert {word.partition("=")[0] for word in words if word.startswith("--")} <= known


def test_every_hint_of_a_whole_command_runs(nmatrix, tmp_path, monkeypatch) -> None:
    for place, hint in enumerate(
        sorted({found for word in meanings() if (found := meant_by(word))})
    ):
        (tmp_path / str(place)).mkdir()
        monkeypatch.chdir(tmp_path / str(place))
        line = hint.removeprefix("nmatrix ")
        if line.split()[0] in ("cost", "stress", "handout", "derive") or "--frames" in line:
            continue  # they run among the examples
        small = " --size 32 24" if line.startswith("render") and "--size" not in line else ""
        found = nmatrix(f"{line}{small}")
        assert found.code in (0, 1), (hint, found.err)


NEXT_STEP = re.compile(r"(?:try|see) nmatrix (.+)")
REFUSED = [*COMMANDS, *(f"check {one}" for one in (*Subject, "exercise")), "derive x", "render x"]


def test_every_next_step_that_is_a_command_runs(nmatrix, tmp_path, monkeypatch) -> None:
    before = {name for command in COMMANDS for name in names_of(command)}
    ran = 0
    for place, line in enumerate([*REFUSED, *sorted(before)]):
        (tmp_path / f"next{place}").mkdir()
        monkeypatch.chdir(tmp_path / f"next{place}")
        if line in ("cost", "stress", "handout", "--help", "-h"):
            continue
        told = NEXT_STEP.search(nmatrix(line).err)
        if told is not None:
            found = nmatrix(told[1].strip())
            assert found.code in (0, 1), (line, told[0], found.err)
            ran += 1
    assert ran > 20


def test_a_hint_of_what_does_not_exist_is_passed_over(monkeypatch) -> None:
    from nmatrix.cli import meanings as module

    told = {"warp": ("--no-such 1", "world --no-such 1", "nowhere", "world --scale 1 2 1")}
    monkeypatch.setattr(module, "meanings", lambda: told)
    assert meant_by("warp") == meant_by("--warp", "view") == "nmatrix world --scale 1 2 1"
    assert meant_by("weft", "view") is None


@pytest.mark.parametrize("command", COMMANDS)
def test_no_word_that_is_right_has_a_hint_of_its_own(command: str) -> None:
    assert names_of(command)
    for name in names_of(command):
        assert did_you_mean(name, names_of(command), "") == f"did you mean {name}?"


def test_words_are_parted_by_the_shell_alone() -> None:
    assert all(os.linesep not in word and shlex.split(word) == [word] for word in meanings())
