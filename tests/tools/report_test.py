#!/usr/bin/python3
"""Tests of tools/report/compare_report.py on small results with known values."""
import copy
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import numpy
import OpenImageIO as oiio

kScript = pathlib.Path(__file__).resolve().parents[2] / "tools" / "report" / "compare_report.py"
sys.dont_write_bytecode = True
sys.path.insert(0, str(kScript.parent))
import report_data  # noqa: E402
import report_plots  # noqa: E402

kWidth, kHeight = 12, 9


def write_exr(path: pathlib.Path, rgb: numpy.ndarray, stokes: numpy.ndarray = None) -> None:
    names, planes = list("RGB"), [rgb]
    if stokes is not None:
        names += [f"S{s}.{c}" for s in range(4) for c in "RGB"]
        planes.append(stokes.reshape(kHeight, kWidth, 12))
    pixels = numpy.concatenate(planes, axis=2).astype(numpy.float32)
    spec = oiio.ImageSpec(kWidth, kHeight, len(names), oiio.FLOAT)
    spec.channelnames = names
    spec.attribute("compression", "zip")
    out = oiio.ImageOutput.create(str(path))
    assert out.open(str(path), spec) and out.write_image(pixels), out.geterror()
    out.close()


def reference_pixels():
    rgb = numpy.full((kHeight, kWidth, 3), 0.5)
    stokes = numpy.zeros((kHeight, kWidth, 4, 3))
    stokes[:, :, 0] = rgb
    stokes[6:, :4, 1] = 0.25  # the lower left ninth is half polarized along x
    return rgb, stokes


def row(renderer: str, method: str, **changes) -> dict:
    base = {"scene": "tiny", "renderer": renderer, "method": method, "effects": "auto", "width": kWidth,
            "height": kHeight, "depth": 3, "payloadBytes": 12, "rays": 1234, "samplesMs": [10.0] * 7,
            "medianMs": 10.0, "quartilesMs": [9.9, 10.1], "wallMs": 11.0, "cpuMs": 20.0, "buildMs": 1.0,
            "uploadMs": 0.5, "readBackMs": 0.25, "ratioToSchlick": {"median": 1.0, "low": 0.99, "high": 1.01},
            "raysPerSecond": 123400.0,
            "error": {"meanAbs": 0.0, "maxAbs": 0.0, "relRms": 1e-7, "shareOver1Percent": 0.0, "perceptual": 0.0,
                      "energyRatio": 1.0},
            "noSignificantDifference": [], "status": "ok", "image": f"images/{renderer}-{method}.exr"}
    base.update(changes)
    return base


def failed(renderer: str, method: str, reason: str) -> dict:
    result = row(renderer, method, status=reason, samplesMs=[], image=None)
    for name in ("rays", "medianMs", "quartilesMs", "wallMs", "cpuMs", "buildMs", "uploadMs", "readBackMs",
                 "ratioToSchlick", "raysPerSecond", "error"):
        result[name] = None
    return result


def effect(renderer: str, **changes) -> dict:
    ratio = {"median": 0.512, "low": 0.498, "high": 0.533}
    base = {"scene": "tiny", "renderer": renderer, "width": kWidth, "height": kHeight, "depth": 3, "brightest": 2.0,
            "all": {"method": "stokes", "medianMs": 20.0, "rays": 2468, "payloadBytes": 48, "stateBytes": 0},
            "auto": {"method": "fresnel", "medianMs": 10.2, "rays": 1234, "payloadBytes": 12, "stateBytes": 0,
                     "ratioToAll": ratio, "largestDifference": 3e-7, "why": "polarized light cannot <show>"},
            "importance": {"method": "importance", "medianMs": 11.0, "rays": 1234, "payloadBytes": 0,
                           "stateBytes": 388, "ratioToAll": {"median": 0.55, "low": 0.54, "high": 0.56},
                           "largestDifference": 4e-7}}
    base.update(changes)
    return base


