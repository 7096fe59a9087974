"""Help: as people ask for it, short, with every option, true, and with examples that run."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest
from typer.core import TyperOption

from nmatrix.cli import help as pages
from nmatrix.cli.app import load
from nmatrix.cli.catalogue import COMMANDS
from nmatrix.cli.command import examples_and_notes
from nmatrix.enums import Format, Theme
from nmatrix.errors import MissingPackageError, NMatrixError
from nmatrix.samples import FOLDER, file_or_sample, samples

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = [
    example
    for name, one in COMMANDS.items()
    for example in examples_and_notes(import_module(f"nmatrix.cli.{one.module}").HELP[name])[0]
]
SLOW = ("nmatrix cost", "nmatrix stress --random", "--frames")


def options(name: str) -> list[TyperOption]:
    return [one for one in load(name).params if isinstance(one, TyperOption)]


@pytest.mark.parametrize("line", ["-h", "--help", "help"])
def test_the_overview_in_every_habit(nmatrix, line: str) -> None:
    found = nmatrix(line)
    assert (found.code, found.err) == (0, "")
    assert found.out.startswith("  nmatrix world --scale 1 2 1\n")
    assert all(f"  {name} " in found.out for name in COMMANDS)


@pytest.mark.parametrize("name", COMMANDS)
def test_the_page_of_a_command_in_every_habit(nmatrix, name: str) -> None:
    page = nmatrix(f"{name} --help").out
    for line in (f"{name} -h", f"help {name}", f"--help {name}", f"{name} -h --digits"):
        assert nmatrix(line) == (0, page, "")


@pytest.mark.parametrize("line", ["-V", "--version"])
def test_the_version_in_every_habit(nmatrix, line: str) -> None:
    assert re.fullmatch(r"nmatrix \d+\.\d+\.\d+\n", nmatrix(line).out)


@pytest.mark.parametrize("name", COMMANDS)
def test_a_page_is_short_narrow_and_has_every_option(nmatrix, name: str) -> None:
    page = nmatrix(f"{name} --help").out
    assert len(page.splitlines()) <= 60
    assert max(map(len, page.splitlines())) <= 80
    for one in options(name):
        for spelling in one.opts:
            assert re.search(rf"{spelling}(?![\w-])", page), spelling


@pytest.mark.parametrize("name", COMMANDS)
def test_an_argument_is_named_by_what_it_is(nmatrix, name: str) -> None:
    usage = next(one for one in nmatrix(f"{name} --help").out.splitlines() if "Usage" in one)
    assert "None" not in usage
    places = re.findall(r"[A-Z_]{2,}", usage)
    assert len(places) == len(set(places))
    assert "[OPTIONS]" in usage


def test_examples_of_measuring_are_quick(nmatrix) -> None:
    examples = nmatrix("cost --help").out.partition("Usage")[0].split("\n\n")[0].splitlines()
    assert len(examples) >= 3
    assert all("--quick" in one for one in examples)


@pytest.mark.parametrize("name", COMMANDS)
def test_the_full_page_describes_every_option(nmatrix, name: str) -> None:
    page = nmatrix(f"{name} --help --full").out
    assert max(map(len, page.splitlines())) <= 80
    told = " ".join(page.split())
    for one in options(name):
        assert one.help
        assert " ".join(one.help.split()) in told, one.opts
        for word in map(str, getattr(one.type, "choices", ())):
            assert word in page


def test_the_groups_are_explained_once(nmatrix) -> None:
    page = nmatrix("help options").out
    told = " ".join(page.split())
    for name in COMMANDS:
        for one in options(name):
            if one.rich_help_panel is not None:
                assert one.help
                assert " ".join(one.help.split()) in told, one.opts
    for variable in pages.VARIABLES:
        assert variable in page
    assert page.count("  --world-matrix ") == 1


class Brought(type(Path())):
    """A file that an installation brought, as its metadata list it."""

    def locate(self) -> Path:
        return Path(self)


def test_the_documentation_is_where_the_help_says(nmatrix, monkeypatch, tmp_path) -> None:
    told = nmatrix("help --docs").out.splitlines()
    assert f"  {ROOT / 'docs'}" in told
    assert f"  python {ROOT / 'docs' / 'website'} -o site" in told
    assert (ROOT / "docs" / "website" / "__main__.py").is_file()
    monkeypatch.setattr(pages, "CHECKOUT", tmp_path)
    installed = tmp_path / "share" / "docs" / pages.A_DOCUMENT
    monkeypatch.setattr("importlib.metadata.files", lambda _: [Brought(installed)])
    page = nmatrix("help --docs").out
    assert "is not packed into this program" in " ".join(page.split())
    assert str(tmp_path) not in page
    installed.parent.mkdir(parents=True)
    installed.touch()
    told = nmatrix("help --docs").out
    assert f"  {installed.parent}" in told.splitlines()
    assert "website" not in told


def test_every_error_of_nmatrix_has_its_exit_code_in_the_list() -> None:
    told = pages.exit_codes()
    raised = {one.exit_code for one in NMatrixError.__subclasses__()}
    assert set(told) == {0, 70, 130} | raised
    assert all(sentence.endswith(".") for sentence in told.values())


def test_help_for_what_is_no_command_is_refused(nmatrix) -> None:
    found = nmatrix("help wrold")
    assert (found.code, found.is_one_line) == (2, True)
    assert "did you mean world?" in found.err


def shell(line: str, folder: Path) -> subprocess.CompletedProcess[str]:
    script = f'set -o pipefail; nmatrix() {{ "{sys.executable}" -m nmatrix "$@"; }}; {line}'
    return subprocess.run(
        ["bash", "-c", script],
        capture_output=True,
        text=True,
        check=False,
        cwd=folder,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
    )


def runs(example: str, folder: Path) -> None:
    done = shell(example, folder)
    judges = example.startswith(("nmatrix check", "nmatrix lint"))
    right = done.returncode if judges else 0
    assert done.returncode in (right, MissingPackageError.exit_code), (example, done.stderr)
    assert done.returncode < 2 or " install " in done.stderr, (example, done.stderr)


@pytest.mark.parametrize("example", [*pages.EXAMPLES, *EXAMPLES])
def test_every_example_runs_as_it_stands_in_an_empty_folder(example: str, tmp_path: Path) -> None:
    if example.startswith(SLOW) or "--frames" in example:
        pytest.skip("it takes long: the slow tests run it")
    runs(example, tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize(
    "example", [one for one in EXAMPLES if one.startswith(SLOW[:2]) or SLOW[2] in one]
)
def test_long_examples_run_too(example: str, tmp_path: Path) -> None:
    runs(example, tmp_path)


def test_a_sample_is_found_where_no_file_has_its_name(own_folder, nmatrix) -> None:
    assert set(samples(".obj", ".toml", ".csv")) == {"teapot", "sample", "class", "answers"}
    for name, path in samples(".obj", ".toml", ".csv").items():
        assert file_or_sample(name) == path
        assert path.parent == FOLDER
    Path("teapot").write_text("mine")
    assert file_or_sample("teapot") == Path("teapot")
    assert file_or_sample("folder/sample") == Path("folder/sample")
    assert "teapot" in nmatrix("inspect teapot").err  # a file without an ending is no mesh


def test_the_sample_scene_is_wrong_with_its_own_matrix(nmatrix) -> None:
    hand = nmatrix("world --scene sample --object hand --json").data
    egg = nmatrix("world --scene sample --object egg --json").data
    assert hand["transform"] == "shear"
    assert egg["transform"] == "non-uniform-scale"


def test_json_is_a_format_in_one_word(nmatrix) -> None:
    assert nmatrix("world --json") == nmatrix("world -f json")
    assert nmatrix("world --json -f json").code == 0
    twice = nmatrix("world --json -f csv")
    assert (twice.code, twice.is_one_line) == (2, True)
    for name in COMMANDS:
        assert any("--json" in one.opts for one in options(name))


def test_the_environment_sets_defaults_and_an_option_wins(nmatrix, monkeypatch) -> None:
    text, json_text = nmatrix("world").out, nmatrix("world -f json").out
    monkeypatch.setenv("NMATRIX_FORMAT", "json")
    assert nmatrix("world").out == json_text
    assert nmatrix("world -f text").out == text
    monkeypatch.setenv("NMATRIX_FORMAT", "csv")
    assert nmatrix("world --json").out == json_text
    monkeypatch.delenv("NMATRIX_FORMAT")
    monkeypatch.setenv("NMATRIX_DIGITS", "3")
    assert nmatrix("world --scale 1 1/3 1").out == nmatrix("world --scale 1 1/3 1 --digits 3").out
    monkeypatch.setenv("NMATRIX_COLOR", "always")
    assert "\x1b[" in nmatrix("world").out
    assert "\x1b[" not in nmatrix("world --color never").out


def test_a_default_that_a_command_cannot_use_is_passed_over(
    nmatrix, monkeypatch, own_folder
) -> None:
    text = nmatrix("derive mirror").out
    assert nmatrix("derive mirror -f numpy").code == 2
    monkeypatch.setenv("NMATRIX_FORMAT", "numpy")
    assert nmatrix("derive mirror").out == text
    for format_ in (*Format, "jsn", ""):
        monkeypatch.setenv("NMATRIX_FORMAT", format_)
        assert nmatrix("world").code == nmatrix("derive mirror").code == 0
    monkeypatch.setenv("NMATRIX_FORMAT", "json")
    assert nmatrix("render normals --size 64 36 --preview").code == 0
    monkeypatch.delenv("NMATRIX_FORMAT")
    world = nmatrix("world").out
    for name, value in (("DIGITS", "99"), ("DIGITS", "x"), ("COLOR", "red"), ("THEME", "pink")):
        monkeypatch.setenv(f"NMATRIX_{name}", value)
    assert nmatrix("world").out == world


def test_the_theme_of_the_environment_is_that_of_the_option(
    nmatrix, monkeypatch, own_folder
) -> None:
    line = "render normals --size 96 54 -o"
    for theme in Theme:
        assert nmatrix(f"{line} {theme}.png --theme {theme}").code == 0
    monkeypatch.setenv("NMATRIX_THEME", "dark")
    assert nmatrix(f"{line} usual.png").code == 0
    assert nmatrix(f"{line} option.png --theme light").code == 0
    assert Path("usual.png").read_bytes() == Path("dark.png").read_bytes()
    assert Path("option.png").read_bytes() == Path("light.png").read_bytes()
    assert Path("dark.png").read_bytes() != Path("light.png").read_bytes()
