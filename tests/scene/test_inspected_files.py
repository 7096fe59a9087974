"""`inspect` of folders, pipes and thousands of nodes: nothing is lost, each is told by its path."""

from __future__ import annotations

import csv
import io
import json
import shlex
import sys
from itertools import pairwise
from pathlib import Path
from struct import pack

import pytest

from nmatrix.answers.inspect.file import inspect_file
from nmatrix.answers.inspect.flaws import FLAWS
from nmatrix.answers.inspect.records import COLUMNS
from nmatrix.answers.inspect.report import SHOWN, Chosen, report
from nmatrix.enums import Flaw, NodeOrder, Severity
from nmatrix.scene.words import GLTF_SUFFIXES, MESH_SUFFIXES

MIRROR, STRETCH = {"scale": [-1, 1, 1]}, {"scale": [1, 2, 1]}
TURN = {"rotation": [0, 0, 0.6, 0.8]}
TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\n"
ASCII_STL = "solid a\nfacet normal 0 0 1\nouter loop\n{}endloop\nendfacet\nendsolid a\n".format(
    "".join(f"vertex {x} {y} 0\n" for x, y in ((0, 0), (1, 0), (0, 1)))
)
PLY = (
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
    "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"
)
CORNERS = (0, 0, 0, 1, 0, 0, 0, 1, 0)
ODD_NAMES = [
    "Cube",
    "Cube",
    "a/b",
    "",
    "line\nend",
    "\x1b[31mred",
    "‮right to left",
    "élan ✓ 木",
    "=1+1",
    "-rf",
    "@sum",
    "+",
    "#3",
    "x" * 10_000,
    " ",
    "100%, a:b",
]


def gltf(*nodes: dict[str, object]) -> str:
    return json.dumps({"asset": {"version": "2.0"}, "nodes": list(nodes)})


def glb(*nodes: dict[str, object]) -> bytes:
    text = gltf(*nodes).encode()
    text += b" " * (-len(text) % 4)
    return b"glTF" + pack("<5I", 2, 20 + len(text), len(text), 0x4E4F534A, 0)[:16] + text


def lined(names: list[str], **more: object) -> list[dict[str, object]]:
    """Nodes that stand beside one another."""
    return [{"name": name, **more} for name in names]


@pytest.fixture
def assets(tmp_path: Path, monkeypatch) -> Path:
    """Work in a folder of two good scenes, a mesh, two bad files and much that is none."""
    folder = tmp_path / "assets"
    (folder / "deep" / "deeper").mkdir(parents=True)
    (folder / ".hidden").mkdir()
    (folder / "b.gltf").write_text(gltf({"name": "m", **MIRROR}, {"name": "p"}))
    (folder / "deep" / "deeper" / "a.GLTF").write_text(gltf({"name": "s", **STRETCH}))
    (folder / "deep" / "triangle.obj").write_text(TRIANGLE)
    (folder / "bad.gltf").write_text("{")
    (folder / "deep" / "empty.ply").write_text("")
    (folder / "nothing.gltf").write_text(gltf())
    (folder / ".hidden" / "c.gltf").write_text("{")
    (folder / ".also.gltf").write_text("{")
    (folder / "notes.txt").write_text("no mesh")
    (folder / "deep" / "up").symlink_to(folder)  # a circle
    monkeypatch.chdir(tmp_path)
    return folder


FILES = [
    "assets/b.gltf",
    "assets/bad.gltf",
    "assets/nothing.gltf",
    "assets/deep/empty.ply",
    "assets/deep/triangle.obj",
    "assets/deep/deeper/a.GLTF",
]