def error(share: float, rms: float) -> dict:
    return {"meanAbs": 0.01, "maxAbs": 0.05, "relRms": rms, "shareOver1Percent": share, "perceptual": share / 2,
            "energyRatio": 1.02}


class Report(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.folder = pathlib.Path(self.temporary.name)
        (self.folder / "images").mkdir()
        rgb, stokes = reference_pixels()
        write_exr(self.folder / "images/reference.exr", rgb, stokes)
        wrong = rgb.copy()
        wrong[6:, :4] *= 1.2  # 12 of 108 pixels, all in the lower left
        for renderer in ("vulkan", "embree"):
            for method in ("schlick", "fresnel"):
                write_exr(self.folder / f"images/{renderer}-{method}.exr", wrong)
            write_exr(self.folder / f"images/{renderer}-stokes.exr", rgb, stokes)
        rows = []
        for renderer in ("vulkan", "embree"):
            rows += [row(renderer, "schlick", error=error(12 / 108, 0.07), noSignificantDifference=["fresnel"]),
                     row(renderer, "fresnel", error=error(12 / 108, 0.06), noSignificantDifference=["schlick"]),
                     row(renderer, "stokes", medianMs=15.0, quartilesMs=[14.5, 15.5], payloadBytes=48,
                         ratioToSchlick={"median": 1.5, "low": 1.45, "high": 1.55})]
        rows.append(failed("vulkan", "stokes-half", "recursion limit 1 is below depth <3>"))
        self.results = {
            "malus": "0.1.0", "commit": "abc", "compiler": "g++", "devices":
            {"vulkan": "llvmpipe (LLVM)", "embree": "Embree 3", "reference": "double"}, "driver": {},
            "settings": {"rounds": 7, "methods": ["schlick", "fresnel"], "backends": ["vulkan", "embree"],
                         "effects": "auto", "exposureEv": {"tiny": 0}},
            "scenes": {"tiny": {"title": "A tiny <scene>", "vertices": 3, "triangles": 1, "packHash": "00ff",
                                "exposureEv": 0}},
            "rows": rows, "gpuModel": [], "effects": [effect("vulkan"), effect("embree", importance=None)],
            "references": [{"scene": "tiny", "width": kWidth, "height": kHeight, "depth": 3,
                            "image": "images/reference.exr"}]}

    def test_effects(self):
        page = self.page()
        self.assertIn('id="effects"', page)
        table = page[page.index('id="effects"'):page.index('id="paper"')]
        for text in ("0.512", "0.498 to 0.533", "2,468", "388", "3.0 · 10⁻⁷", "not measured",
                     "fresnel replaces stokes", "polarized light cannot &lt;show&gt;"):
            self.assertIn(text, table)
        without = copy.deepcopy(self.results)
        del without["effects"]
        self.assertNotIn('id="effects"', self.page(without))

    def test_scaling(self):
        def point(size):
            spread = {"low": 0.9 * size, "median": size, "high": 1.1 * size}
            return {"size": size, "scene": "lights", "width": 8, "height": 8, "depth": 6, "rows":
                    [{"method": m, "traceMs": spread, "buildMs": spread, "processMs": spread, "peakMiB": spread}
                     for m in ("schlick", "stokes")]}
        self.assertNotIn('id="scaling"', self.page())
        scaling = {"device": "Embree <3>", "machine": {"cpu": "CPU", "threads": 2}, "date": "2026-01-31 12:30 UTC",
                   "rounds": 5, "series": [{"name": "lights", "points": [point(1), point(4)]},
                                           {"name": "layers", "points": [point(1), point(3)]}]}
        file = self.folder / "scaling.json"
        file.write_text(json.dumps(scaling))
        page = self.page()
        section = page[page.index('id="scaling"'):page.index('id="paper"')]
        self.assertEqual(section.count("<svg"), 2)
        for text in ("Embree &lt;3&gt; on CPU", "2026-01-31", "point lights", "panes of thin glass", "trace, stokes"):
            self.assertIn(text, section)
        del scaling["series"][1]["points"][1]["rows"][0]["peakMiB"]
        for wrong, word in (("{", "JSON"), ("[]", "series"), (json.dumps(scaling), "peakMiB")):
            file.write_text(wrong)
            done = self.run_script(self.folder)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done.stderr)
            self.assertIn("scaling.json", done.stderr)
            self.assertIn(word, done.stderr)

    def run_script(self, *arguments):
        return subprocess.run([sys.executable, str(kScript), *map(str, arguments)], capture_output=True, text=True,
                              check=False)

    def page(self, results=None) -> str:
        (self.folder / "results.json").write_text(json.dumps(results or self.results))
        done = self.run_script(self.folder)
        self.assertEqual((done.returncode, done.stderr, done.stdout), (0, "", ""))
        return (self.folder / "index.html").read_text(encoding="utf-8")

    def fails(self, text: str, *arguments):
        done = self.run_script(*arguments)
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertIn(text, done.stderr)
        self.assertNotIn("Traceback", done.stderr)

    def assertIn(self, member, container, message=None):  # noqa: N802: do not print the whole page
        self.assertTrue(member in container, message or f"missing: {member}")

    def assertNotIn(self, member, container, message=None):  # noqa: N802
        self.assertTrue(member not in container, message or f"unexpected: {member}")

    # The page

    def test_every_row_is_in_the_page(self):
        page = self.page()
        for entry in self.results["rows"]:
            self.assertEqual(page.count(f'data-row="{entry["renderer"]}/{entry["method"]}"'), 1)

    def test_the_page_is_self_contained(self):
        page = self.page()
        self.assertNotRegex(page, r"https?://")
        self.assertNotIn("@import", page)
        self.assertNotIn("<link", page)
        for reference in re.findall(r'(?:src|href)="([^"]*)"', page):
            self.assertRegex(reference, r"^(#|data:)")
        ids = re.findall(r'\sid="([^"]*)"', page)
        self.assertEqual(len(ids), len(set(ids)))
        for anchor in set(re.findall(r'href="#([^"]*)"', page)):
            self.assertIn(anchor, ids)
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), ["images", "index.html", "results.json"])

    def test_the_same_results_give_the_same_page(self):
        self.assertEqual(self.page(), self.page())

    def test_failed_rows_show_their_reason(self):
        self.assertIn("failed: recursion limit 1 is below depth &lt;3&gt;", self.page())

    def test_rows_without_significant_difference_are_marked(self):
        self.assertIn("≈ fresnel", self.page())

    def test_names_are_escaped(self):
        self.assertIn("A tiny &lt;scene&gt;", self.page())

    def test_several_sizes_are_separate(self):
        results = copy.deepcopy(self.results)
        results["rows"].append(row("embree", "schlick", depth=1, image=None))
        page = self.page(results)
        self.assertIn("<summary>12 × 9, depth 3</summary>", page)
        self.assertIn("<summary>12 × 9, depth 1</summary>", page)

    # The sentences

    def test_pixels_where_polarization_matters_are_located(self):
        page = self.page()
        for text in ("11 % of the pixels", "the lower left", "at most 20 %", "0.0556", "use <code>stokes</code>",
                     "1.500 times as long as <code>schlick</code>", "1.450 to 1.550"):
            self.assertIn(text, page)

    def test_small_errors_allow_to_leave_polarization_out(self):
        rgb, _ = reference_pixels()
        for renderer in ("vulkan", "embree"):
            write_exr(self.folder / f"images/{renderer}-fresnel.exr", rgb * 1.004)
        for entry in self.results["rows"]:
            if entry["method"] == "fresnel":
                entry["error"] = error(0, 0.004)
        page = self.page()
        # A ninth of the reference's light is half polarized, so a filter would show it.
        for text in ("needs no polarization", "the error of <code>fresnel</code> is at most 0.40 %", "mosaics",
                     "0 % in the median pixel and at most 50 %",
                     "use <code>fresnel</code>, which shows no significant difference"):
            self.assertIn(text, page)
        self.assertNotIn("may be left out", page)

    def test_a_polarizer_is_named(self):
        self.results["settings"]["polarizerDegrees"] = 120
        self.assertIn("behind the polarizer at 120", self.page())

    def test_few_rounds_recommend_nothing(self):
        for entry in self.results["rows"]:
            entry["samplesMs"] = entry["samplesMs"][:1]
        page = self.page()
        self.assertIn("1 round is too few", page)
        for text in (" use <code>", "no significant difference in 2 of 2", "faster in"):
            self.assertNotIn(text, page)

    def test_no_method_is_compared_with_itself(self):
        for entry in self.results["rows"]:
            if entry["status"] == "ok":
                entry["error"] = error(0, 0.003 if entry["method"] == "fresnel" else 0.004)
        sentence = re.search(r"use <code>fresnel</code>[^.;]*", self.page())[0]
        self.assertEqual(sentence.count("<code>fresnel</code>"), 1, sentence)
        self.assertEqual(sentence.count("<code>schlick</code>"), 1, sentence)

    def test_sentences_and_table_agree(self):
        for entry in self.results["rows"]:
            if entry["method"] in ("schlick", "fresnel"):
                entry["error"] = error(0.2149, 0.06)
        page = self.page()
        self.assertGreaterEqual(page.count("21 %"), 4)
        self.assertNotIn("11 %", page)

    def test_paragraphs_are_not_repeated(self):
        paragraphs = [p for p in re.findall(r"<p>(.*?)</p>", self.page(), re.S) if len(p) > 40]
        self.assertGreater(len(paragraphs), 5)
        self.assertEqual(len(paragraphs), len(set(paragraphs)))

    def test_the_summary_shows_what_is_right(self):
        self.results.update(date="2026-01-31 12:00 UTC", machine={"cpu": "A <CPU>", "threads": 4})
        page = self.page()
        summary = page[page.index("<header>"):page.index('aria-labelledby="scene-tiny"')]
        for text in ("A &lt;CPU&gt;", "2026-01-31", "Embree 3", "What a game shows", "What is right", "Difference"):
            self.assertIn(text, summary)
        self.assertEqual(summary.count('class="verdict"'), 1)
        self.assertEqual(summary.count("<img "), 3)

    def test_images_have_sizes_and_load_late(self):
        images = re.findall(r"<img [^>]*>", self.page())
        self.assertGreater(len(images), 5)
        for image in images:
            self.assertRegex(image, 'width="[0-9]+" height="[0-9]+"')
            if "data-show" not in image:  # these get their source by script
                self.assertIn('loading="lazy"', image)

    def test_terms_are_explained_twice(self):
        page = self.page()
        glossary = page[page.index('id="reading"'):]
        for term in ("FLIP", "DoLP", "AoLP", "payload", "quartiles"):
            self.assertRegex(page, f'<abbr title="[^"]+">{term}</abbr>')
            self.assertIn(f"<dt>{term}</dt>", glossary)

    def test_control_characters_are_escaped(self):
        self.results["scenes"]["tiny"]["title"] = "red \x1b[31m \x07 \u202e \x9b"
        self.results["devices"]["vulkan"] = "\x1b"
        page = self.page()
        self.assertNotRegex(page, "[\x00-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e]")
        for text in ("\\x1b[31m", "\\x07", "\\u{202e}", "\\x9b"):
            self.assertIn(text, page)

    def test_keys_of_earlier_versions_are_read(self):
        page = self.page()
        for entry in self.results["rows"]:
            entry["indistinguishable"] = entry.pop("noSignificantDifference")
            entry["picture"] = entry.pop("image")
        self.assertIn("≈ fresnel", page)
        self.assertTrue(self.page() == page, "the pages differ")

    def test_nothing_is_claimed_inside_the_noise(self):
        self.assertIn("<code>fresnel</code> against <code>schlick</code>: no significant difference in 2 of 2 cases",
                      self.page())

    def test_a_difference_outside_the_noise_is_named(self):
        for entry in self.results["rows"]:
            if entry["renderer"] == "embree" and entry["method"] == "fresnel":
                entry.update(noSignificantDifference=[], ratioToSchlick={"median": 0.9, "low": 0.88, "high": 0.93})
        self.assertIn("faster in 1, no significant difference in 1 of 2 cases", self.page())

    def test_small_payloads_are_not_compared_on_lavapipe(self):
        for method, size, ms in (("sp", 36, 20.0), ("sp-ratio", 20, 10.0)):
            self.results["rows"].append(row("vulkan", method, payloadBytes=size, medianMs=ms, image=None,
                                            quartilesMs=[ms - 0.1, ms + 0.1]))
        page = self.page()
        self.assertIn("faster; not due to payload size", page)
        self.assertIn("payloads of 12 to 36 bytes", page)
        self.assertNotIn("The method with the smaller payload: faster", page)

    def test_paths_of_a_device(self):
        self.assertNotIn('id="paths"', self.page())
        ratio = lambda median: {"median": median, "low": median - 0.01, "high": median + 0.01}  # noqa: E731
        self.results["paths"] = [
            {"scene": "tiny", "renderer": "vulkan", "width": kWidth, "height": kHeight, "depth": 3,
             "method": "importance", "differs": True, "largestDifference": 0.0, "pipelineToQuery": ratio(1.371),
             "query": {"medianMs": 8.25, "ratioToSchlick": ratio(0.825), "payloadBytes": 0, "stateBytes": 388},
             "pipeline": {"medianMs": 11.31, "ratioToSchlick": None, "payloadBytes": 16, "stateBytes": 388}},
            {"scene": "tiny", "renderer": "embree", "width": kWidth, "height": kHeight, "depth": 3,
             "method": "stokes", "differs": True, "largestDifference": 0.0, "scalarToPacket": ratio(6.512),
             "packet": {"medianMs": 2.25, "ratioToSchlick": ratio(1.171), "payloadBytes": 48, "stateBytes": 0},
             "scalar": {"medianMs": 14.63, "ratioToSchlick": ratio(7.6), "payloadBytes": 48, "stateBytes": 0}}]
        page = self.page()
        self.assertIn('id="paths"', page)
        for text in ("1.371 (1.361 to 1.381)", "8.25", "11.3", "0.825 (0.815 to 0.835)", "6.512 (6.502 to 6.522)",
                     "scalar / packet", "14.6"):
            self.assertIn(text, page)

    def test_methods_without_recursion_are_named(self):
        self.assertNotIn("a stack replaces", self.page())
        for entry in self.results["rows"]:
            if entry["renderer"] == "vulkan" and entry["method"] in ("fresnel", "stokes"):
                entry["withoutRecursion"] = "depth 3 needs <5> nested rays"
        page = self.page()
        self.assertEqual(page.count("a stack replaces"), 1)
        self.assertIn("fresnel and stokes: depth 3 needs &lt;5&gt; nested rays", page)

    def test_the_gpu_model_is_called_an_estimate(self):
        self.assertNotIn('id="gpu"', self.page())
        stage = {"registers": {"vgpr": 64}, "spills": 0, "lds": 0, "codeSize": 400, "instructions": 90, "latency": 300,
                 "wavesPerSimd": 16}
        self.results["gpuModel"] = [
            {"family": "navi21", "method": method, "scene": "tiny",
             "stackBytes": {"closest hit": 7112, "ray generation": 16}, "stages":
             [{"stage": "closest hit", "inverseThroughput": cost, **stage},
              {"stage": "traversal", "inverseThroughput": 1737, **stage}]}
            for method, cost in (("schlick", 100), ("fresnel", 125))]
        page = self.page()
        self.assertIn('id="gpu"', page)
        self.assertIn("not times", page)
        self.assertIn("1.250 times the estimate of <code>schlick</code>", page)
        self.assertIn("inverse throughput", page)
        self.assertIn("7,112", page)
        self.assertIn("largest stack of a stage", page)

    # Bad input

    def test_bad_input_gives_one_line(self):
        self.fails("no such folder", self.folder / "missing")
        self.fails("results.json: cannot be read", self.folder)
        (self.folder / "results.json").write_text('{"rows": [')
        self.fails("results.json: not JSON", self.folder)
        (self.folder / "results.json").write_text("[]")
        self.fails("expected an object", self.folder)
        (self.folder / "results.json").write_text('{"scenes": {}, "rows": 3, "references": []}')
        self.fails("expected 'rows' to be a list", self.folder)
        results = copy.deepcopy(self.results)
        del results["rows"][1]["method"]
        (self.folder / "results.json").write_text(json.dumps(results))
        self.fails("row 1 has no 'method'", self.folder)
        self.assertFalse((self.folder / "index.html").exists())

    def test_a_missing_or_damaged_image_is_named(self):
        (self.folder / "results.json").write_text(json.dumps(self.results))
        (self.folder / "images/embree-fresnel.exr").write_bytes(b"not an image")
        self.fails("embree-fresnel.exr", self.folder)
        (self.folder / "images/reference.exr").unlink()
        self.fails("reference.exr", self.folder)

    def test_usage(self):
        self.assertEqual(self.run_script().returncode, 2)


