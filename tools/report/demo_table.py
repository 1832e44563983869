#!/usr/bin/env python3
"""Prints the table of tools/demo: scene, renderer, method, rays, time, error against the reference."""
import json
import pathlib
import sys

HEAD = ("scene", "renderer", "method", "rays", "ms", "RMS error", "|err| > 0.01")


def rows(folder: pathlib.Path):
    for scene in ("glass-wall", "cornell-box", "engine"):
        for renderer in ("vulkan", "embree"):
            for method in ("schlick", "fresnel", "sp"):
                stem = folder / scene / f"{renderer}-{method}"
                cost = json.loads(stem.with_suffix(".json").read_text())
                error = json.loads(stem.with_suffix(".error.json").read_text())
                yield (scene, renderer, method, f"{cost['rays']:,}", f"{cost['traceMs']:,.0f}", f"{error['rms']:.4f}",
                       f"{100 * error['outliers'] / error['pixels']:.2f} %"), cost["device"]


def main() -> None:
    table, devices = [], {}
    for row, device in rows(pathlib.Path(sys.argv[1])):
        table.append(row)
        devices[row[1]] = device
    widths = [max(len(r[i]) for r in [HEAD, *table]) for i in range(len(HEAD))]
    for row in [HEAD, *table]:
        print("  ".join(cell.ljust(w) if i < 3 else cell.rjust(w) for i, (cell, w) in enumerate(zip(row, widths))))
    print("\nTimes cover tracing of one image, after a warm-up render of one pixel. Errors are those of R, G, B")
    print("relative to the double-precision reference with full Stokes vectors.")
    for renderer, device in devices.items():
        print(f"{renderer}: {device}")


if __name__ == "__main__":
    main()
