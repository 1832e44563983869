"""SVG plots for the page. Text and axes use currentColor, so they follow the light or dark theme."""
import hashlib
import html
import io
import math
import re

import matplotlib

matplotlib.use("svg")
from matplotlib import pyplot, ticker  # noqa: E402

from report_choices import is_choice, point_name  # noqa: E402
from report_data import number, pareto, timed  # noqa: E402

kInk = "#010203"  # replaced by currentColor
kFront, kOther = "#c2541a", "#3f7fb5"  # both readable on white and on black
kWidth, kHeight = 4.9, 3.7  # inches


def _svg(figure, title: str) -> str:
    # Derive element ids from the title, so that output is deterministic and ids are unique on the page.
    with matplotlib.rc_context({"svg.hashsalt": title}):
        file = io.StringIO()
        figure.savefig(file, format="svg", transparent=True, metadata={"Date": None})
    pyplot.close(figure)
    text = file.getvalue()
    text = text[text.index("<svg"):]
    text = re.sub(r"<metadata>.*?</metadata>", "", text, flags=re.S)
    text = re.sub(r'<g id="[^"]*"', "<g", text)
    text = re.sub(r' xmlns(:xlink)?="[^"]*"', "", text).replace("xlink:href", "href")
    prefix = hashlib.sha256(title.encode()).hexdigest()[:8]
    text = re.sub(r'(id="|href="#|url\(#)', rf"\g<1>p{prefix}", text)
    text = re.sub(r'<svg [^>]*viewBox="([^"]*)"[^>]*>',
                  lambda m: f'<svg class="plot" viewBox="{m[1]}" role="img" aria-label="{html.escape(title)}">', text, count=1)
    return text.replace(kInk, "currentColor").replace("font: ", "font-family: inherit; font: ")


def _axes(width=kWidth, height=kHeight):
    style = {"svg.fonttype": "none", "font.family": "sans-serif", "font.size": 10, "axes.edgecolor": kInk,
             "axes.labelcolor": kInk, "text.color": kInk, "xtick.color": kInk, "ytick.color": kInk,
             "axes.spines.top": False, "axes.spines.right": False, "axes.linewidth": 0.6}
    with matplotlib.rc_context(style):
        figure, axes = pyplot.subplots(figsize=(width, height))
    matplotlib.rcParams["svg.fonttype"] = "none"
    axes.grid(True, color="#808080", alpha=0.25, linewidth=0.5)
    axes.set_axisbelow(True)
    return figure, axes


def spread(wanted: list, gap: float, low: float, high: float) -> list:
    """Returns positions close to the requested ones, ascending, at least gap apart, within low..high if possible."""
    places = []
    for value in wanted:
        places.append(max(value, places[-1] + gap if places else low))
    top = high
    for i in reversed(range(len(places))):
        places[i] = min(places[i], top)
        top = places[i] - gap
    return places


def _labels(figure, axes, points: list) -> None:
    """Draws the labels beside the right edge, in the vertical order of the points. Leaders run horizontally to the edge
    and turn there, so that no two of them cross."""
    axes.autoscale_view()
    box = axes.get_window_extent()
    points = sorted(points, key=lambda p: (axes.transData.transform(p[:2])[1], p[0]))
    heights = [axes.transData.transform(p[:2])[1] for p in points]
    places = spread(heights, 12.5 * figure.dpi / 72, box.y0, box.y1)
    for (x, y, name, colour, bold), place in zip(points, places):
        start, label = axes.transAxes.inverted().transform([axes.transData.transform((x, y)), (box.x1, place)])
        axes.plot([start[0], 1, 1.07], [start[1], start[1], label[1]], transform=axes.transAxes, clip_on=False,
                  color="#808080", linewidth=0.5, alpha=0.7, zorder=1)
        axes.text(1.08, label[1], name, transform=axes.transAxes, va="center", ha="left", fontsize=9.5, color=kInk,
                  fontweight="bold" if bold else "normal")


def _error_axis(axes, errors: list) -> None:
    """Makes the axis of errors logarithmic. If an error is 0, the axis is linear from 0 to the decade below the
    smallest other error, so that 0 is drawn at 0, and that border is marked."""
    positive = [e for e in errors if e > 0]
    if positive and len(positive) == len(errors):
        axes.set_yscale("log")
        return
    threshold = 10.0 ** math.floor(math.log10(min(positive))) if positive else 1e-7
    axes.set_yscale("symlog", linthresh=threshold, linscale=0.4)
    axes.set_ylim(bottom=-0.15 * threshold)
    if not positive:
        axes.set_ylim(top=10 * threshold)
    # Decades within the linear part would be written over the 0. Ticks beyond the axis are not drawn.
    decades = [10.0**k for k in range(round(math.log10(threshold)), 4)]
    axes.yaxis.set_major_locator(ticker.FixedLocator([0.0] + decades))
    axes.axhline(threshold, color="#808080", linewidth=0.6, linestyle=(0, (2, 3)), zorder=0)