class Plots(unittest.TestCase):
    def test_an_error_of_zero_is_drawn_at_zero(self):
        from matplotlib import pyplot
        figure, axes = report_plots._axes()
        report_plots._error_axis(axes, [0, 1e-3, 2e-2])
        zero, least, low = (axes.transData.transform((1, y))[1] for y in (0, 1e-3, axes.get_ylim()[0]))
        self.assertGreaterEqual(zero, low)
        self.assertGreater(least - zero, 10)  # pixels
        pyplot.close(figure)

    def test_labels_of_the_error_axis_are_beside_each_other(self):
        from matplotlib import pyplot
        figure, axes = report_plots._axes()
        report_plots._error_axis(axes, [0, 7e-10, 2e-2])
        axes.plot([1, 2, 3], [0, 7e-10, 2e-2])
        ticks = [y for y in axes.get_yticks() if 0 <= y <= axes.get_ylim()[1]]
        self.assertIn(0, ticks)
        places = sorted(axes.transData.transform((1, y))[1] for y in ticks)
        self.assertGreater(min(numpy.diff(places)), 10)  # pixels
        pyplot.close(figure)

    def test_labels_have_the_order_of_the_points_and_leaders_do_not_cross(self):
        generator = numpy.random.default_rng(3)
        for trial in range(20):
            rows = [row("embree", f"m{i}", medianMs=float(t), quartilesMs=[t, t], error=error(0, float(e)))
                    for i, (t, e) in enumerate(zip(generator.uniform(1, 9, 12), 10 ** generator.uniform(-4, -3.8, 12)))]
            group = report_data.Group("tiny", 1, 1, 1, rows)
            drawn = []
            labels = report_plots._labels
            report_plots._labels = lambda figure, axes, points: (labels(figure, axes, points), drawn.append((figure, axes)))
            try:
                report_plots.error_against_time(group, "embree")
            finally:
                report_plots._labels = labels
            figure, axes = drawn[0]
            places = {text.get_text(): text.get_position()[1] for text in axes.texts}
            wanted = [r["method"] for r in sorted(rows, key=lambda r: r["error"]["relRms"])]
            self.assertEqual(sorted(places, key=places.get), wanted)
            leaders = [line for line in axes.lines if len(line.get_xdata()) == 3 and line.get_transform() == axes.transAxes]
            self.assertEqual(len(leaders), 12)
            ends = sorted((line.get_ydata()[1], line.get_ydata()[2]) for line in leaders)
            self.assertEqual(ends, sorted(ends, key=lambda e: e[1]))


if __name__ == "__main__":
    unittest.main()
