"""The certified level does little more work than an inverse: arithmetic and calls are counted."""

from __future__ import annotations

from dataclasses import replace
from math import prod
from typing import Any

import numpy as np
import pytest

from nmatrix.enums import Level, NormalMatrixKind
from nmatrix.linear import compensated
from nmatrix.linear.batched import normal_matrices
from nmatrix.linear.compensated import cofactors
from nmatrix.linear.exact import LinearMap
from nmatrix.studies.harness import calls

COUNT = 20_000


class Counted(np.ndarray):
    """An array that counts the numbers that functions compute from it."""

    work = 0

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: Any, **options: Any) -> Any:
        plain = [x.view(np.ndarray) if isinstance(x, Counted) else x for x in inputs]
        out = options.pop("out", ())
        if out:
            options["out"] = tuple(x.view(np.ndarray) if isinstance(x, Counted) else x for x in out)
        found = getattr(ufunc, method)(*plain, **options)
        Counted.work += max(prod(np.shape(x)) for x in (*plain, found))
        return out[0] if out else found.view(Counted) if isinstance(found, np.ndarray) else found


def operations(matrices: np.ndarray, monkeypatch: pytest.MonkeyPatch) -> float:
    """Count the operations of certified cofactors, for one matrix."""
    space = compensated.Workspace.of(len(matrices))
    scratch = {name: getattr(space, name).view(Counted) for name in ("products", "errors", "terms")}
    halves = {
        name: replace(getattr(space, name), block=getattr(space, name).block.view(Counted))
        for name in ("highs", "lows")
    }
    counted = replace(space, **scratch, **halves)
    monkeypatch.setattr(compensated.Workspace, "taken", lambda count, chunk: counted)
    Counted.work = 0
    cofactors(np.ascontiguousarray(matrices.transpose(1, 2, 0)).view(Counted))
    return Counted.work / len(matrices)


ORDINARY = np.random.default_rng(1).normal(size=(COUNT, 3, 3))
POWERS = 2.0 ** np.random.default_rng(2).integers(-400, 400, size=(COUNT, 1, 1))


def test_certified_cofactors_take_a_fixed_number_of_operations(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """An inverse by elimination takes about 60, and a loop over small matrices in LAPACK."""
    assert 100 < operations(ORDINARY, monkeypatch) < 300
    assert operations(ORDINARY * POWERS, monkeypatch) < 2 * operations(ORDINARY, monkeypatch)


@pytest.mark.parametrize("kind", NormalMatrixKind)
@pytest.mark.parametrize("level", [Level.CERTIFIED, Level.GUARDED])
def test_calls_are_few_for_many_matrices(level: Level, kind: NormalMatrixKind) -> None:
    out = np.empty_like(ORDINARY)
    with np.errstate(all="ignore"):
        assert calls(lambda: normal_matrices(ORDINARY, out, kind, level)) < COUNT / 10
        assert calls(lambda: normal_matrices(ORDINARY * POWERS, out, kind, level)) < COUNT / 10


@pytest.mark.parametrize("kind", NormalMatrixKind)
@pytest.mark.parametrize("level", [Level.CERTIFIED, Level.GUARDED])
def test_whole_numbers_are_for_the_few(
    level: Level, kind: NormalMatrixKind, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked = []
    of = LinearMap.of
    monkeypatch.setattr(LinearMap, "of", lambda rows: asked.append(rows) or of(rows))
    for given in (ORDINARY, ORDINARY * POWERS):
        with np.errstate(all="ignore"):
            normal_matrices(given, np.empty_like(given), kind, level)
    assert len(asked) <= 2
