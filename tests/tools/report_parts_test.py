#!/usr/bin/python3
"""Tests of the parts of tools/report that compute colours, polarization and fronts."""
import math
import pathlib
import sys
import unittest

import numpy

kFolder = pathlib.Path(__file__).resolve().parents[2] / "tools" / "report"
sys.dont_write_bytecode = True
sys.path.insert(0, str(kFolder))
import report_choices  # noqa: E402
import report_colours  # noqa: E402
import report_data  # noqa: E402
import report_errors  # noqa: E402
import report_images  # noqa: E402
import report_plots  # noqa: E402

kWidth, kHeight = 12, 9


class Parts(unittest.TestCase):
    def test_tone_curve(self):
        # Expected values follow from the formula in render/image/output.cpp.
        expected = {0.0: 0, 0.001: 3, 0.18: 118, 0.7: 218, 1.0: 242, 1e9: 255, math.nan: 0}
        got = report_colours.tone_mapped(numpy.array(list(expected)), 0)
        self.assertEqual(got.tolist(), list(expected.values()))
        self.assertEqual(report_colours.tone_mapped(numpy.array([0.35]), 1).tolist(), [218])

    def test_polarization_angles(self):
        one = numpy.array([1.0])
        for s1, s2, degrees in ((1, 0, 0), (0, 1, 45), (-1, 0, 90), (0, -1, 135)):
            dolp, aolp = report_colours.linear_polarization(one, s1 * one / 2, s2 * one / 2)
            self.assertAlmostEqual(math.degrees(aolp[0]), degrees)
            self.assertAlmostEqual(dolp[0], 0.5)
        self.assertEqual(report_colours.linear_polarization(0 * one, 0 * one, 0 * one)[0][0], 0)

    def test_locations(self):
        mask = numpy.zeros((9, 9), bool)
        self.assertEqual(report_errors.location(mask), "")
        mask[4, 4] = True
        self.assertEqual(report_errors.location(mask), "the centre")
        mask[:] = False
        mask[0:3, :] = True
        self.assertEqual(report_errors.location(mask), "the upper third")
        mask[:] = True
        self.assertEqual(report_errors.location(mask), "all parts of the image")

    def test_packed_stokes_keeps_its_documented_resolution(self):
        import base64
        import zlib
        generator = numpy.random.default_rng(4)
        stokes = generator.uniform(0, 2, (kHeight, kWidth, 4, 3))
        stokes[:, :, 1:] = stokes[:, :, :1] * generator.uniform(-0.7, 0.7, (kHeight, kWidth, 3, 3))
        packed = report_images.packed_stokes(stokes)
        planes = numpy.frombuffer(zlib.decompress(base64.b64decode(packed["data"])), numpy.uint8)
        planes = numpy.cumsum(planes.reshape(12, kHeight, kWidth), axis=2, dtype=numpy.uint8).transpose(1, 2, 0)
        level = (planes[:, :, 0:3].astype(float) * 256 + planes[:, :, 3:6]) / 65535
        s0 = packed["largest"] * level**2
        self.assertLess(numpy.abs(s0 - numpy.minimum(stokes[:, :, 0], packed["largest"])).max(), 2 / 30000)
        for at, s in ((6, 1), (9, 2)):
            relative = (planes[:, :, at:at + 3].astype(float) - 128) / 127
            self.assertLess(numpy.abs(relative - stokes[:, :, s] / stokes[:, :, 0]).max(), 0.00395)

    def test_choices_are_points(self):
        method = {"scene": "a", "renderer": "embree", "method": "stokes", "width": 8, "height": 8, "depth": 2, "status": "ok",
                  "medianMs": 3.0, "error": {"relRms": 0.0}}
        choice = {**method, "medianMs": 1.0, "error": {"relRms": 0.004, "shareOver1Percent": 0.1}, "displayRelRms": 0.003,
                  "maxErrors": [0.01, 0.05], "parts": ["without highlights", "depth 1"]}
        results = {"scenes": {"a": {}}, "rows": [method], "references": [], "rowsWithinError": [choice]}
        (group,) = report_data.group_rows(results)
        self.assertEqual(group.points("embree"), [method, choice])
        self.assertEqual(group.points("vulkan"), [])
        self.assertEqual(report_data.pareto(group.points("embree")), [choice, method])
        self.assertEqual([report_choices.point_name(row) for row in group.points("embree")],
                         ["stokes", "≤ 1 and 5 %"])
        (entry,) = report_choices.choice_table(group)
        self.assertEqual((entry["within"], entry["parts"], entry["error"]),
                         ("1 % and 5 %", "without highlights, depth 1", 0.003))
        self.assertIn("≤ 1 and 5 %", report_plots.error_against_time(group, "embree"))

    def test_pareto_front(self):
        make = lambda ms, rms: {"status": "ok", "medianMs": ms, "error": {"relRms": rms}}  # noqa: E731
        rows = [make(3, 0.1), make(1, 0.5), make(2, 0.5), make(4, 0.2), make(5, 0.01)]
        self.assertEqual(report_data.pareto(rows), [rows[1], rows[0], rows[4]])

    def test_blocks_are_averaged(self):
        image = numpy.arange(24, dtype=float).reshape(4, 6, 1)
        self.assertEqual(report_images.shrunk(image, 3)[:, :, 0].tolist(), [[3.5, 5.5, 7.5], [15.5, 17.5, 19.5]])


if __name__ == "__main__":
    unittest.main()
