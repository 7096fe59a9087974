"""The command line in a folder of the test's own."""

from __future__ import annotations

import pytest


@pytest.fixture
def nmatrix(nmatrix, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return nmatrix
