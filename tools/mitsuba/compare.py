"""Renders scenes with malus and with Mitsuba 3 and reports the differences; see tools/mitsuba/README.md.

Run by tools/mitsuba/compare, which finds the interpreter. Exit codes: 0 within tools/mitsuba/tolerances.json,
3 not within, 1 failed (one line).
"""
import argparse
import json
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True

import export  # noqa: E402  (chooses Mitsuba's variant)
import mitsuba as mi  # noqa: E402
import numpy as np  # noqa: E402

import command  # noqa: E402
import difference  # noqa: E402
import integrator  # noqa: E402
import lamps  # noqa: E402
import malus_rules  # noqa: E402
import stock  # noqa: E402
import tables  # noqa: E402
import textured  # noqa: E402
from simplify import write_simplified  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
RENDERERS = {"reference": ["--backend", "reference"],
             "embree": ["--backend", "embree", "--method", "stokes", "--effects", "all"]}
STOCK_WIDTH, STOCK_COLOUR = 64, 1
FINER = 9  # odd
LAMP_WIDTH = 96
LAMP_BATCHES, LAMP_SAMPLES, MITSUBA_LAMP_SAMPLES = 32, 16, 256  # independent images, and samples of each per pixel


def options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="tools/mitsuba/compare", description=__doc__.splitlines()[0])
    command.add_options(parser, width=256, scenes="those with tolerances")
    parser.add_argument("--samples", type=int, default=1024, help="samples per pixel of Mitsuba's integrators")
    return command.parse(parser, "samples")


def read_stokes(path: pathlib.Path) -> np.ndarray:
    """Reads an EXR file of malus as (height, width, colour, 4)."""
    bitmap = mi.Bitmap(str(path))
    names, pixels = [field.name for field in bitmap.struct_()], np.array(bitmap, dtype=np.float64)
    return np.stack([np.stack([pixels[..., names.index(f"S{k}.{c}")] for c in "RGB"], -1) for k in range(4)], -1)


class Comparison:
    """A scene pack that both renderers read, and its images."""

    def __init__(self, name: str, given: argparse.Namespace, folder: pathlib.Path):
        self.given, self.folder = given, folder
        source = command.SCENES / name / "scene.json"
        if name in textured.SCENES:
            source = textured.write(name, folder)
        self.replaced = write_simplified(source, folder / "simplified.json")
        self.pack = folder / "scene.pack"
        command.malus(given.malus, "bake", folder / "simplified.json", "-o", self.pack)
        command.malus(given.malus, "unpack", self.pack, "-o", folder / "unpacked")
        self.unpacked = export.Unpacked(folder / "unpacked")
        self.width, self.height = self.unpacked.json["resolution"]
        most = min(given.width, LAMP_WIDTH) if self.unpacked.has_lamps() else given.width
        if self.width > most:
            self.width, self.height = most, round(most * self.height / self.width)
        self.scenes = [export.mitsuba_scene(self.unpacked, c, self.width, self.height, environment=False)
                       for c in range(3)]
        self.rules = [malus_rules.Rules(self.scenes[c], self.unpacked, c) for c in range(3)]

    def ours(self, renderer: str, width: int, *options: str) -> np.ndarray:
        """Returns the image (height, width, colour, 4) of malus. With textures it is that of the middle pixels of an
        image of FINER times as many in both directions: they have the same rays with narrower cones, so that malus
        reads level 0 of every texture."""
        finer = FINER if self.unpacked.json["textures"] else 1
        file = self.folder / f"{renderer}.exr"
        command.malus(self.given.malus, "render", self.pack, *RENDERERS[renderer], "--width", str(finer * width),
                      "--height", str(finer * self.height), *options, "-o", file)
        return read_stokes(file)[finer // 2::finer, finer // 2::finer]

    def mitsuba(self, **options) -> np.ndarray:
        """Returns the Stokes vectors (pixels, colour, 4) of Mitsuba, one wavelength after another."""
        return np.stack([integrator.render(self.scenes[c], self.unpacked.up(), self.unpacked.depth, self.rules[c],
                                           **options).stokes for c in range(3)], axis=1)

    def description(self, other: np.ndarray) -> dict:
        return {"replaced": self.replaced, "leftOut": export.omissions(self.unpacked), "width": self.width,
                "height": self.height, "depth": self.unpacked.depth, "meanS0": difference.mean_light(other).tolist()}


def compare_scene(name: str, given: argparse.Namespace, folder: pathlib.Path) -> dict:
    both = Comparison(name, given, folder)
    width, height, unpacked = both.width, both.height, both.unpacked
    if unpacked.has_lamps():
        return compare_lamps(both)
    other = both.mitsuba().reshape(height, width, 3, 4)
    result = both.description(other)
    for renderer in RENDERERS:
        image = both.ours(renderer, width)
        result[renderer] = difference.statistics(image, other)
        explained = difference.explained(image, other, both.scenes, unpacked, both.rules)
        at = np.flatnonzero(difference.outliers(image, other))[~explained]
        result[renderer] |= {"unexplained": len(at), "unexplainedAt": [[int(i % width), int(i // width)] for i in at]}

    # Compare with the integrators of Mitsuba.
    small = min(width, STOCK_WIDTH)
    result["stock"] = stock.compare(unpacked, STOCK_COLOUR, small, round(small * height / width), given.samples)
    return result


def compare_lamps(both: Comparison) -> dict:
    """Compares a scene whose diffuse surfaces are lit by lamps, by samples on both sides."""
    others = [both.mitsuba(lamps=lamps.Lamps(MITSUBA_LAMP_SAMPLES, seed)) for seed in range(LAMP_BATCHES)]
    result = both.description(np.mean(others, axis=0)[None]) | {"lamps": {}}
    for renderer in RENDERERS:
        # An image that is wider by 2 i columns has the same rays i columns further right. malus rotates the samples of
        # a pixel by a hash of its position, so that these images are independent.
        ours = [both.ours(renderer, both.width + 2 * i, "--light-samples", str(LAMP_SAMPLES))[:, i:i + both.width]
                .reshape(-1, 3, 4) for i in range(LAMP_BATCHES)]
        result["lamps"][renderer] = lamps.compare(ours, others)
    return result


def main() -> int:
    given = options()
    tolerances = json.loads((HERE / "tolerances.json").read_text())
    names = given.scenes.split(",") if given.scenes else list(tolerances["scenes"])
    results = {}
    for name in names:
        if sys.stderr.isatty():
            print(f"mitsuba/compare: {name}", file=sys.stderr)
        with tempfile.TemporaryDirectory(prefix="malus-mitsuba-") as folder:
            results[name] = compare_scene(name, given, pathlib.Path(folder))
    failures = tables.failures(results, tolerances)
    print(tables.markdown(results))
    for line in failures:
        print(f"NOT WITHIN TOLERANCE: {line}")
    if given.json:
        report = {"mitsuba": mi.__version__, "variant": mi.variant(), "wavelengthsNm": export.WAVELENGTHS_NM,
                  "scenes": results, "failures": failures}
        given.json.write_text(json.dumps(report, indent=1) + "\n")
    return 3 if failures else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except (OSError, RuntimeError, ValueError, KeyError) as error:
        print(f"mitsuba/compare: {' '.join(str(error).split())}", file=sys.stderr)
        sys.exit(1)
