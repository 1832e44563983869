"""Plots the scaling.json of tools/scaling: time and memory against the size of a scene or an image, on logarithmic axes."""
import json
import math
import pathlib

import matplotlib

matplotlib.use("svg")
from matplotlib import pyplot, ticker  # noqa: E402
from matplotlib.lines import Line2D  # noqa: E402

from report_data import ReportError, number  # noqa: E402
from report_plots import kInk, _svg  # noqa: E402
from report_text import printable_json  # noqa: E402

kFileInk = "#707070"  # readable on white and on black
kColours, kMarkers = ("#3f7fb5", "#c2541a", "#8a63b8", "#b58a1a"), "osDv"
kProcess, kBuild, kMemory = "#3f9157", "#a05a7a", "#c2541a"
kAxes = {"triangles": "triangles", "depth": "depth", "resolution": "pixels", "lights": "point lights",
         "layers": "panes of thin glass"}
kScenes = {"depth": "glass-wall", "resolution": "engine", "lights": "Cornell box", "layers": "thin glass"}


def read_scaling(path: pathlib.Path):
    """Returns the content of scaling.json, or None without the file. Raises ReportError."""
    try:
        found = printable_json(json.loads(path.read_text(encoding="utf-8", errors="replace")))
    except FileNotFoundError:
        return None
    except OSError as error:
        raise ReportError(f"{path}: cannot be read: {error.strerror}") from None
    except ValueError as error:
        raise ReportError(f"{path}: not JSON: {error}") from None
    if not isinstance(found, dict) or not isinstance(found.get("series"), list) or not found["series"]:
        raise ReportError(f"{path}: expected an object with a list 'series'; tools/scaling writes one")
    for at, series in enumerate(found["series"]):
        points = series.get("points") if isinstance(series, dict) else None
        if not isinstance(points, list) or not points or series.get("name") not in kAxes:
            raise ReportError(f"{path}: series {at}: expected 'name' (one of {', '.join(kAxes)}) and a list 'points'")
        for point in points:
            if not _complete(point):
                raise ReportError(f"{path}: series {series['name']}: expected points with a size above 0 and rows with "
                                  "traceMs, buildMs, processMs and peakMiB above 0")
    return found


def _complete(point) -> bool:
    if not isinstance(point, dict) or not (number(point, "size") or 0) > 0 or not point.get("rows"):
        return False
    return all(isinstance(row.get("method"), str) and (number(row, name, quartile) or 0) > 0
               for row in point["rows"] for name in ("traceMs", "buildMs", "processMs", "peakMiB")
               for quartile in ("median", "low", "high"))


def _curves(series: dict) -> dict:
    """Returns curves of time and of memory: (label, colour, marker, list of (size, spread)). The first curve of both
    starts the straight line."""
    points = series["points"]
    methods = [row["method"] for row in points[0]["rows"]]

    def values(method, name):
        return [(p["size"], row[name]) for p in points for row in p["rows"] if row["method"] == method]
    times = [(f"trace, {m}", kColours[i % 4], kMarkers[i % 4], values(m, "traceMs")) for i, m in enumerate(methods)]
    if series["name"] == "triangles":
        times.append(("build", kBuild, "^", values(methods[-1], "buildMs")))
    times.append((f"process, {methods[-1]}", kProcess, "P", values(methods[-1], "processMs")))
    return {"time": times, "memory": [("peak memory", kMemory, "o", values(methods[-1], "peakMiB"))]}


def _panel(axes, series: dict, curves: list, ink: str) -> None:
    others = [p["scene"] == "glass-wall" for p in series["points"]] if series["name"] == "triangles" else None
    axes.set_xscale("log")
    axes.set_yscale("log")
    for label, colour, marker, points in curves:
        apart = others or [False] * len(points)
        for hollow in (True, False):
            kept = [p for p, other in zip(points, apart) if other == hollow]
            if not kept:
                continue
            x, median = [p[0] for p in kept], [p[1]["median"] for p in kept]
            bars = [[max(0, s["median"] - s["low"]) for _, s in kept], [max(0, s["high"] - s["median"]) for _, s in kept]]
            axes.errorbar(x, median, yerr=bars, fmt=marker if hollow else marker + "-", color=colour, markersize=4,
                          linewidth=1.2, elinewidth=1, capsize=2, markerfacecolor="none" if hollow else colour,
                          label=f"_{label}" if hollow else label)
    axes.margins(x=0.06, y=0.1)
    axes.autoscale_view()
    low, high = axes.get_xlim(), axes.get_ylim()
    start = next((p for p, other in zip(curves[0][3], others or []) if not other), curves[0][3][0])
    x = [low[0], low[1]]
    axes.plot(x, [start[1]["median"] * v / start[0] for v in x], color=ink, linewidth=0.9, linestyle=(0, (4, 3)), zorder=1)
    axes.set_xlim(low)
    axes.set_ylim(_with_room(high))
    for axis in (axes.xaxis, axes.yaxis):
        _ticks(axis)
    axes.grid(True, color="#808080", alpha=0.25, linewidth=0.5)


