"""The page of an ablation: what each effect and bounce gives and costs (render/ablation/RESULTS.md)."""
import json
import pathlib
import re

import jinja2
from markupsafe import Markup

import report_format
from report_colours import difference_colours, difference_limit, signed_difference, tone_mapped
from report_data import ReportError, has_enough_rounds, number
from report_format import percent, plain, ratio
from report_images import ExrImage, jpeg, kImageWidth, png, shrunk
from report_page import difference_scale
from report_plots import error_against_saving
from report_text import printable_json

kHere = pathlib.Path(__file__).resolve().parent


def read_ablation(folder: pathlib.Path) -> dict:
    path = folder / "results.json"
    try:
        results = printable_json(json.loads(path.read_text(encoding="utf-8", errors="replace")))
    except OSError as error:
        raise ReportError(f"{path}: cannot be read: {error.strerror}") from None
    except ValueError as error:
        raise ReportError(f"{path}: not JSON: {error}") from None
    if not isinstance(results, dict) or not isinstance(results.get("ablation"), list):
        raise ReportError(f"{path}: expected the results of malus compare --effects, with a list 'ablation'")
    for at, row in enumerate(results["ablation"]):
        for name in ("scene", "renderer", "kind", "name", "status", "depth"):
            if not isinstance(row, dict) or name not in row:
                raise ReportError(f"{path}: row {at} of 'ablation' has no '{name}'")
    return results


def label(row: dict) -> str:
    return f"bounces from {row['depth'] + 1} on" if row["kind"] == "depth" else row["name"]


class RendererView:
    """The rows of one scene on one renderer: the complete image, and the others by their cost per error."""

    def __init__(self, folder: pathlib.Path, rows: list, bounces: list, device: str):
        self.renderer, self.device = rows[0]["renderer"], device
        self.complete = rows[0]
        self.rows = sorted(rows[1:], key=lambda r: (-(number(r, "costPerError") or 0), number(r, "error", "relRms") or 0))
        self.bounces = sorted(bounces, key=lambda b: b["fromDepth"])
        timed = [r for r in self.rows if r["status"] == "ok" and number(r, "ratioToComplete", "median") is not None]
        points = [(1 - number(r, "ratioToComplete", "median"), number(r, "error", "relRms"), label(r), not r["invisible"])
                  for r in timed]
        title = f"Error of leaving out against time saved: {self.complete['scene']}, {self.renderer}"
        self.plot = Markup(error_against_saving(points, title)) if points else ""
        self.images, self.same, self.size = [], [], None
        if self.complete["status"] == "ok":
            self._differences(folder)

    def _differences(self, folder: pathlib.Path) -> None:
        whole = shrunk(ExrImage(folder / self.complete["image"]).rgb, kImageWidth)
        self.size = {"width": whole.shape[1], "height": whole.shape[0]}
        for row in self.rows:
            if row["status"] != "ok":
                continue
            difference = signed_difference(shrunk(ExrImage(folder / row["image"]).rgb, kImageWidth), whole)
            if not difference.any():
                self.same.append(label(row))
                continue
            # One scale for all would leave all but the largest differences blank.
            limit = difference_limit([difference])
            self.images.append((label(row), png(*difference_colours(difference, limit)), difference_scale(limit), row))

    def saving(self, row: dict) -> str:
        """The time without an effect over that of the complete image; marked if the difference is not significant."""
        median, low, high = (number(row, "ratioToComplete", name) for name in ("median", "low", "high"))
        if median is None:
            return "not timed"
        text = f"{ratio(median)} ({ratio(low)}–{ratio(high)})"
        return text if row["differs"] else f"{text}, not significant"

    @property
    def rounds(self) -> int:
        return len(self.complete.get("samplesMs") or [])

    @property
    def enough(self) -> bool:
        return has_enough_rounds(self.complete)


def unbroken(text: str) -> str:
    """Keeps numbers on one line."""
    return text.replace(" %", "\u00a0%").replace(" · ", "\u00a0·\u00a0")


def sentence(row: dict) -> str:
    """The advice as text of the page, with the page's exponents."""
    text = unbroken(re.sub(r"\d\.?\d*e-\d+", lambda m: plain(float(m[0]), 2), row["advice"]))
    return text[0].upper() + text[1:] + "."


def bounce_text(step: dict) -> str:
    first, last = step["fromDepth"] + 1, step["toDepth"]
    name = f"bounce {last}" if first == last else f"bounces {first} to {last}"
    median = number(step, "timeRatio", "median")
    if median is None:
        cost = "not timed"
    elif step["differs"]:
        cost = f"{percent(median - 1)} more time"
    else:
        cost = "no significant time"
    return unbroken(f"{name}: adds a relative RMS of {plain(step['relRms'])}, {cost}")


def page(folder: pathlib.Path, results: dict) -> str:
    scenes = {}
    for row in results["ablation"]:
        scenes.setdefault(row["scene"], {}).setdefault(row["renderer"], []).append(row)
    devices = results.get("devices") or {}
    views = []
    for name, renderers in scenes.items():
        complete = next(iter(renderers.values()))[0]
        image = None
        if complete["status"] == "ok":
            ev = number(results["scenes"].get(name) or {}, "exposureEv") or 0.0
            image = jpeg(tone_mapped(shrunk(ExrImage(folder / complete["image"]).rgb, kImageWidth), ev))
        bounces = results.get("bounces") or []
        views.append((name, complete, image,
                      [RendererView(folder, rows, [b for b in bounces if b["scene"] == name and b["renderer"] == renderer],
                                    devices.get(renderer) or renderer) for renderer, rows in renderers.items()]))
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(kHere / "templates"), autoescape=True,
                                     trim_blocks=True, lstrip_blocks=True, undefined=jinja2.StrictUndefined)
    environment.filters.update({name: getattr(report_format, name) for name in ("plain", "percent", "energy", "count")})
    return environment.get_template("ablation.html.j2").render(
        views=views, results=results, machine=results.get("machine") or {}, settings=results.get("settings") or {},
        label=label, sentence=sentence, bounce_text=bounce_text,
        style=Markup((kHere / "report.css").read_text(encoding="utf-8")))
