"""The contract of the command line: names, keys, exit codes, and one line for every mistake."""

from __future__ import annotations

import io
import os
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

from nmatrix.cli.catalogue import COMMANDS
from nmatrix.enums import FINDING_FORMATS, PARTICULAR_FORMATS, Format

DOCS = Path(__file__).resolve().parents[2] / "docs"

TRACE = "object world camera clip ndc window reciprocal_w inside outside_planes pixel normal"
RAY = "ray point_world point_object"
KEYS = {
    "world": "world_from_object normal_matrix cofactor_matrix determinant determinant_sign rank "
    "condition transform transform_exact mirrored needs_inverse_transpose worst_angle_without_deg "
    "parts steps",
    "view": "camera_from_world rotation translation eye right up forward normal_matrix handed "
    "mirrored readings world_from_camera extrinsics steps",
    "identify '1 2 3; 4 5 6; 7 8 10'": "readings ambiguous",
    "axes blender unity": "to_from mirrors unit_scale matrix parts winding_flips",
    "projection": "clip_from_camera handed clip_y depth_range near far left right bottom top "
    "fov_y_deg fov_x_deg aspect intrinsics readings depth_step depths steps",
    "normal --scale 1 2 1 --normal 1 1 0": "normal_matrix cofactor_matrix determinant "
    "determinant_sign rank condition transform transform_exact mirrored normals steps",
    "calc 1+1": "expression value kind to from space exact steps",
    "light": "spaces",
    "light camera": "space space_from_world direction direction_unnormalised "
    "direction_course_rule rules_differ_deg position",
    "eye camera": "space eye eye_by_inverse_mv relative_difference",
    "space object": "space space_from_world space_from_object normal_matrix clip_from_object "
    "light_direction light_position eye metric table uniforms cost pros cons vertex_shader "
    "fragment_shader",
    "trace": f"{TRACE} {RAY}",
    "trace --pixel 3 4 --depth-value 0.5": f"{TRACE} {RAY}",
    "derive mirror": "cases",
    "check eye '0 0 5'": "verdict mistake also explanation max_difference wrong_entries",
    "lint phong.vert": "findings spaces files",
    f"inspect {DOCS / 'samples' / 'gate.gltf'}": "files nodes summary",
    f"plan {DOCS / 'scenes' / 'mirror.toml'}": "effects attributes passes objects",
    "stress --case N1": "cases passed failed",
}
WITHOUT_FORMATS = {"derive", "check", "lint", "inspect", "plan", "stress"}  # sentences
LOOK_FOR_FAULTS = {"inspect", "lint"}
PARTS = (
    "translate quaternion rotate scale shear order convention axis angle_deg gimbal_lock unique "
    "given"
)
ELSEWHERE = {"render", "cost", "handout", "explore", "web"}  # what writes files or measures


def test_every_command_has_its_keys() -> None:
    assert {line.split()[0] for line in KEYS} | ELSEWHERE == set(COMMANDS)


@pytest.mark.parametrize("line", KEYS)
def test_json_has_exactly_the_keys_of_the_contract(nmatrix, line: str) -> None:
    found = nmatrix(f"{line} -f json")
    assert found.code == 0
    wanted = {*KEYS[line].split(), "command", "version", "layout", "remarks"}
    assert wanted <= set(found.data)
    assert set(found.data) - wanted <= {"used"}


@pytest.mark.parametrize("line", KEYS)
@pytest.mark.parametrize("format_", PARTICULAR_FORMATS)
def test_findings_and_scores_are_formats_of_what_has_some(nmatrix, line: str, format_: str) -> None:
    found = nmatrix(f"{line} -f {format_}")
    speakers = LOOK_FOR_FAULTS if format_ in FINDING_FORMATS else ("check",)
    if line.split()[0] in speakers:
        assert (found.code, found.err) == (0, "")
    else:
        assert (found.code, found.out) == (2, "")
        assert found.err.endswith("use --format json\n")