def error_against_time(group, renderer: str) -> str:
    """Plots relative RMS error against median time for one renderer, with quartiles and the Pareto front: methods as
    circles, choices of --max-error as diamonds."""
    rows = [r for r in group.points(renderer) if timed(r) and number(r, "error", "relRms") is not None]
    if not rows:
        return ""
    front = pareto(rows)
    height = lambda r: r["error"]["relRms"]  # noqa: E731
    figure, axes = _axes()
    _error_axis(axes, [height(r) for r in rows])
    steps_x, steps_y = [], []
    for i, row in enumerate(front):
        if i:
            steps_x.append(row["medianMs"]), steps_y.append(height(front[i - 1]))
        steps_x.append(row["medianMs"]), steps_y.append(height(row))
    axes.plot(steps_x, steps_y, color=kFront, linewidth=1.2, zorder=2)
    for row in rows:
        colour = kFront if row in front else kOther
        low, high = row.get("quartilesMs") or [row["medianMs"]] * 2
        median = row["medianMs"]
        axes.errorbar(median, height(row), xerr=[[max(0, median - low)], [max(0, high - median)]],
                      fmt="D" if is_choice(row) else "o", markersize=5, color=colour, elinewidth=1, capsize=2.5,
                      markerfacecolor=colour if row in front else "none", zorder=3)
    axes.margins(x=0.08, y=0.08)
    axes.set_xlabel("median time per image [ms], bars: quartiles")
    axes.set_ylabel("relative RMS error")
    axes.xaxis.set_major_locator(ticker.MaxNLocator(5))
    low, high = axes.get_ylim()
    if low > 0 and high / low < 50:  # few decades: label intermediate ticks too
        axes.yaxis.set_major_locator(ticker.LogLocator(subs=(1, 2, 5)))
        axes.yaxis.set_major_formatter(ticker.FormatStrFormatter("%g"))
    axes.yaxis.set_minor_formatter(ticker.NullFormatter())
    figure.subplots_adjust(left=0.17, right=0.7, top=0.97, bottom=0.13)
    _labels(figure, axes, [(r["medianMs"], height(r), point_name(r), kInk, r in front) for r in rows])
    return _svg(figure, f"Error against time: {group.scene}, {group.width} x {group.height}, depth {group.depth}, "
                        f"{renderer}")


def error_against_saving(points: list, title: str) -> str:
    """Plots (share of the time saved, relative RMS error, name, whether the error is visible) of what is left out."""
    figure, axes = _axes(width=6.2, height=4.4)
    _error_axis(axes, [y for _, y, _, _ in points])
    for x, y, _, visible in points:
        axes.plot(100 * x, y, "o", markersize=5, color=kFront if visible else kOther,
                  markerfacecolor=kFront if visible else "none", zorder=3, clip_on=False)
    axes.axvline(0, color="#808080", linewidth=0.6, linestyle=(0, (2, 3)), zorder=0)
    axes.margins(x=0.08, y=0.08)
    axes.set_xlabel("time saved [% of the complete image's]")
    axes.set_ylabel("relative RMS error")
    axes.yaxis.set_minor_formatter(ticker.NullFormatter())
    figure.subplots_adjust(left=0.13, right=0.68, top=0.97, bottom=0.12)
    _labels(figure, axes, [(100 * x, y, name, kInk, False) for x, y, name, _ in points])
    return _svg(figure, title)


def cost_against_payload(points: list, family: str, label: str) -> str:
    """Plots (payload bytes, cost, method) of one GPU family."""
    if not points:
        return ""
    figure, axes = _axes()
    for x, y, name in points:
        axes.plot(x, y, "o", markersize=5, color=kOther)
    axes.set_ylim(bottom=0)
    axes.margins(x=0.08, y=0.1)
    axes.set_xlabel("payload [bytes]")
    axes.set_ylabel(label)
    figure.subplots_adjust(left=0.16, right=0.75, top=0.97, bottom=0.13)
    _labels(figure, axes, [(x, y, name, kInk, False) for x, y, name in points])
    return _svg(figure, f"{label} against payload bytes, {family}")