def test_a_folder_is_searched_in_the_order_of_names(assets: Path, nmatrix) -> None:
    found = nmatrix("inspect assets -f json")
    assert found.code == 0
    assert [one["file"] for one in found.data["files"]] == FILES
    bad = {one["file"] for one in found.data["files"] if one["error"]}
    assert bad == {"assets/bad.gltf", "assets/deep/empty.ply"}
    assert {node["file"] for node in found.data["nodes"]} == {FILES[0], *FILES[4:]}
    summary = found.data["summary"]
    assert (summary["files"], summary["unreadable_files"], summary["nodes"]) == (6, 2, 4)
    assert any("Without any node: assets/nothing.gltf" in one for one in found.data["remarks"])


def test_a_file_that_is_named_twice_is_inspected_once(assets: Path, nmatrix) -> None:
    line = f"inspect assets/b.gltf assets ./assets/../assets/b.gltf {assets}/b.gltf -f json"
    assert [one["file"] for one in nmatrix(line).data["files"]] == FILES


def test_an_unreadable_file_is_a_row_in_every_format(assets: Path, nmatrix) -> None:
    text = nmatrix("inspect assets").out
    assert "bad.gltf" in text and "Could not be read" in text and "it is empty" in text
    rows = list(csv.DictReader(io.StringIO(nmatrix("inspect assets -f csv").out)))
    assert [row["file"] for row in rows if row["error"]] == [FILES[1], FILES[3]]
    for format_, words in (("sarif", "NM-A06"), ("github", "::error file=assets/bad.gltf,title")):
        assert words in nmatrix(f"inspect assets -f {format_}").out


@pytest.mark.parametrize(
    ("line", "code", "words"),
    [
        ("assets", 0, ""),
        ("assets --fail-on shear", 0, ""),
        ("assets --fail-on unreadable", 1, "2 of 6 files were not read (assets/bad.gltf, assets"),
        ("assets --fail-on mirrored", 1, "1 of 4 nodes is mirrored (assets/b.gltf: m)"),
        ("assets --fail-on non-uniform", 1, "1 of 4 nodes is non-uniform (assets/deep/deeper/a.GL"),
        ("assets/bad.gltf", 2, "assets/bad.gltf: it is not glTF"),
        ("assets/bad.gltf --fail-on unreadable", 1, "1 of 1 file was not read (assets/bad.gltf)"),
        ("assets/bad.gltf assets/deep/empty.ply", 2, "2 files: none of them could be read"),
        ("assets/bad.gltf assets/deep/empty.ply --fail-on unreadable", 1, "2 of 2 files"),
        ("assets/nothing.gltf --fail-on unreadable", 0, ""),
        ("assets/none.gltf assets", 2, "file (assets/none.gltf): it does not exist"),
        ("assets/.hidden/..", 0, ""),
        ("assets/notes.txt", 2, "meshes are .obj, .ply or .stl"),
        ("- -", 2, "it can be read only once"),
        ("assets --only shaer", 2, "did you mean shear?"),
        ("assets --fail-on mirrored,nothing", 2, "it takes words with commas between them"),
        ("assets --sort angel", 2, "did you mean angle?"),
    ],
)
def test_exit_codes(assets: Path, nmatrix, line: str, code: int, words: str) -> None:
    found = nmatrix(f"inspect {line}")
    assert found.code == code, found.err
    assert words in found.err
    assert not code or found.is_one_line


def test_what_was_not_read_was_not_checked_and_that_is_said(assets: Path, nmatrix) -> None:
    remarks = nmatrix("inspect assets --fail-on shear -f json").data["remarks"]
    assert any("2 of 6 files were not read and so not checked" in one for one in remarks)
    assert not any(
        "not checked" in one for one in nmatrix("inspect assets -f json").data["remarks"]
    )


