#!/usr/bin/python3
"""Plots error against time, one panel per scene, from the results.json of `malus compare`: the plot of README.md.

    cost_plot.py RESULTS.json FILE.svg [RENDERER]     RENDERER: embree by default
"""
import json
import sys

import matplotlib

matplotlib.use("svg")
from matplotlib import pyplot  # noqa: E402

from report_plots import spread  # noqa: E402

kColour = "#c2541a"
kInk = "#707070"  # readable on white and on black


def relative_error(row: dict) -> float:
    """Returns the error of method and precision: that of the method alone is 0 for the exact one."""
    return row["errorToReference"]["relRms"]


def draw(axes, scene: str, rows: list) -> None:
    for row in rows:
        ratio, error = row["ratioToSchlick"], relative_error(row)
        bars = [[ratio["median"] - ratio["low"]], [ratio["high"] - ratio["median"]]]
        axes.errorbar(ratio["median"], error, xerr=bars, fmt="o", markersize=5, color=kColour, elinewidth=1, capsize=2.5)
    axes.set_yscale("log")
    axes.margins(x=0.1, y=0.12)
    axes.set_title(scene, fontsize=10)
    axes.set_xlabel("time / schlick")
    axes.grid(True, color="#808080", alpha=0.25, linewidth=0.5)
    axes.autoscale_view()
    box = axes.get_window_extent()
    # Of equal errors the fastest has the lowest label, so that leader lines do not cross.
    rows = sorted(rows, key=lambda r: (float(f"{relative_error(r):.2g}"), r["ratioToSchlick"]["median"]))
    points = [(r["ratioToSchlick"]["median"], relative_error(r)) for r in rows]
    wanted = [axes.transData.transform(p)[1] for p in points]
    for row, point, height in zip(rows, points, spread(wanted, 13, box.y0, box.y1)):
        at = axes.transAxes.inverted().transform((box.x1, height))
        axes.annotate(row["method"], xy=point, xytext=(1.03, at[1]), textcoords="axes fraction", va="center",
                      fontsize=8.5, color=kInk, annotation_clip=False,
                      arrowprops={"arrowstyle": "-", "color": kInk, "linewidth": 0.4, "alpha": 0.6, "shrinkB": 3})


def main() -> int:
    if len(sys.argv) not in (3, 4):
        print("usage: cost_plot.py RESULTS.json FILE.svg [RENDERER]", file=sys.stderr)
        return 2
    with open(sys.argv[1], encoding="utf-8") as file:
        results = json.load(file)
    renderer = sys.argv[3] if len(sys.argv) == 4 else "embree"
    rows = [r for r in results["rows"] if r["renderer"] == renderer and r["status"] == "ok" and r["ratioToSchlick"]]
    scenes = list(dict.fromkeys(r["scene"] for r in rows))
    style = {"svg.fonttype": "none", "svg.hashsalt": "malus", "font.size": 9, "axes.edgecolor": kInk,
             "axes.labelcolor": kInk, "text.color": kInk, "xtick.color": kInk, "ytick.color": kInk,
             "axes.spines.top": False, "axes.spines.right": False}
    with matplotlib.rc_context(style):
        figure, panels = pyplot.subplots(1, len(scenes), figsize=(4.1 * len(scenes), 3.4), squeeze=False)
        figure.subplots_adjust(left=0.06, right=0.9, wspace=0.75, bottom=0.15, top=0.9)
        panels[0][0].set_ylabel("relative RMS error")
        for axes, scene in zip(panels[0], scenes):
            draw(axes, scene, [r for r in rows if r["scene"] == scene])
        figure.savefig(sys.argv[2], transparent=True, metadata={"Date": None})
    return 0


if __name__ == "__main__":
    sys.exit(main())