def _with_room(limits: tuple) -> tuple:
    """Extends an axis to a factor of 10 at least, so that noise does not look like growth."""
    factor = max(1.0, math.sqrt(10 * limits[0] / limits[1]))
    return limits[0] / factor, limits[1] * factor


def _ticks(axis) -> None:
    low, high = axis.get_view_interval()
    few = high / low < 200
    axis.set_major_locator(ticker.LogLocator(subs=(1, 2, 5) if few and high / low < 30 else (1, 3) if few else (1,),
                                             numticks=6 if not few else 12))
    axis.set_major_formatter(ticker.FuncFormatter(lambda v, _: _short(v)))
    axis.set_minor_formatter(ticker.NullFormatter())
    axis.set_minor_locator(ticker.NullLocator())


def _short(value: float) -> str:
    for limit, unit in ((1e6, " M"), (1e4, " k")):
        if value >= limit * (1 - 1e-9):
            return f"{value / (1e6 if unit == ' M' else 1e3):g}{unit}"
    return f"{value:g}"


def _title(series: dict) -> str:
    points = series["points"]
    if series["name"] == "resolution":
        return kScenes["resolution"]
    scene = kScenes.get(series["name"]) or "engine (hollow: glass-wall)"
    depths = {p["depth"] for p in points}
    depth = f", depth {depths.pop()}" if len(depths) == 1 else ", depth: panes + 2" if series["name"] == "layers" else ""
    return f"{scene}\n{points[0]['width']} × {points[0]['height']}{depth}"


def _style(ink: str) -> dict:
    return {"svg.fonttype": "none", "svg.hashsalt": "malus", "font.size": 9, "axes.edgecolor": ink,
            "axes.labelcolor": ink, "text.color": ink, "xtick.color": ink, "ytick.color": ink,
            "axes.spines.top": False, "axes.spines.right": False}


def device_line(found: dict) -> str:
    machine = found.get("machine") or {}
    cpu = f" on {machine['cpu']}" if machine.get("cpu") else ""
    return f"{found.get('device') or 'device unknown'}{cpu}, {found.get('date') or 'date unknown'}, " \
           f"{found.get('rounds')} rounds"


def draw(found: dict, ink: str):
    """Draws one column per series, time above memory. Returns the figure."""
    series = found["series"]
    with matplotlib.rc_context(_style(ink)):
        figure, rows = pyplot.subplots(2, len(series), figsize=(max(4.3, 2.55 * len(series) + 0.3), 5.6), squeeze=False)
        figure.subplots_adjust(left=0.62 / figure.get_figwidth(), right=1 - 0.15 / figure.get_figwidth(), top=0.83,
                               bottom=0.085, wspace=0.28, hspace=0.16)
        labels = {}
        for at, one in enumerate(series):
            curves = _curves(one)
            for axes, name in zip(rows[:, at], ("time", "memory")):
                _panel(axes, one, curves[name], ink)
                labels.update((c[0], Line2D([], [], color=c[1], marker=c[2], markersize=4, linewidth=1.2))
                              for c in curves[name])
            rows[0][at].set_title(_title(one), fontsize=9)
            rows[1][at].set_xlabel(kAxes[one["name"]])
            rows[0][at].tick_params(labelbottom=False)
        rows[0][0].set_ylabel("time [ms]")
        rows[1][0].set_ylabel("peak memory [MiB]")
        labels["proportional"] = Line2D([], [], color=ink, linewidth=0.9, linestyle=(0, (4, 3)))
        columns = len(labels) if len(series) > 3 else 2
        figure.legend(list(labels.values()), list(labels), loc="upper center", ncol=columns, frameon=False, fontsize=9,
                      bbox_to_anchor=(0.5, 0.975 if len(series) > 3 else 1.01))
        if len(series) > 3:
            figure.text(0.5, 0.985, device_line(found), ha="center", va="top", fontsize=8.5)
    return figure


def write_svg(found: dict, path: pathlib.Path) -> None:
    figure = draw(found, kFileInk)
    with matplotlib.rc_context(_style(kFileInk)):
        figure.savefig(path, transparent=True, metadata={"Date": None})
    pyplot.close(figure)


def scaling_plots(found: dict) -> list:
    """Returns one SVG per series for the page."""
    plots = []
    for one in found["series"]:
        figure = draw({**found, "series": [one]}, kInk)
        plots.append(_svg(figure, f"Time and memory against {kAxes[one['name']]}"))
    return plots