@pytest.mark.parametrize(
    ("content", "node"),
    [
        (gltf({"name": "m"}), "m"),
        ("\ufeff" + gltf({"name": "m"}), "m"),
        (glb({"name": "m"}), "m"),
        (TRIANGLE, "standard-input"),
        ("# by hand\n" + TRIANGLE, "standard-input"),
        (PLY, "standard-input"),
        (ASCII_STL, "standard-input"),
        (bytes(80) + b"\1\0\0\0" + pack("<12f", *[0, 0, 1, *CORNERS]) + bytes(2), "standard-input"),
    ],
)
def test_standard_input_is_known_by_its_content(
    nmatrix, monkeypatch, content: str | bytes, node: str
) -> None:
    given = content if isinstance(content, bytes) else content.encode()
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(given)))
    found = nmatrix("inspect - -f json")
    assert found.code == 0, found.err
    assert found.data["files"] == [{"file": "-", "error": None}]
    assert [one["path"] for one in found.data["nodes"]] == [node]


@pytest.mark.parametrize("content", ["", " \n", "no mesh", "\x00\x01"])
def test_standard_input_of_another_kind_is_refused(nmatrix, monkeypatch, content: str) -> None:
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(content.encode())))
    found = nmatrix("inspect -")
    assert found.code == 2
    assert found.is_one_line
    assert "standard input" in found.err


def test_csv_has_one_row_a_node_and_the_scalar_keys_of_json(assets: Path, nmatrix) -> None:
    nodes = nmatrix("inspect assets -f json").data["nodes"]
    rows = list(csv.reader(io.StringIO(nmatrix("inspect assets -f csv").out)))
    header, *rows = rows
    assert tuple(header) == COLUMNS
    assert {len(row) for row in rows} == {len(header)}
    read = [dict(zip(header, row, strict=True)) for row in rows]
    read = [row for row in read if not row["error"]]
    for node, row in zip(nodes, read, strict=True):
        for key in set(node) & set(header):
            value = node[key]
            if isinstance(value, list):
                value = " ".join(value)
            assert row[key] == ("" if value is None else json.dumps(value).strip('"')), key
        for key, size in (("normal_matrix", 3), ("world_from_object", 4)):
            cells = [[float(row[f"{key}_{i}_{j}"]) for j in range(size)] for i in range(size)]
            assert cells == node[key]


def test_no_cell_of_text_is_run_by_a_spreadsheet(tmp_path: Path, nmatrix) -> None:
    (tmp_path / "odd.gltf").write_text(gltf(*lined(ODD_NAMES, **MIRROR)))
    out = nmatrix(f"inspect {tmp_path / 'odd.gltf'} -f csv").out
    for row in csv.DictReader(io.StringIO(out)):
        for key in ("path", "name", "object", "file"):
            assert not row[key].startswith(("=", "+", "-", "@", "\t", "\r")), row[key]


def test_odd_names_are_told_apart_and_never_break_a_line(tmp_path: Path, nmatrix) -> None:
    file = tmp_path / "odd.gltf"
    nodes = lined(ODD_NAMES, **MIRROR)
    nodes[2]["children"] = [len(nodes)]
    parent = {"name": "a", "children": [len(nodes) + 2]}  # a/b, as another node is called
    file.write_text(gltf(*nodes, {"name": "b"}, parent, {"name": "b", **STRETCH}))
    found = nmatrix(f"inspect {file} -f json").data["nodes"]
    assert [node["index"] for node in found] == list(range(len(nodes) + 3))
    objects = [node["object"] for node in found]
    assert len(set(objects)) == len(objects)
    for node in found:
        again = nmatrix(f"world --scene {file} -f json --object={shlex.quote(node['object'])}")
        assert again.code == 0, again.err
        assert again.data["world_from_object"] == node["world_from_object"]
    for line in ("", "--all", "--only mirrored --all", "--fail-on mirrored", "-f github"):
        answer = nmatrix(f"inspect {file} {line}")
        shown = answer.out + answer.err
        assert not any("\x1b" in one or "‮" in one or "\r" in one for one in shown)
        if "github" not in line:
            assert max(map(len, answer.out.splitlines())) <= 80
    assert len(nmatrix(f"inspect {file} -f github").out.splitlines()) == len(ODD_NAMES) + 2


