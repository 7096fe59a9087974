"""A file reaches nothing outside of its own folder, however its name says it."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from nmatrix.answers.inspect.file import inspect_file
from nmatrix.errors import IllegalValueError
from nmatrix.scene.beside import asset_bytes, beside
from nmatrix.scene.gltf.file import read_gltf
from nmatrix.scene.images import read_image
from nmatrix.scene.open import scene_of

OUTSIDE = [
    "../secret",
    "images/../../secret",
    "/etc/passwd",
    "C:\\secret",
    "\\\\server\\share",
    "file:///etc/passwd",
    "FILE:secret",
    "link/secret",
]


def folder(tmp_path: Path) -> Path:
    """Make a folder with a link that leads out of it, and return a file in it."""
    inside = tmp_path / "inside"
    (inside / "images").mkdir(parents=True)
    (inside / "link").symlink_to(tmp_path)
    return inside / "a.gltf"


@pytest.mark.parametrize("name", OUTSIDE)
def test_names_that_lead_out_are_refused_and_may_be_allowed(tmp_path: Path, name: str) -> None:
    file = folder(tmp_path)
    with pytest.raises(IllegalValueError, match="which lies outside its folder") as caught:
        beside(file, name)
    assert "add allow_outside" in str(caught.value)
    assert isinstance(beside(file, name, allow_outside=True), Path)


@pytest.mark.parametrize("name", ["a.bin", "images/a.png", "images/../a.bin", "a b", "..x", "x\0y"])
def test_names_that_stay_inside_are_taken(tmp_path: Path, name: str) -> None:
    file = folder(tmp_path)
    assert beside(file, name) == file.parent / name


@pytest.mark.parametrize("allow_outside", [True, False])
def test_addresses_are_never_fetched(tmp_path: Path, *, allow_outside: bool) -> None:
    with pytest.raises(IllegalValueError, match="an address, and nothing is fetched"):
        beside(folder(tmp_path), "https://example.org/a.png", allow_outside=allow_outside)


@pytest.mark.parametrize("kind", ["buffers", "images"])
def test_a_gltf_file_is_refused_before_it_reads(tmp_path: Path, kind: str) -> None:
    (tmp_path / "secret").write_bytes(bytes(12))
    file = folder(tmp_path)
    entry = '{"uri": "..%2Fsecret", "byteLength": 12}'
    file.write_text(f'{{"asset": {{"version": "2.0"}}, "nodes": [{{}}], "{kind}": [{entry}]}}')
    with pytest.raises(IllegalValueError, match=r"it names \.\./secret"):
        read_gltf(file)
    assert len(read_gltf(file, allow_outside=True).nodes) == 1


@pytest.mark.parametrize("key", ["mesh", "texture"])
def test_a_scene_file_is_refused(tmp_path: Path, key: str) -> None:
    (tmp_path / "secret.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    file = folder(tmp_path).with_suffix(".toml")
    text = '[[object]]\nmesh = "../secret.obj"\n'
    if key == "texture":
        material = '[materials.m]\ntexture = "../secret.obj"\n'
        text = f'[[object]]\nshape = "box"\nmaterial = "m"\n{material}'
    file.write_text(text)
    with pytest.raises(IllegalValueError, match=r"it names \.\./secret\.obj"):
        scene_of(file)
    assert len(scene_of(file, allow_outside=True).objects) == 1


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "it is empty"),
        (b" \n", "it is empty"),
        (
            b"version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 12345\n",
            "it is a pointer of Git LFS: the file itself of 12,345 bytes was not fetched",
        ),
    ],
)
def test_content_that_is_no_asset_is_named(tmp_path: Path, content: bytes, words: str) -> None:
    path = tmp_path / "a.glb"
    path.write_bytes(content)
    with pytest.raises(IllegalValueError, match=words):
        asset_bytes(path)


@pytest.mark.parametrize("name", ["pipe.obj", "pipe.ply", "pipe.stl", "pipe.gltf", "pipe.glb"])
def test_a_pipe_in_place_of_a_file_is_refused_and_not_waited_for(tmp_path: Path, name: str) -> None:
    pipe = tmp_path / name
    os.mkfifo(pipe)
    with pytest.raises(IllegalValueError, match="it is a pipe or a device, and no file"):
        inspect_file(pipe)


def test_a_pipe_that_an_asset_names_costs_what_it_was_for(tmp_path: Path) -> None:
    for name in ("a.bin", "a.png", "a.mtl"):
        os.mkfifo(tmp_path / name)
    with pytest.raises(IllegalValueError, match="a pipe or a device"):
        read_image(tmp_path / "a.png")
    (tmp_path / "a.obj").write_text("mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    assert (
        "a.mtl (a.obj, line 1) is not read: it is a pipe or a device, and no file."
        in scene_of(tmp_path / "a.obj").remarks
    )
    (tmp_path / "a.gltf").write_text(
        '{"asset": {"version": "2.0"}, "buffers": [{"byteLength": 1, "uri": "a.bin"}]}'
    )
    with pytest.raises(IllegalValueError, match="a pipe or a device"):
        read_gltf(tmp_path / "a.gltf").buffer(0)