def test_the_parts_of_a_world_have_the_keys_of_the_contract(nmatrix) -> None:
    for line in ("world --scale 1 0 1", "world --world-matrix '0 -1 0; 2 0 0; 0 0 -1'"):
        assert list(nmatrix(f"{line} -f json").data["parts"]) == PARTS.split()


@pytest.mark.parametrize("line", [line for line in KEYS if line.split()[0] not in WITHOUT_FORMATS])
@pytest.mark.parametrize("format_", [one for one in Format if one not in PARTICULAR_FORMATS])
def test_every_format_of_every_command(nmatrix, line: str, format_: Format) -> None:
    found = nmatrix(f"{line} -f {format_}")
    assert found.code == 0, found.err
    assert found.out.endswith("\n")
    assert "nan" not in found.out.lower().split()
    if format_ is Format.TEXT:
        assert max(map(len, found.out.splitlines())) <= 80 or "shader" in found.out


@pytest.mark.parametrize(
    ("line", "code"),
    [
        ("world --scale 1 2", 2),
        ("world --scale 1 2 x", 2),
        ("world --scale 1e999 1 1", 2),
        ("world --scale nan 1 1", 2),
        ("world --scale 1 1 1 --scale 1 1 1", 2),
        ("world --rotate 0 0 0 --quaternion 0 0 0 1", 2),
        ("world --quaternion 0 0 0 0", 3),
        ("world --quaternion 0 0 0 1 --order XYZ", 2),
        ("world --order XYx", 2),
        ("world --order ZYX --convention polimi", 2),
        ("world --digits 99", 2),
        ("world --format pdf", 2),
        ("world --wolrd", 2),
        ("wrold", 2),
        ("view --eye 0 0 0", 3),
        ("view --elevation 10 --handed left", 2),
        ("view --elevation 10 --target 1 2 3", 2),
        ("projection --fov 180", 2),
        ("projection --near 5 --far 5", 3),
        ("projection --near 5 --far 1", 2),
        ("projection --ortho 1 1 0 1", 3),
        ("projection --ortho 0 1 0 1 --fov 3", 2),
        ("light object --scale 1 0 1", 3),
        ("light --light-direction 0 0 0", 3),
        ("space custom", 2),
        ("space nowhere", 2),
        ("normal", 2),
        ("normal '1 0; 0 1'", 2),
        ("normal no-such-file", 2),
        ("normal '1 0 0; 0 1 0; 0 0 1' --scale 1 1 1", 2),
        ("normal --scale 1 0 1 --normal 1 0 0", 3),
        ("normal --scale 1 0 0", 3),
        ("normal --scale 1 0 1", 0),
        ("world --scale 1 0 1", 0),
        ("trace --viewport 0 5", 2),
        ("trace --viewport 10.5 5", 2),
        ("calc M.__class__", 2),
        ("calc 'inverse(M)' --scale 1 0 1", 3),
        ("calc 9**9**9**9", 2),
        ("derive nothing", 2),
        ("inspect no-such.glb", 2),
        ("lint no-such.vert", 2),
        ("lint phong.vert", 0),
        ("lint phong.vert --fail-on warning", 1),
        ("lint phong.vert phong.frag", 1),
        ("lint phong.vert --fail-on note", 2),
        ("lint - -", 2),
        ("render nothing", 2),
        ("render --size 0 0", 2),
        ("render --size 100000 100000", 2),
        ("render -o /no/such/folder/x.png --size 8 8", 2),
        ("", 2),
    ],
)
def test_exit_codes(nmatrix, line: str, code: int) -> None:
    found = nmatrix(line)
    assert found.code == code, found.err
    if code and line:
        assert found.is_one_line, found.err


def test_too_few_values_name_the_next_option(nmatrix) -> None:
    found = nmatrix("world --translate 1 2 --scale 1 1 1")
    assert found.err == "error: --translate takes 3 numbers, got 2 before --scale\n"