def test_of_thousands_the_worst_are_shown_and_the_others_counted(tmp_path: Path, nmatrix) -> None:
    nodes = lined(["Cube"] * 3000)
    for index in range(100, 3000, 100):
        nodes[index] |= STRETCH
    nodes[2999] |= MIRROR
    file = tmp_path / "many.gltf"
    file.write_text(gltf(*nodes))
    found = nmatrix(f"inspect {file} --fail-on non-uniform")
    lines = found.out.splitlines()
    assert len(lines) <= 22
    assert (
        "29 of 3,000 nodes need the inverse transpose. Found: 1 mirrored, 29 non-uniform."
        in found.out
    )
    assert lines[7].split()[:3] == ["100", "Cube", "non-uniform"]
    assert f"{30 - SHOWN} more rows: --all shows them." in found.out
    assert (
        "29 of 3,000 nodes are non-uniform (Cube (#100), Cube (#200), Cube (#300), Cube (#400), "
        "Cube (#500) and 24 more)"
    ) in found.err
    every = nmatrix(f"inspect {file} --all").out
    assert sum(line.split()[1:2] == ["Cube"] for line in every.splitlines()) == 3000
    assert len(nmatrix(f"inspect {file} -f json").data["nodes"]) == 3000


def test_everyday_output_fits_a_screen(nmatrix) -> None:
    sample = Path(__file__).resolve().parents[2] / "docs" / "samples" / "gate.gltf"
    assert len(nmatrix(f"inspect {sample}").out.splitlines()) <= 22


def flawed_file(folder: Path):
    """One node of each kind, and one of none."""
    path = folder / "kinds.gltf"
    sheared = {"name": "stretched", **STRETCH, "children": [1]}, {"name": "turned", **TURN}
    flat = {"name": "flat", "scale": [1, 0, 1]}
    path.write_text(gltf(*sheared, {"name": "m", **MIRROR}, flat, {"name": "plain"}))
    return inspect_file(path)


OF_EACH = {
    Flaw.SHEAR: ["stretched/turned"],
    Flaw.SINGULAR: ["flat"],
    Flaw.MIRRORED: ["m"],
    Flaw.DEGENERATE: [],
    Flaw.NON_UNIFORM_SCALE: ["stretched"],
    Flaw.UNREADABLE: [],
}


@pytest.mark.parametrize("flaw", Flaw)
def test_only_and_fail_on_know_the_same_words(tmp_path: Path, flaw: Flaw) -> None:
    told = report((flawed_file(tmp_path),), Chosen(only=(flaw,), fail_on=(flaw,)))
    assert [node["path"] for node in told.data["nodes"]] == OF_EACH[flaw]
    assert (told.failure is not None) == bool(OF_EACH[flaw])
    assert told.data["summary"]["nodes"] == 5
    found = told.findings.found
    assert [one.place for one in found] == OF_EACH[flaw]
    assert {one.severity for one in found} <= {Severity.ERROR}
    assert {one.rule for one in found} <= {FLAWS[flaw].rule}


@pytest.mark.parametrize(
    ("order", "right"),
    [
        (NodeOrder.KIND, ["flat", "stretched/turned", "stretched", "m", "plain"]),
        (NodeOrder.INDEX, ["stretched", "stretched/turned", "m", "flat", "plain"]),
        (NodeOrder.PATH, ["flat", "m", "plain", "stretched", "stretched/turned"]),
        (NodeOrder.ANGLE, ["flat", "stretched", "stretched/turned", "m", "plain"]),
        (NodeOrder.MESH, ["stretched", "stretched/turned", "m", "flat", "plain"]),
    ],
)
def test_rows_are_sorted_by_what_was_asked_for(
    tmp_path: Path, order: NodeOrder, right: list[str]
) -> None:
    told = report((flawed_file(tmp_path),), Chosen(order=order))
    paths = [node["path"] for node in told.data["nodes"]]
    assert sorted(paths) == sorted(right)
    if order is NodeOrder.ANGLE:  # two maps of one angle may differ in its last bit
        angles = [node["worst_angle_without_deg"] for node in told.data["nodes"]]
        assert all(a >= b for a, b in pairwise(angles))
    else:
        assert paths == right


