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
import malus_rules  # noqa: E402
import stock  # noqa: E402
import tables  # noqa: E402
from simplify import write_simplified  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
RENDERERS = {"reference": ["--backend", "reference"],
             "embree": ["--backend", "embree", "--method", "stokes", "--effects", "all"]}
STOCK_WIDTH, STOCK_COLOUR = 64, 1


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


def compare_scene(name: str, given: argparse.Namespace, folder: pathlib.Path) -> dict:
    # One pack for both renderers.
    replaced = write_simplified(command.SCENES / name / "scene.json", folder / "scene.json")
    command.malus(given.malus, "bake", folder / "scene.json", "-o", folder / "scene.pack")
    command.malus(given.malus, "unpack", folder / "scene.pack", "-o", folder / "unpacked")
    unpacked = export.Unpacked(folder / "unpacked")
    width, height = unpacked.json["resolution"]
    if width > given.width:
        width, height = given.width, round(given.width * height / width)

    # Render with Mitsuba, one wavelength after another.
    scenes = [export.mitsuba_scene(unpacked, c, width, height, environment=False) for c in range(3)]
    rules = [malus_rules.Rules(scenes[c], unpacked, c) for c in range(3)]
    other = np.stack([integrator.render(scenes[c], unpacked.up(), unpacked.depth, rules[c])
                      .stokes.reshape(height, width, 4) for c in range(3)], axis=2)

    result = {"replaced": replaced, "leftOut": export.omissions(unpacked), "width": width, "height": height,
              "depth": unpacked.depth, "meanS0": difference.mean_light(other).tolist()}
    for renderer, arguments in RENDERERS.items():
        file = folder / f"{renderer}.exr"
        command.malus(given.malus, "render", folder / "scene.pack", *arguments, "--width", str(width), "--height", str(height),
              "-o", file)
        image = read_stokes(file)
        result[renderer] = difference.statistics(image, other)
        explained = difference.explained(image, other, scenes, unpacked, rules)
        at = np.flatnonzero(difference.outliers(image, other))[~explained]
        result[renderer] |= {"unexplained": len(at), "unexplainedAt": [[int(i % width), int(i // width)] for i in at]}

    # Compare with the integrators of Mitsuba.
    small = min(width, STOCK_WIDTH)
    result["stock"] = stock.compare(unpacked, STOCK_COLOUR, small, round(small * height / width), given.samples)
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
