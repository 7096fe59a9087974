"""The command line in a folder of the test's own."""

from __future__ import annotations

import shlex

import pytest

from nmatrix.cli.app import run


@pytest.fixture
def nmatrix(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)

    def call(line: str) -> tuple[int, str, str]:
        capsys.readouterr()
        code = run(shlex.split(line))
        captured = capsys.readouterr()
        return code, captured.out, captured.err

    return call