@pytest.mark.parametrize(
    "vector",
    [
        "--translate -3 0 -1.5",
        "--translate '-3 0 -1.5'",
        "--translate=-3,0,-1.5",
        "--translate −3 0 −3/2",
    ],
)
def test_a_vector_in_every_notation(nmatrix, vector: str) -> None:
    found = nmatrix(f"world {vector} -f json").data
    assert [row[3] for row in found["world_from_object"]] == [-3.0, 0.0, -1.5, 1.0]


def test_a_matrix_that_begins_with_a_minus(nmatrix) -> None:
    assert nmatrix("normal '-1 0 0; 0 1 0; 0 0 1' -f json").data["mirrored"] is True


def test_a_column_major_matrix_is_recognised(nmatrix) -> None:
    text = "1 0 0 0; 0 1 0 0; 0 0 1 0; 5 6 7 1"
    found = nmatrix(f"world --world-matrix '{text}'")
    assert found.code == 2
    assert "this looks column-major or row-vector: --input-layout column-major" in found.err
    good = nmatrix(f"world --world-matrix '{text}' --input-layout column-major -f json")
    assert [row[3] for row in good.data["world_from_object"]] == [5.0, 6.0, 7.0, 1.0]


@pytest.mark.parametrize("format_", ["json", "csv", "numpy", "glsl", "latex"])
def test_what_is_written_is_read_again(nmatrix, tmp_path: Path, format_: str) -> None:
    line = "world --rotate 10 20 30 --scale 1 2 1/3 --digits 17"
    first = nmatrix(f"{line} -f json").data["world_from_object"]
    file = tmp_path / "m.txt"
    file.write_text(nmatrix(f"{line} -f {format_}").out)
    again = nmatrix(f"world --world-matrix {file} -f json").data
    assert again["world_from_object"] == first


def test_a_determinant_beyond_every_float_is_null_with_its_sign(nmatrix) -> None:
    found = nmatrix("world --scale 1e200 1e200 1e200 -f json").data
    assert found["determinant"] is None
    assert found["determinant_sign"] == 1
    assert any("determinant" in remark for remark in found["remarks"])
    assert "1e+600" in nmatrix("world --scale 1e200 1e200 1e200 --full").out


def test_quarter_turns_are_exact_and_zero_has_no_sign(nmatrix) -> None:
    found = nmatrix("world --rotate 0 0 90 -f json")
    assert found.data["world_from_object"][0] == [0.0, -1.0, 0.0, 0.0]
    assert "-0.0" not in found.out


def test_the_course_slide_prints_its_numbers(nmatrix) -> None:
    line = "view --eye 3 3 2.5 --elevation -45 --angle -40 --convention polimi"
    first = nmatrix(f"{line} -f json").data["camera_from_world"][0]
    assert [round(x, 6) for x in first] == [0.766044, 0.0, -0.642788, -0.691164]


def test_the_object_space_light_of_the_counter_example(nmatrix) -> None:
    found = nmatrix(
        "light object --scale 1 1/4 1 --light-direction .3 .9 .2 -f json",
    ).data
    n = (0.5**0.5, 0.5**0.5, 0.0)
    dot = [
        sum(a * b for a, b in zip(n, found[key], strict=True))
        for key in ("direction_course_rule", "direction")
    ]
    assert [round(x, 4) for x in dot] == [0.8735, 0.7622]


def test_help_begins_with_examples_and_lists_every_command(nmatrix) -> None:
    overview = nmatrix("--help").out
    for name, one in COMMANDS.items():
        assert f"  {name} " in overview
        assert one.sentence in overview
        page = nmatrix(f"{name} --help").out
        assert f"nmatrix {name}" in page.split("Options")[0], name
        assert one.sentence in page, name


def test_version(nmatrix) -> None:
    assert nmatrix("--version").out == "nmatrix 0.1.0\n"


def loaded(line: str) -> set[str]:
    code = (
        "import sys; from nmatrix.cli.app import run; code = run(sys.argv[1:]);"
        "heavy = ('numpy', 'sympy', 'rich', 'matplotlib', 'nmatrix.formula');"
        "sys.stderr.write('LOADED ' + ' '.join(m for m in heavy if m in sys.modules))"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, *shlex.split(line)],
        capture_output=True,
        text=True,
        check=False,
    )
    return set(done.stderr.partition("LOADED")[2].split())


