"""JSON by RFC 8259: one object, shortest round-trip numbers, each matrix row on one line."""

from __future__ import annotations

import json
from collections.abc import Mapping

from nmatrix.output.numbers import (
    arranged,
    is_list,
    is_matrix,
    is_number,
    is_vector,
    members,
    round_trip_text,
    significant,
)
from nmatrix.output.write import Charset, OutputOptions
from nmatrix.report import Report, Shown, Step, Value
from nmatrix.version import __version__

INDENT = "  "
LINE = 88  # an object that fits is kept on one line


def write(report: Report, options: OutputOptions) -> str:
    r"""Write the report as one JSON object.

    A number outside the float64 range becomes null, and a remark names it. In column-major
    layout matrices (2 to 8 rows of numbers) are written transposed; nothing else changes.

    Examples
    --------
    >>> text = write(Report("calc", {"value": ((1, 0), (0, 1))}, ()), OutputOptions())
    >>> print("\n".join(text.splitlines()[4:8]))
      "value": [
        [1, 0],
        [0, 1]
      ],
    """
    writer = _Writer(options)
    whole: dict[str, Value] = {
        "command": report.command,
        "version": __version__,
        "layout": str(options.layout),
        **report.data,
    }
    lines = [writer.member(name, value, name) for name, value in whole.items()]
    remarks = [*report.remarks, *(outside_remark(key, shown) for key, shown in writer.outside)]
    lines.append(writer.member("remarks", remarks, "remarks"))
    return "{\n" + ",\n".join(lines) + "\n}\n"


def outside_remark(key: str, shown: str) -> str:
    """Explain a null."""
    return f"{key} is {shown}, outside the range of float64: null here; the text format shows it."


class _Writer:
    """Turns values into JSON and notes which numbers no float64 can hold."""

    def __init__(self, options: OutputOptions) -> None:
        self.options = options
        self.outside: list[tuple[str, str]] = []

    def member(self, name: str, value: Value, key: str, depth: int = 1) -> str:
        written = self.value(value, key, depth)
        return f"{INDENT * depth}{self._string(name)}: {written}"

    def value(self, value: Value, key: str, depth: int) -> str:
        if is_number(value):
            return self._number(value, key)
        if isinstance(value, str):
            return self._string(value)
        if isinstance(value, Step):
            value = members(value)
        if isinstance(value, Mapping):
            return self._object(value, key, depth)
        if not is_list(value):
            return json.dumps(value)
        if is_vector(value):
            entries = (self.value(entry, f"{key}.{i}", depth) for i, entry in enumerate(value))
            return f"[{', '.join(entries)}]"
        rows = arranged(value, self.options.layout) if is_matrix(value) else value
        return self._list(tuple(rows), key, depth)

    def _string(self, text: str) -> str:
        escape = self.options.charset is Charset.ASCII or not _encodable(text)
        return json.dumps(text, ensure_ascii=escape)

    def _object(self, value: Mapping[str, Value], key: str, depth: int) -> str:
        if not value:
            return "{}"
        lines = [self.member(n, v, f"{key}.{n}", depth + 1) for n, v in value.items()]
        return _joined("{", lines, "}", depth)

    def _list(self, value: tuple[Value, ...], key: str, depth: int) -> str:
        if not value:
            return "[]"
        inner = INDENT * (depth + 1)
        lines = [inner + self.value(v, f"{key}.{i}", depth + 1) for i, v in enumerate(value)]
        if all(isinstance(entry, (str, bool, type(None))) for entry in value):
            return _joined("[", lines, "]", depth)
        return "[\n" + ",\n".join(lines) + f"\n{INDENT * depth}]"

    def _number(self, value: Shown, key: str) -> str:
        written = round_trip_text(value)
        if written is None:
            self.outside.append((key, significant(value, self.options.digits)))
        return "null" if written is None else written


def _joined(opening: str, lines: list[str], closing: str, depth: int) -> str:
    """Put the members on one line where they fit, else on a line each."""
    one = f"{opening}{', '.join(line.strip() for line in lines)}{closing}"
    if depth > 1 and len(one) + len(INDENT) * depth <= LINE and "\n" not in one:
        return one
    return f"{opening}\n" + ",\n".join(lines) + f"\n{INDENT * depth}{closing}"


def _encodable(text: str) -> bool:
    """Try UTF-8 on a text; names of files may hold halves of characters."""
    return not any("\ud800" <= character <= "\udfff" for character in text)
