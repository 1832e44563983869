"""Prints the images that gpu-check renders and the tolerances of their differences, one per line:

    PACK METHOD WIDTH REFERENCE THRESHOLD OUTLIERS

from the tolerances of the tests (TESTS/render/tolerances.json, TESTS/hard_cases/tolerances.json). WIDTH 0: the scene's.

    checks.py TESTS
"""
import json
import pathlib
import sys

kScenes = {"glass-wall": (1920, 1080), "cornell-box": (1, 1), "engine": (1, 1)}


def main() -> None:
    tests = pathlib.Path(sys.argv[1])
    small = json.loads((tests / "render/tolerances.json").read_text())
    width = small["width"]
    # The most important ones first: gpu-check leaves out the last ones if its time does not suffice.
    for method, reference, kind in (("stokes", "reference", "reference"), ("importance", "reference", "reference"),
                                    ("fresnel", "fresnel", "stored"), ("schlick", "schlick", "stored"),
                                    ("sp", "sp", "stored")):
        for scene, (w, h) in kScenes.items():
            pixels = width * round(width * h / w)
            print(scene, method, width, f"{scene}-{reference}.exr", small[kind]["threshold"],
                  int(small[kind]["outlierShare"] * pixels))
    hard = json.loads((tests / "hard_cases/tolerances.json").read_text())
    for method in ("stokes", "importance"):
        for scene, bounds in hard.items():
            if bounds.get("renderersAgree", True):
                print(f"hard/{scene}", method, 0, f"hard/{scene}.exr", bounds["threshold"], bounds["outliers"])


if __name__ == "__main__":
    main()