def test_every_word_of_an_order_is_tried_above() -> None:
    (mark,) = test_rows_are_sorted_by_what_was_asked_for.pytestmark
    assert {order for order, _ in mark.args[1]} == set(NodeOrder)


@pytest.mark.parametrize(
    ("nodes", "sentence"),
    [
        ([{}], "0 of 1 node needs the inverse transpose."),
        ([STRETCH], "1 of 1 node needs the inverse transpose. Found: 1 non-uniform."),
        ([{}, {}], "None of 2 nodes needs the inverse transpose."),
        ([{}, STRETCH], "1 of 2 nodes needs the inverse transpose. Found: 1 non-uniform."),
        ([STRETCH] * 2, "2 of 2 nodes need the inverse transpose. Found: 2 non-uniform."),
        ([MIRROR, {}], "None of 2 nodes needs the inverse transpose. Found: 1 mirrored."),
        (
            [{"scale": [0, 1, 1]}, {}],
            "None of 2 nodes needs the inverse transpose. Found: 1 singular.",
        ),
    ],
)
def test_the_summary_is_a_right_sentence_for_every_count(
    tmp_path: Path, nodes: list[dict[str, object]], sentence: str
) -> None:
    path = tmp_path / "a.gltf"
    path.write_text(gltf(*nodes))
    assert report((inspect_file(path),)).data["summary"]["sentence"] == sentence


