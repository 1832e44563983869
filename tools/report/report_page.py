"""Renders the page templates with numbers, sentences, plots and images."""
import json
import math
import pathlib

import jinja2
import numpy
from markupsafe import Markup

import report_format
from report_colours import (aolp_colours, difference_colours, difference_limit, dolp_colours, kSignificantDoLP,
                            linear_polarization, luminance, mapped, signed_difference, tone_mapped)
from report_choices import choice_table
from report_data import group_rows, number, pareto
from report_effects import ratio_interval, replacement_reasons
from report_errors import ErrorSummary, kOff, relative_error
from report_findings import findings
from report_gpu import gpu_sections
from report_images import ExrImage, jpeg, kHeroWidth, kImageWidth, kStokesWidth, packed_stokes, png, shrunk
from report_paths import ratio_with_interval, without_recursion
from report_plots import error_against_time
from report_scaling import device_line, read_scaling, scaling_plots
from report_terms import kTerms, term
from report_words import first_sentence, second_sentence, short_recommendation, short_verdict

kHere = pathlib.Path(__file__).resolve().parent


class GroupView:
    """The content of the page for one group of rows."""

    def __init__(self, folder: pathlib.Path, group, exposure_ev: float, polarizer=None):
        self.polarizer, self.hero = polarizer, []
        self.group, self.key, self.size = group, group.key, report_format.group_size(group)
        self.wrongs, self.added, self.images, self.names = {}, None, {}, []
        self.differences, self.limit, self.polarization, self.stokes = {}, 0, None, None
        self.exposure_ev = exposure_ev
        front = [id(row) for renderer in group.renderers
                 for row in pareto(group.points(renderer))]
        self.on_front = {id(row): id(row) in front for row in group.rows}
        self.plots = [(renderer, Markup(error_against_time(group, renderer))) for renderer in group.renderers]
        self._read(folder)

    def _read(self, folder: pathlib.Path) -> None:
        group = self.group
        reference = ExrImage(folder / group.reference["image"]) if group.reference else None
        if reference is not None:
            self._add("reference", "reference, which is right", reference.rgb)
            if reference.stokes is not None:
                self._polarization(reference.stokes)
        dolp = None
        if reference is not None and reference.stokes is not None:
            dolp, _ = linear_polarization(*(luminance(reference.stokes[:, :, s]) for s in range(3)))
        rgb = {}
        for row in group.rows:
            if row["status"] != "ok" or not row.get("image"):
                continue
            name = (row["renderer"], row["method"])
            rgb[name] = ExrImage(folder / row["image"]).rgb
            self._add(f"{name[0]}/{name[1]}", f"{name[1]}, {name[0]}", rgb[name])
        if reference is None:
            return
        small = shrunk(reference.rgb, kImageWidth)
        signed = {}
        for (renderer, method), image in rgb.items():
            if image.shape != reference.rgb.shape:
                continue
            self.wrongs[self.key, renderer, method] = ErrorSummary(image, reference.rgb, dolp)
            signed[renderer, method] = signed_difference(shrunk(image, kImageWidth), small)
        for renderer in group.renderers:  # exclude pixels that are wrong with full polarization too
            plain, full = rgb.get((renderer, "fresnel")), rgb.get((renderer, "stokes"))
            if (renderer, "fresnel") in signed:
                too = relative_error(full, reference.rgb) > kOff if (renderer, "stokes") in signed else None
                self.wrongs[self.key, renderer, "polarization"] = ErrorSummary(plain, reference.rgb, dolp, too)
            if self.added is None and {(renderer, "sp"), (renderer, "sp-ratio")} <= signed.keys():
                self.added = ErrorSummary(rgb[renderer, "sp-ratio"], rgb[renderer, "sp"])
        self.limit = difference_limit(list(signed.values()))
        for (renderer, method), d in signed.items():
            self.differences.setdefault(renderer, []).append(
                (method, png(*difference_colours(d, self.limit)), self.group.row(renderer, method)))
        self._hero(rgb, reference.rgb)

    def _hero(self, rgb: dict, reference: numpy.ndarray) -> None:
        """The first images of the page: what a game shows (schlick), what is right, and the difference."""
        for renderer in self.group.renderers:
            for method in ("schlick", "fresnel"):
                image = rgb.get((renderer, method))
                if image is None or image.shape != reference.shape:
                    continue
                small, right = shrunk(image, kHeroWidth), shrunk(reference, kHeroWidth)
                differences = png(*difference_colours(signed_difference(small, right), self.limit))
                size = {"width": small.shape[1], "height": small.shape[0]}
                self.hero = [
                    {"uri": jpeg(tone_mapped(small, self.exposure_ev)), "what": "What a game shows", "by": method, **size},
                    {"uri": jpeg(tone_mapped(right, self.exposure_ev)), "what": "What is right", "by": "reference", **size},
                    {"uri": differences, "what": "Difference", "by": "red too bright, blue too dark", **size}]
                return

    def _add(self, name: str, label: str, rgb: numpy.ndarray) -> None:
        self.names.append((name, label))
        small = shrunk(rgb, kImageWidth)
        self.image_size = {"width": small.shape[1], "height": small.shape[0]}
        self.images[name] = jpeg(tone_mapped(small, self.exposure_ev))

    def _polarization(self, stokes: numpy.ndarray) -> None:
        light = shrunk(luminance(stokes), kImageWidth)
        dolp, aolp = linear_polarization(light[:, :, 0], light[:, :, 1], light[:, :, 2])
        lit = light[:, :, 0] > 0
        self.polarization = {
            "dolp": png(*dolp_colours(dolp)), "aolp": png(*aolp_colours(aolp, dolp)),
            "median": float(numpy.median(dolp[lit])) if lit.any() else 0.0, "largest": float(dolp.max())}
        self.stokes = packed_stokes(stokes)

    @property
    def first_choice(self) -> str:
        """The image initially shown beside the reference: the exact unpolarized one if available."""
        names = [name for name, _ in self.names]
        return next((name for name in names if name.endswith("/fresnel")), names[-1])

    @property
    def data(self) -> Markup:
        return script_json({"images": self.images, "stokes": self.stokes, "exposureEv": self.exposure_ev})

    def _polarization_facts(self) -> tuple:
        """The arguments of first_sentence, all of the first renderer that has the image of fresnel."""
        for renderer in self.group.renderers:
            exact = self.wrongs.get((self.key, renderer, "fresnel"))
            if exact is not None:
                break
        row = self.group.row(renderer, "fresnel") if exact is not None else None
        degrees = (self.polarization["median"], self.polarization["largest"]) if self.polarization else None
        return exact, self.wrongs.get((self.key, renderer, "polarization")), row, degrees, self.polarizer

    @property
    def sentences(self) -> list:
        return [Markup(s) for s in (first_sentence(*self._polarization_facts()), second_sentence(self.group)) if s]

    @property
    def verdict(self) -> Markup:
        """One line: whether the scene needs polarization, and the method to use."""
        text = f"{short_verdict(*self._polarization_facts())}; {short_recommendation(self.group)}."
        return Markup(text[0].upper() + text[1:])

    def same_as(self, row: dict) -> str:
        """Lists the methods whose time shows no significant difference from that of a row, abbreviated."""
        names = row.get("noSignificantDifference") or []
        others = [r["method"] for r in self.group.rows
                  if r["renderer"] == row["renderer"] and r is not row and r["status"] == "ok"]
        rest = [name for name in others if name not in names]
        if not names or len(others) < 3 or len(rest) > 2:
            return ", ".join(names)
        return "all others" + (f" but {report_format.listed(rest)}" if rest else "")

    @property
    def scale(self) -> dict:
        return difference_scale(self.limit)