@pytest.mark.parametrize(
    ("line", "allowed"),
    [
        ("--help", set()),
        ("world --scale 1 2 1", set()),
        ("world -f json", set()),
        ("derive", {"sympy"}),
        ("calc 'det(M)'", set()),
    ],
)
def test_commands_load_only_what_they_use(line: str, allowed: set[str]) -> None:
    assert loaded(line) <= allowed


def test_a_closed_pipe_is_no_error() -> None:
    done = subprocess.run(
        f"{sys.executable} -m nmatrix space object -f json | head -c 1; exit ${{PIPESTATUS[0]}}",
        shell=True,
        executable="/bin/bash",
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0
    assert done.stderr == ""


def test_stdout_that_knows_only_ascii_gets_plain_brackets() -> None:
    done = subprocess.run(
        [sys.executable, "-m", "nmatrix", "world"],
        capture_output=True,
        check=True,
        env={**os.environ, "PYTHONIOENCODING": "ascii"},
    )
    assert b"?" not in done.stdout
    assert b"[" in done.stdout


def test_completion_offers_commands_without_loading_numpy() -> None:
    done = subprocess.run(
        [sys.executable, "-X", "importtime", "-m", "nmatrix"],
        capture_output=True,
        text=True,
        check=False,
        env={
            **os.environ,
            "_NMATRIX_COMPLETE": "complete_bash",
            "COMP_WORDS": "nmatrix wor",
            "COMP_CWORD": "1",
        },
    )
    assert "world" in done.stdout
    assert "numpy" not in done.stderr


def test_render_writes_a_picture_once(nmatrix, tmp_path: Path) -> None:
    target = str(tmp_path / "a.png")
    line = f"render normals --size 48 48 -o {target} -f json"
    found = nmatrix(line)
    assert found.code == 0
    assert found.data["max_angle_error_deg"] == pytest.approx(36.87, abs=0.2)
    assert Path(target).read_bytes().startswith(b"\x89PNG")
    again = nmatrix(line)
    assert again.code == 2
    assert "--force" in again.err
    assert [one.name for one in tmp_path.iterdir()] == ["a.png"]


def test_standard_input_is_read_once_and_by_key(nmatrix, monkeypatch) -> None:
    import io

    text = nmatrix("view --eye 1 2 3 -f json").out
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(text.encode())))
    found = nmatrix("calc 'translation(M)' --world-matrix '-#translation' -f json")
    assert found.data["value"] == [-1.0, -2.0, -3.0]
    twice = nmatrix("normal - --view-matrix -")
    assert twice.code == 2
    assert "once" in twice.err or "empty" in twice.err


def test_fail_on_ends_in_one(nmatrix, tmp_path: Path) -> None:
    file = tmp_path / "m.gltf"
    file.write_text('{"asset": {"version": "2.0"}, "nodes": [{"name": "m", "scale": [-1, 1, 1]}]}')
    found = nmatrix(f"inspect {file} --fail-on mirrored -f json")
    assert found.code == 1
    assert found.data["summary"]["mirrored"] == 1
    assert found.err.startswith("error: --fail-on mirrored: 1 of 1 node is mirrored (m)")
    assert nmatrix(f"inspect {file} --fail-on shear").code == 0


@pytest.mark.parametrize(
    ("matrix", "null"),
    [
        ("1.7e308 0 0; 1.7e308 1 0; 1.7e308 0 1", ("scale", 0)),
        ("1e-200 1e150 0; 0 1 0; 0 0 1", ("shear", 0)),
    ],
)
def test_a_part_beyond_every_float_is_null_alone(nmatrix, matrix: str, null: tuple) -> None:
    part, place = null
    found = nmatrix(f"world --world-matrix '{matrix}' -f json")
    assert found.code == 0, found.err
    parts = found.data["parts"]
    assert parts[part][place] is None
    lists = [value for value in parts.values() if isinstance(value, list)]
    assert sum(entry is None for entries in lists for entry in entries) == 1
    assert any(f"parts.{part}.{place} is" in remark for remark in found.data["remarks"])


