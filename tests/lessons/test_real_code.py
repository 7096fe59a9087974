"""The wrong matrices of public reports: each is named.

`real_code.csv` holds their numbers, to six decimals and without coincidences, computed from the
words in its column `made` by arithmetic apart from nmatrix.
"""

from __future__ import annotations

import csv
from pathlib import Path

import pytest

with Path(__file__).with_name("real_code.csv").open(encoding="utf-8", newline="") as file:
    REAL_CODE = list(csv.DictReader(file))
OF_REPORTS = 48  # the rest were found beside them


@pytest.mark.parametrize("row", REAL_CODE, ids=lambda row: f"{row['what']}: {row['made']}")
def test_a_mistake_of_real_code_is_named(nmatrix, row: dict[str, str]) -> None:
    found = nmatrix(f'check {row["what"]} "{row["answer"]}" {row["options"]} -f json')
    assert (found.code, found.data["verdict"]) == (1, "mistake")
    assert found.data["mistake"] == row["mistake"]


def test_the_file_holds_every_kind_of_report() -> None:
    assert len(REAL_CODE) > OF_REPORTS
    counts = {
        what: sum(row["what"] == what for row in REAL_CODE) for what in ("projection", "view")
    }
    assert counts == {"projection": 18, "view": 10}
