"""The chart of a study: error against time, both in powers of ten, legible without colour."""

from __future__ import annotations

import io
from collections.abc import Sequence

from nmatrix.studies.rows import Row

SMALLEST = 1e-17  # where an error of zero is drawn
EPSILONS = {"float64": 2.0**-53, "float32": 2.0**-24, "float16": 2.0**-11}


def chart(rows: Sequence[Row], title: str, kind: str) -> bytes:
    """Return the chart as `svg` or `png`: numbered marks with a key, the front as a step line."""
    import matplotlib as mpl

    mpl.use("Agg")
    from matplotlib.figure import Figure

    settings = list(dict.fromkeys(row.setting for row in rows))
    columns = min(3, len(settings))
    lines = -(-len(settings) // columns)
    names = list(dict.fromkeys(row.method for row in rows))
    figure = Figure(figsize=(4.2 * columns, 3.4 * lines + 0.22 * len(names)), layout="constrained")
    axes = figure.subplots(lines, columns, squeeze=False).ravel()
    for axis, setting in zip(axes, settings, strict=False):
        _panel(axis, [row for row in rows if row.setting == setting], names, setting)
    for axis in axes[len(settings) :]:
        axis.axis("off")
    key = "\n".join(f"{i + 1}  {name}" for i, name in enumerate(names))
    figure.supxlabel(key, fontsize=8, ha="left", x=0.02, family="monospace")
    figure.suptitle(title)
    out = io.BytesIO()
    with mpl.rc_context({"svg.hashsalt": "nmatrix"}):
        figure.savefig(out, format=kind, metadata={"Date": None} if kind == "svg" else None)
    return out.getvalue()


def _panel(axis, rows: Sequence[Row], names: Sequence[str], setting: str) -> None:  # type: ignore[no-untyped-def]  # noqa: ANN001  # matplotlib's axes
    axis.set(
        xscale="log",
        yscale="log",
        title=setting,
        xlabel="time ratio",
        ylabel=rows[0].unit.split(",")[0],
    )
    axis.xaxis.set_minor_formatter("")
    for row in rows:
        error = SMALLEST if not row.error else row.error
        shade = "black" if row.on_front else "0.6"
        mark = "x" if row.failures else "o"
        axis.plot(row.timing.ratio, error, mark, color=shade, markersize=4)
        number = str(names.index(row.method) + 1)
        axis.annotate(
            number,
            (row.timing.ratio, error),
            (3, 3),
            textcoords="offset points",
            fontsize=7,
            color=shade,
        )
    front = sorted((r.timing.ratio, r.error or SMALLEST) for r in rows if r.on_front)
    if front:
        axis.step(*zip(*front, strict=True), where="post", color="black", linewidth=0.8)
    if rows[0].unit == "rad":
        for name, epsilon in EPSILONS.items():
            axis.axhline(epsilon, color="0.7", linestyle=":", linewidth=0.7)
            axis.annotate(
                name, (1, epsilon), xycoords=("axes fraction", "data"), fontsize=6, ha="right"
            )