def test_a_built_entry_beyond_every_float_is_null_and_shown_in_text(nmatrix) -> None:
    line = "world --scale 1e308 1e308 1 --shear 10 0 0"
    found = nmatrix(f"{line} -f json")
    assert found.code == 0, found.err
    assert found.data["world_from_object"][0] == [1e308, None, 0.0, 0.0]
    assert any("world_from_object.0.1" in remark for remark in found.data["remarks"])
    assert found.data["determinant_sign"] == 1
    assert found.data["parts"]["shear"] == [10.0, 0.0, 0.0]
    assert "1e+309" in nmatrix(line).out
    assert nmatrix("world --scale 1e309 1 1").code == 2


def test_the_rank_of_a_matrix_of_roots_is_exact_and_of_other_irrationals_refused(nmatrix) -> None:
    line = "calc 'rank(rotate_x({0}).T @ rotate_x({0}) - identity(4))' -f json"
    assert nmatrix(line.format(30)).data["exact"] == "0"
    found = nmatrix(line.format(20))
    assert found.code == 3
    assert found.is_one_line
    assert nmatrix("calc 'rank(rotate_x(90))' -f json").data["exact"] == "4"


def test_no_arguments_show_the_help(nmatrix) -> None:
    found = nmatrix("")
    assert found.code == 2
    assert "nmatrix world --scale 1 2 1" in found.out
    assert found.err == ""


@pytest.mark.parametrize("order", ["XYZ", "ZYX"])
def test_a_course_convention_takes_no_order_not_even_the_default(nmatrix, order: str) -> None:
    found = nmatrix(f"world --convention polimi --order {order}")
    assert found.code == 2
    assert found.is_one_line


@pytest.mark.parametrize(
    ("command", "expected"),
    [
        ("world --rotate 0 0 20", "to the digits shown: --format json has all of them"),
        ("world --rotate 0 0 30 --numbers exact", ""),
        ("view", ""),
        ("space", ""),
    ],
)
@pytest.mark.parametrize("encoding", ["utf-8", "ascii"])
def test_a_text_report_in_the_pipe_is_read_and_told_to_be_rounded_where_it_is(
    nmatrix, monkeypatch, command: str, expected: str, encoding: str
) -> None:
    monkeypatch.setattr(sys, "stdin", piped_from(command, encoding))
    found = nmatrix("normal - -f json")
    assert found.code == 0
    told = " ".join(found.data["remarks"])
    assert expected in told
    assert ("digits shown" in told) is bool(expected)


@pytest.mark.parametrize("command", ["eye", "stress --case N1"])
@pytest.mark.parametrize("encoding", ["utf-8", "ascii"])
def test_a_text_report_without_a_matrix_in_the_pipe_gets_a_hint(
    nmatrix, monkeypatch, command: str, encoding: str
) -> None:
    monkeypatch.setattr(sys, "stdin", piped_from(command, encoding))
    found = nmatrix("normal -")
    assert found.code == 2
    assert "add -f json to the command before the pipe" in found.err


def piped_from(command: str, encoding: str) -> io.TextIOWrapper:
    done = subprocess.run(
        [sys.executable, "-m", "nmatrix", *command.split()],
        capture_output=True,
        check=False,
        env={**os.environ, "PYTHONIOENCODING": encoding},
    )
    return io.TextIOWrapper(io.BytesIO(done.stdout))


def test_inspect_says_that_a_file_does_not_exist_and_what_it_reads(nmatrix, tmp_path: Path) -> None:
    assert nmatrix("inspect nofile").err == (
        "error: file (nofile): it does not exist; give a .gltf, .glb, .obj, .ply or .stl file, "
        "a folder, or - for standard input\n"
    )
    empty = nmatrix(f"inspect {tmp_path}")
    assert empty.code == 2
    assert "it holds no .gltf, .glb, .obj, .ply or .stl file" in empty.err