def difference_scale(limit: float) -> dict:
    """The legend of difference images: colours, and the tick positions in percent."""
    strip = mapped(numpy.linspace(0, 1, 64), "RdBu_r")
    knee = limit / 100
    at = lambda v: 50 + 50 * math.copysign(math.log1p(abs(v) / knee) / math.log1p(limit / knee), v)  # noqa: E731
    values = [s * limit for s in (-1, -0.1, -0.01, 0, 0.01, 0.1, 1)]
    return {"gradient": gradient(strip),
            "ticks": [(at(v) if v else 50, ("+" if v > 0 else "−" if v < 0 else "") +
                       report_format.plain(abs(v), 1)) for v in values]}


def gradient(colours: numpy.ndarray) -> str:
    return f"linear-gradient(to right, {', '.join('#%02x%02x%02x' % tuple(c) for c in colours)})"


def wheel() -> list:
    """Wedges of the legend of AoLP: each direction through the centre has the colour of that angle."""
    count, wedges = 72, []
    for i in range(count):
        a, b = (math.radians(360 * k / count) for k in (i, i + 1.3 if i + 1 < count else i + 1))
        middle = (a + math.radians(360 * (i + 1) / count)) / 2
        colour = "#%02x%02x%02x" % tuple(mapped(numpy.array([(middle % math.pi) / math.pi]), "hsv")[0])
        points = " ".join(f"{50 * math.cos(t):.2f},{-50 * math.sin(t):.2f}" for t in (a, b))
        wedges.append((f"0,0 {points}", colour))
    return wedges


