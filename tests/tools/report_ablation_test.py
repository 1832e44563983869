#!/usr/bin/python3
"""Tests of tools/report/effects_report.py on small results with known values."""
import json
import pathlib
import re
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
import report_test  # noqa: E402
import report_ablation  # noqa: E402


def entry(kind: str, name: str, factor: float, depth: int = 3, **changes) -> dict:
    """A row whose image has `factor` times the radiance of the complete one."""
    error = abs(factor - 1)
    base = {"scene": "tiny", "renderer": "embree", "kind": kind, "name": name, "method": "stokes", "width": report_test.kWidth,
            "height": report_test.kHeight, "depth": depth, "status": "ok", "image": f"images/{factor:g}.exr",
            "error": {"meanAbs": error, "maxAbs": error, "relRms": error, "shareOver1Percent": 0.5, "perceptual": error,
                      "energyRatio": factor}, "invisible": error < 1e-3, "rays": 100, "savedRays": 10, "savedBytes": 0,
            "samplesMs": [10.0] * 7, "medianMs": 10.0, "ratioToComplete": {"median": 0.5, "low": 0.4, "high": 0.6},
            "differs": True}
    if kind != "complete":
        base.update(costPerError=0.5 / max(error, 1e-9), advice=f"{name}: relative RMS {error:.2g}, 5 % of the time")
    base.update(changes)
    return base


def write_results(folder: pathlib.Path) -> dict:
    """Effects whose errors differ by a factor of 100,000, and one without an error."""
    (folder / "images").mkdir()
    rows = [entry("complete", "", 1), entry("effect", "metal", 1.8), entry("effect", "an-effect-with-a-very-long-name", 1.000008),
            entry("polarization", "circular-polarization", 1), entry("depth", "bounce 3", 0.92, depth=2),
            entry("effect", "glass", 0.5, status="no <memory>", image=None, error=None, samplesMs=[], medianMs=None,
                  ratioToComplete=None, costPerError=None)]
    for row in rows:
        if row["image"]:
            report_test.write_exr(folder / row["image"], report_test.reference_pixels()[0] * row["error"]["energyRatio"])
    step = {"scene": "tiny", "renderer": "embree", "fromDepth": 2, "toDepth": 3, "relRms": 1e-5,
            "timeRatio": {"median": 1.1, "low": 1.0, "high": 1.2}, "differs": True}
    results = {"date": "2026-01-31 12:00 UTC", "machine": {"cpu": "A processor"}, "devices": {"embree": "Embree 3"},
               "settings": {"rounds": 7, "leftOut": 2}, "scenes": {"tiny": {"exposureEv": 0}}, "ablation": rows,
               "bounces": [step]}
    (folder / "results.json").write_text(json.dumps(results), encoding="utf-8")
    return results


def write_page(folder: pathlib.Path) -> str:
    write_results(folder)
    text = report_ablation.page(folder, report_ablation.read_ablation(folder))
    (folder / "index.html").write_text(text, encoding="utf-8")
    return text


class AblationPage(unittest.TestCase):
    def test_each_difference_has_its_scale(self):
        with tempfile.TemporaryDirectory() as folder:
            text = write_page(pathlib.Path(folder))
        scales = re.findall(r'Scale of the difference, from −(\S+( · \S+)?) ', text)
        self.assertEqual([first for first, _ in scales], ["0.5", "0.05", "5 · 10⁻⁶"][::-1], "radiance 0.5, smallest first")
        self.assertRegex(text, "No pixel differs without: circular-polarization")
        self.assertIn("no &lt;memory&gt;", text)

    def test_sentences_have_the_exponents_of_the_page(self):
        self.assertEqual(report_ablation.sentence({"advice": "metal: relative RMS 1.5e-05, 5 % of the time"}),
                         "Metal: relative RMS 1.5\u00a0·\u00a010⁻⁵, 5\u00a0% of the time.")


if __name__ == "__main__":
    unittest.main()