def test_a_matrix_that_is_no_product_of_parts_is_sheared_by_itself(tmp_path: Path, nmatrix) -> None:
    skew = [1, 0, 0, 0, 0.5, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
    file = tmp_path / "a.gltf"
    file.write_text(gltf({"name": "skew", "matrix": skew}))
    found = nmatrix(f"inspect {file}").out
    assert "sheared by itself" in found
    assert "NODE_MATRIX_NON_TRS" in found


def test_nodes_outside_the_scene_are_judged_and_marked(tmp_path: Path, nmatrix) -> None:
    file = tmp_path / "a.gltf"
    document = json.loads(gltf({"name": "in"}, {"name": "out", **MIRROR}))
    file.write_text(json.dumps({**document, "scene": 0, "scenes": [{"nodes": [0]}]}))
    assert "mirrored, outside the scene" in nmatrix(f"inspect {file}").out
    found = nmatrix(f"inspect {file} -f json").data
    assert [node["in_scene"] for node in found["nodes"]] == [True, False]
    assert found["summary"]["outside_scene"] == 1


def test_every_ending_that_is_read_is_searched_for(tmp_path: Path, nmatrix) -> None:
    for ending in (*GLTF_SUFFIXES, *MESH_SUFFIXES):
        (tmp_path / f"a{ending}").write_text("")
    found = nmatrix(f"inspect {tmp_path} -f json")
    assert len(found.data["files"]) == len((*GLTF_SUFFIXES, *MESH_SUFFIXES))
    assert found.code == 2


def sarif(nmatrix, line: str) -> list[dict]:
    return json.loads(nmatrix(f"inspect {line} -f sarif").out)["runs"][0]["results"]


@pytest.mark.parametrize(
    ("name", "content", "line"),
    [
        ("a.obj", "v 0 0 0\nv 0 x 0\n", 2),
        ("a.ply", "ply\nformat ascii 1.0\nelement vertex q\nend_header\n", 3),
        ("a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 line\nvertex 1 0 0\n"
         "vertex 0 1 0\nendloop\nendfacet\n", 4),
        ("a.gltf", '{"asset": {"version": "2.0"},\n"nodes": [}', 2),
        ("a.gltf", '{"asset": {"version": "line 7"}}', 0),
        ("a.glb", "", 0),
    ],
)  # fmt: skip
def test_the_line_of_an_error_is_where_hosts_look_for_it(
    own_folder, nmatrix, name: str, content: str, line: int
) -> None:
    """And the one file that there is, unreadable, is a finding and a row as any other."""
    Path(name).write_text(content)
    (found,) = sarif(nmatrix, name)
    (place,) = found["locations"]
    assert found["ruleId"] == "NM-A06"
    assert place["physicalLocation"].get("region", {}).get("startLine", 0) == line
    told = nmatrix(f"inspect {name} -f github")
    assert told.code == 2 and told.is_one_line
    assert told.out.startswith(
        f"::error file={name}," + (f"line={line},title" if line else "title")
    )
    (row,) = csv.DictReader(io.StringIO(nmatrix(f"inspect {name} -f csv").out))
    assert row["file"] == name and row["rules"] == "NM-A06"
    for reason in (row["error"], found["message"]["text"], told.out.split("::")[-1]):
        assert reason and not reason.startswith((",", ":", " "))
    assert nmatrix(f"inspect {name} -f json").data["files"][0]["error"] == row["error"]
    assert nmatrix(f"inspect {name}").out == ""


def test_nodes_of_one_path_are_told_apart_everywhere(own_folder, nmatrix) -> None:
    twins = lined(["wheel", "wheel"], **MIRROR)
    Path("cart.gltf").write_text(gltf({"name": "cart", "children": [1, 2]}, *twins))
    found = sarif(nmatrix, "cart.gltf")
    assert len({one["partialFingerprints"]["primaryLocationLineHash"] for one in found}) == 2
    assert len({one["message"]["text"] for one in found}) == 2
    assert len(set(nmatrix("inspect cart.gltf -f github").out.splitlines())) == 2
    err = nmatrix("inspect cart.gltf --fail-on mirrored").err
    assert "(cart/wheel (#1), cart/wheel (#2))" in err


def test_machines_read_what_people_see(own_folder, nmatrix) -> None:
    Path("a.gltf").write_text(gltf({"name": "a", "scale": [-1, 2, 1]}, {"name": "b"}))
    first, second = nmatrix("inspect a.gltf -f json").data["nodes"]
    assert (first["found"], first["rules"]) == ("mirrored and non-uniform", ["NM-A02", "NM-A05"])
    assert (second["found"], second["rules"], second["error"]) == ("identity", [], None)
    row, _ = csv.DictReader(io.StringIO(nmatrix("inspect a.gltf -f csv").out))
    assert (row["found"], row["rules"]) == ("mirrored and non-uniform", "NM-A02 NM-A05")


@pytest.mark.parametrize("flaw", Flaw)
def test_remarks_are_of_the_flaws_that_were_asked_for(tmp_path: Path, flaw: Flaw) -> None:
    words = {
        Flaw.SHEAR: "Sheared by ancestors",
        Flaw.MIRRORED: "Mirrored nodes",
        Flaw.SINGULAR: "Singular nodes",
    }
    told = " ".join(report((flawed_file(tmp_path),), Chosen(only=(flaw,))).remarks)
    assert [one for one, word in words.items() if word in told] == [flaw] * (flaw in words)


def test_the_order_is_by_what_can_be_seen(own_folder, nmatrix) -> None:
    """A shear of a thousandth of a degree weighs less than a mirror, and that less than 15°."""
    hardly = {"name": "above", "scale": [1, 1.00002, 1], "children": [1]}
    nodes = [hardly, {"name": "hardly", **TURN}, {"name": "mirror", **MIRROR}]
    Path("a.gltf").write_text(gltf(*nodes, {"name": "clearly", "scale": [1, 1.3, 1]}))
    found = nmatrix("inspect a.gltf --sort kind -f json").data["nodes"]
    assert [one["name"] for one in found] == ["clearly", "mirror", "hardly", "above"]
    assert nmatrix("inspect a.gltf --tolerance 1e-4 --fail-on shear").code == 0
    assert nmatrix("inspect a.gltf --fail-on shear").code == 1


def test_normals_that_were_made_are_not_the_exporters_fault(own_folder, nmatrix) -> None:
    flat = "v 3 0 0\nv 1 0 0\nv 2 0 0\nv 0 0 9\nf 4 1 2\n"
    Path("own.obj").write_text(f"{flat[:32]}vn 0 0 0\nvn 0 1 0\nf 1//1 2//2 3//2\n")
    Path("made.obj").write_text(f"{flat}v 7 7 7\nf 5 5 5\n")
    own = nmatrix("inspect own.obj -f github --only degenerate").out
    assert "1 normal is no direction; the first at 3 0 0." in own
    made = nmatrix("inspect made.obj -f github --only degenerate").out
    assert "the file lacks some or all" in made and "the first at 7 7 7." in made


@pytest.mark.parametrize("file", ["a.stl", "a.obj"])
def test_nothing_is_said_of_drawing(own_folder, nmatrix, file: str) -> None:
    Path("a.stl").write_text(ASCII_STL)
    Path("a.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nl 1 2\ns off\n")
    told = nmatrix(f"inspect {file}").out
    assert "draw" not in told.lower() and "Normals were made" not in told
    assert ("Not judged of a.obj: lines" in told) == (file == "a.obj")


@pytest.mark.parametrize("width", [None, "80", "200", "5", "wide", "-3", "9" * 30])
def test_names_stay_whole_and_apart_at_any_width(own_folder, nmatrix, monkeypatch, width) -> None:
    names = [f"models/packed-{i}/BoxTextured.gltf" for i in range(3)]
    for name in names:
        Path(name).parent.mkdir(parents=True)
        Path(name).write_text(gltf(*lined(["BoxNode"], **STRETCH)))
    if width is not None:
        monkeypatch.setenv("COLUMNS", width)
    shown = nmatrix("inspect models").out.splitlines()
    room = 200 if width == "200" else 80
    assert max(map(len, shown)) <= room
    for i in range(3):
        assert sum(f"packed-{i}/" in line for line in shown) == 1
    assert sum(" ".join(shown).count(word) for word in ("BoxTextured.gltf",)) == 3
    assert "…" not in "".join(shown) or room == 80


@pytest.mark.parametrize("form", ["text", "json", "csv", "sarif", "github"])
def test_one_unreadable_file_that_was_checked_for_is_told_like_one_of_many(
    tmp_path: Path, nmatrix, form: str
) -> None:
    (tmp_path / "bad.obj").write_text("v 0 0 0\nf 1 2 x\n")
    found = nmatrix(f"inspect {shlex.quote(str(tmp_path))} --fail-on unreadable -f {form}")
    assert found.code == 1
    assert "1 of 1 file was not read" in found.err
    reason = "line 2 (x): x stands where a whole number is meant"
    before, told, _ = " ".join(found.out.split()).partition(reason)
    assert told
    assert not before.endswith(", ")


def test_an_extension_that_a_file_requires_and_nobody_knows_is_told(tmp_path: Path) -> None:
    scene = json.loads(gltf(MIRROR)) | {"extensionsRequired": ["ACME_teapot"]}
    (tmp_path / "a.gltf").write_text(json.dumps(scene))
    (told, *_) = report((inspect_file(tmp_path / "a.gltf"),)).remarks
    assert told.startswith("The file requires ACME_teapot, unknown here")


@pytest.mark.parametrize("name", ["a.obj", "line\nend.obj", "\x1b[31m.obj", "a b: c, d.obj"])
def test_a_reason_does_not_begin_with_the_name_of_its_file(
    tmp_path: Path, nmatrix, monkeypatch, name: str
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("good.obj").write_text(TRIANGLE)
    Path(name).write_text("v 0 0 0\nf 1 2 x\n")
    errors = [one["error"] for one in nmatrix("inspect . -f json").data["files"]]
    assert next(one for one in errors if one).startswith("line 2 (x): x stands")