def script_json(value) -> Markup:
    """Encodes JSON for use inside a script element."""
    return Markup(json.dumps(value, separators=(",", ":")).replace("<", "\\u003c"))


def described(value) -> str:
    """Formats a setting or a driver property as text."""
    if value is None or value == []:
        return "as in the scene"
    if isinstance(value, dict):
        return ", ".join(f"{k} {described(v)}" for k, v in value.items()) or "none"
    if isinstance(value, list):
        return ", ".join(map(str, value))
    return {True: "yes", False: "no"}.get(value, str(value)) if isinstance(value, bool) else str(value)


def page(folder: pathlib.Path, results: dict) -> str:
    scenes, wrongs, added = {}, {}, {}
    for group in group_rows(results):
        ev = number(results["scenes"][group.scene], "exposureEv") or 0.0
        view = GroupView(folder, group, ev, number(results.get("settings") or {}, "polarizerDegrees"))
        scenes.setdefault(group.scene, []).append(view)
        wrongs.update(view.wrongs)
        if view.added is not None:
            added[group.key] = view.added
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(kHere / "templates"), autoescape=True,
                                     trim_blocks=True, lstrip_blocks=True, undefined=jinja2.StrictUndefined)
    environment.filters.update({name: getattr(report_format, name) for name in ("plain", "percent", "ratio", "energy", "count")})
    environment.filters["described"] = described
    environment.filters["pyid"] = id
    environment.globals.update(term=term, terms=kTerms)
    groups = [view.group for views in scenes.values() for view in views]
    devices = results.get("devices") or {}
    model = results.get("gpuModel") or []
    effects = results.get("effects") or []
    scaling = read_scaling(folder / "scaling.json")
    return environment.get_template("index.html.j2").render(
        results=results, devices=devices, machine=results.get("machine") or {}, settings=results.get("settings") or {}, driver=results.get("driver") or {},
        scenes=[(name, results["scenes"][name], views) for name, views in scenes.items()],
        findings=[{**f, "answer": [Markup(a) for a in f["answer"]]}
                  for f in findings(groups, wrongs, added, devices, model, results["rows"])],
        effects=effects, reasons=replacement_reasons(effects), interval=ratio_interval,
        choice_table=choice_table, paths=results.get("paths") or [], ratio_with_interval=ratio_with_interval, without_recursion=without_recursion,
        scaling_plots=[Markup(plot) for plot in scaling_plots(scaling)] if scaling else [],
        scaling_device=device_line(scaling) if scaling else "",
        gpu=gpu_sections(model, results["rows"]), number=number, wheel=wheel(),
        dolp_gradient=gradient(mapped(numpy.linspace(0, 1, 32), "viridis")), least_dolp=kSignificantDoLP,
        image_width=kImageWidth, stokes_width=kStokesWidth,
        style=Markup((kHere / "report.css").read_text(encoding="utf-8")),
        script=Markup("\n".join((kHere / name).read_text(encoding="utf-8")
                                for name in ("compare.js", "polarizer.js"))))
