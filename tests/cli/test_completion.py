"""TAB: every command, option, word and name, in each shell's protocol and in the shell."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import completions
import pytest
from typer.core import TyperArgument, TyperOption

from nmatrix.cli.app import load, run
from nmatrix.cli.catalogue import COMMANDS
from nmatrix.cli.completion import TABLE, answer, offers
from nmatrix.cli.shells import SHELLS
from nmatrix.enums import Format, Shown, Space, Theme

ROOT = Path(__file__).resolve().parents[2]


def bash(line: str) -> dict[str, str]:
    return {"COMP_LINE": line, "COMP_POINT": str(len(line))}


def words_of_bash(line: str) -> dict[str, str]:
    """What a script asks that knows the words alone."""
    words = line.split(" ")
    return {"COMP_WORDS": "\n".join(words), "COMP_CWORD": str(len(words) - 1)}


def others(line: str) -> dict[str, str]:
    return {"_TYPER_COMPLETE_ARGS": line, "_TYPER_COMPLETE_FISH_ACTION": "get-args"}


PROTOCOLS = {
    "bash": ("complete_bash", bash),
    "bash-words": ("complete_bash", words_of_bash),
    "zsh": ("complete_zsh", others),
    "fish": ("complete_fish", others),
}


@pytest.fixture(params=PROTOCOLS)
def offered(request, monkeypatch):
    """Ask at the end of a line as a shell asks, and return the words of the answer."""
    instruction, environment = PROTOCOLS[request.param]

    def ask(line: str) -> list[str]:
        for name, value in environment(line).items():
            monkeypatch.setenv(name, value)
        told = answer(instruction)
        if request.param == "zsh":
            if told == "_files":
                return []
            inside = told.removeprefix("_arguments '*: :((").removesuffix("))'")
            return [one.split('"')[1] for one in inside.splitlines()]
        return [one.partition("\t")[0] for one in told.splitlines()]

    return ask


def test_the_table_is_what_the_commands_say() -> None:
    assert TABLE.read_text(encoding="utf-8") == completions.written(), (
        "run python tests/completions.py"
    )


def test_every_command_completes(offered) -> None:
    for name in (*COMMANDS, "help"):
        assert name in offered(f"nmatrix {name[:2]}")
    assert set(COMMANDS) < set(offered("nmatrix "))


@pytest.mark.parametrize("name", COMMANDS)
def test_every_option_completes(offered, name: str) -> None:
    for one in load(name).params:
        if isinstance(one, TyperOption):
            for spelling in one.opts:
                assert spelling in offered(f"nmatrix {name} {spelling[:3]}")
    assert {"--help", "-h", "--full"} <= set(offered(f"nmatrix {name} -"))


@pytest.mark.parametrize("name", COMMANDS)
def test_every_word_of_a_list_completes(offered, name: str) -> None:
    arguments = [one for one in load(name).params if isinstance(one, TyperArgument)]
    for one in load(name).params:
        for word in map(str, getattr(one.type, "choices", ())):
            if isinstance(one, TyperOption):
                assert word in offered(f"nmatrix {name} {one.opts[0]} {word[:1]}")
            else:
                assert one.name == arguments[0].name
                assert word in offered(f"nmatrix {name} {word[:1]}")


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("nmatrix world -f ", set(Format)),
        ("nmatrix world --scale 1 2 1 -f j", {"json", "js"}),
        ("nmatrix world --scale 1,2,1 -f j", {"json", "js"}),
        ("nmatrix space ", set(Space) | {"view", "model"}),
        ("nmatrix eye --space ", set(Space)),
        ("nmatrix derive ", {"rule", "mirror", "all"}),
        ("nmatrix render ", {"normals", "mirror", "teapot", "sample"}),
        ("nmatrix render --mesh ", {"teapot"}),
        ("nmatrix render --theme ", set(Theme)),
        ("nmatrix render --show ", set(Shown)),
        ("nmatrix render --show axes,", {f"axes,{one}" for one in Shown if one != "axes"}),
        ("nmatrix check ", {"world", "view", "normal", "light", "eye", "exercise"}),
        ("nmatrix check exercise ", {"1", "10"}),
        ("nmatrix handout --topics rule,e", {"rule,exercises"}),
        ("nmatrix handout --roster ", {"class"}),
        ("nmatrix stress --case N1", {"N1", "N19"}),
        ("nmatrix normal --method ", {"exact", "inverse", "cofactor", "none"}),
        ("nmatrix world --order ", {"XYZ", "ZYX", "YXZ", "xyz", "zxy"}),
        ("nmatrix axes opengl unity --order z", {"zxy", "zyx"}),
        ("nmatrix axes u", {"unity", "unreal", "usd-z-up"}),
        ("nmatrix render --samples ", {"1", "4", "16", "64"}),
        ("nmatrix help ", set(COMMANDS) | {"options"}),
        ("nmatrix help --", {"--docs"}),
        ("nmatrix --", {"--help", "--version", "--install-completion", "--show-completion"}),
        ("nmatrix world --scene ", {"sample", "teapot"}),
        ("nmatrix world --scene sample --object ", {"egg", "floor", "forearm", "hand"}),
        ("nmatrix light --scene sample --light ", {"sun", "lamp"}),
        ("nmatrix render sample --object h", {"hand"}),
    ],
)
def test_words_that_are_no_enum(offered, line: str, words: set[str]) -> None:
    assert words <= set(offered(line))


def test_every_order_of_axes_is_one_that_is_taken(offered, nmatrix) -> None:
    told = offered("nmatrix world --order ")
    assert len(set(told)) == len(told) == 12
    assert all(nmatrix(f"world --order {one}").code == 0 for one in told)


def test_nothing_is_offered_twice_or_where_it_cannot_stand(offered) -> None:
    assert "--scale" not in offered("nmatrix world --scale 1 2 1 --sc")
    assert "--normal" in offered("nmatrix normal --normal 1 0 0 --nor")
    assert offered("nmatrix check world ") == []
    assert offered("nmatrix world --scale 1 ") == []
    assert offered("nmatrix wrold --") == []
    assert offered("nmatrix world --scene no-such.toml --object ") == []


def test_no_word_twice_within_commas(offered) -> None:
    assert "axes,axes" not in offered("nmatrix render --show axes,")
    assert "rule,rule" not in offered("nmatrix handout --topics rule,")


def test_a_joined_value_is_completed_as_the_shell_holds_it(monkeypatch) -> None:
    for name, value in bash("nmatrix world --format=j").items():
        monkeypatch.setenv(name, value)
    assert answer("complete_bash").split() == ["json", "js"]  # bash holds --format= already
    for name, value in others("nmatrix world --format=j").items():
        monkeypatch.setenv(name, value)
    assert answer("complete_fish").split() == ["--format=json", "--format=js"]


def test_names_that_a_shell_would_part_are_escaped(monkeypatch, own_folder) -> None:
    scene = (
        '[[object]]\nname = "left arm"\nshape = "box"\n[[object]]\nname = "rig:Hips"\nshape = "box"'
    )
    Path("s.toml").write_text(scene)
    for typed, wanted in (("", [r"left\ arm", "rig:Hips"]), ("rig:H", ["Hips"])):
        for name, value in bash(f"nmatrix world --scene s.toml --object {typed}").items():
            monkeypatch.setenv(name, value)
        assert answer("complete_bash").splitlines() == wanted


def test_files_stand_beside_the_words_of_an_argument(own_folder) -> None:
    for name in ("shape.ply", "notes.txt", "shapes"):
        Path(name).mkdir() if name == "shapes" else Path(name).touch()
    assert [one.word for one in offers(["render"], "sha")] == ["shading", "shape.ply", "shapes/"]


def test_completion_loads_neither_numpy_nor_typer() -> None:
    done = subprocess.run(
        [sys.executable, "-X", "importtime", "-m", "nmatrix"],
        capture_output=True,
        text=True,
        check=False,
        env={
            **os.environ,
            "_NMATRIX_COMPLETE": "complete_bash",
            "COMP_WORDS": "nmatrix world --sc",
            "COMP_CWORD": "2",
        },
    )
    assert done.stdout.split() == ["--scale", "--scene"]
    assert "nmatrix.cli.completion" in done.stderr
    for heavy in ("numpy", "typer", "rich", "nmatrix.cli.matrices"):
        assert heavy not in done.stderr


def test_fish_is_told_whether_anything_is_there(monkeypatch) -> None:
    for line, code in (("nmatrix world --sc", 0), ("nmatrix normal ", 1)):
        monkeypatch.setenv("_TYPER_COMPLETE_ARGS", line)
        monkeypatch.setenv("_TYPER_COMPLETE_FISH_ACTION", "is-args")
        with pytest.raises(SystemExit) as left:
            answer("complete_fish")
        assert left.value.code == code


@pytest.fixture
def home(tmp_path, monkeypatch) -> Path:
    """A home folder with nmatrix on the path and nothing else."""
    program = tmp_path / "bin" / "nmatrix"
    program.parent.mkdir()
    program.write_text(f'#!/bin/sh\nPYTHONPATH="{ROOT}" exec "{sys.executable}" -m nmatrix "$@"\n')
    program.chmod(0o755)
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv("PATH", f"{program.parent}{os.pathsep}{os.environ['PATH']}")
    return tmp_path


ASK = {
    "bash": r"""source ~/.bashrc; COMP_LINE="nmatrix world --sc"; COMP_POINT=${#COMP_LINE}
COMP_WORDS=(nmatrix world --sc); COMP_CWORD=2; _nmatrix_completion nmatrix
printf '%s\n' "${COMPREPLY[@]}" """,
    "zsh": r"""autoload -Uz compinit; fpath+=~/.zfunc; compinit -u
words=(nmatrix world --sc); CURRENT=3
_arguments() { print -r -- "$@" }; autoload -Uz _nmatrix; _nmatrix""",
    "fish": "complete -C 'nmatrix world --sc'",
}


@pytest.mark.parametrize("shell", ASK)
def test_the_shell_itself_completes(shell: str, home: Path, nmatrix) -> None:
    if shutil.which(shell) is None:
        pytest.skip(f"{shell} is not on this machine")
    assert nmatrix(f"--install-completion {shell}").code == 0
    done = subprocess.run(
        [shell, "-c", ASK[shell]], capture_output=True, text=True, check=False, cwd=home
    )
    assert "--scale" in done.stdout, done.stderr
    assert "--scene" in done.stdout


def test_bash_is_syntactically_happy_and_installs_once(home: Path, nmatrix) -> None:
    for _ in range(2):
        assert nmatrix("--install-completion bash").code == 0
    assert (home / ".bashrc").read_text().count("nmatrix") == 1
    assert nmatrix("--show-completion bash").out == SHELLS["bash"].script


def test_an_autoloaded_script_of_zsh_answers_the_first_tab(home: Path, nmatrix) -> None:
    assert nmatrix("--install-completion zsh").code == 0
    script = (home / ".zfunc" / "_nmatrix").read_text()
    assert script.startswith("#compdef nmatrix\n")
    assert script.index("loadautofunc") < script.index('_nmatrix_completion "$@"')


@pytest.mark.parametrize("name", SHELLS)
def test_every_shell_asks_with_an_instruction_that_is_answered(name: str, monkeypatch) -> None:
    monkeypatch.setenv("_TYPER_COMPLETE_ARGS", "nmatrix wor")
    monkeypatch.delenv("_TYPER_COMPLETE_WORD_TO_COMPLETE", raising=False)
    for key, value in bash("nmatrix wor").items():
        monkeypatch.setenv(key, value)
    assert f"complete_{name}" in SHELLS[name].script
    assert "world" in answer(f"complete_{name}")


def test_an_unknown_shell_is_refused(nmatrix, monkeypatch) -> None:
    monkeypatch.setenv("SHELL", "/bin/tcsh")
    for line in ("--install-completion", "--show-completion csh"):
        found = nmatrix(line)
        assert (found.code, found.is_one_line) == (2, True)
        assert "bash, zsh, fish" in found.err


def test_the_table_is_json_with_every_command() -> None:
    assert set(json.loads(TABLE.read_text(encoding="utf-8"))) == {"", "help", *COMMANDS}
    assert run(["--version"]) == 0
