"""Small files that come with the package, so that every example runs where nothing is yet."""

from __future__ import annotations

import os
from functools import cache
from pathlib import Path

FOLDER = Path(__file__).parent


def samples(*endings: str) -> dict[str, Path]:
    """Name the samples whose files have one of these endings, without it; shaders with it.

    Examples
    --------
    >>> list(samples(".obj")), list(samples(*SHADERS))
    (['teapot'], ['phong.frag', 'phong.vert'])
    """
    files = (one for one in sorted(_folder().iterdir()) if one.suffix in endings)
    return {one.name if one.suffix in SHADERS else one.stem: one for one in files}


def file_or_sample(name: str | os.PathLike[str]) -> Path:
    """Find the file of a name; where there is none, the sample that is called so.

    Examples
    --------
    >>> file_or_sample("teapot").name, file_or_sample("no/such.obj").name
    ('teapot.obj', 'such.obj')
    """
    path = Path(name)
    is_shader = path.suffix in SHADERS
    is_name = path.parent == Path() and (is_shader or not path.suffix)
    known = samples(*(SHADERS if is_shader else ENDINGS)) if is_name else {}
    if path.name not in known:
        return path
    return path if os.path.lexists(path) else known[path.name]


@cache
def _folder() -> Path:
    """Find the folder of the samples; a packed program lays them out for as long as it runs."""
    if FOLDER.is_dir():
        return FOLDER
    import atexit
    from importlib.resources import files
    from tempfile import TemporaryDirectory

    laid_out = TemporaryDirectory(prefix="nmatrix-samples-")
    atexit.register(laid_out.cleanup)
    for one in files(__name__).iterdir():
        if one.is_file():
            Path(laid_out.name, one.name).write_bytes(one.read_bytes())
    return Path(laid_out.name)


ENDINGS = (".obj", ".toml", ".csv")
SHADERS = (".vert", ".frag")  # a program is two files of one stem
