"""Ellipsometry: eta and k of a metal from images of a flat sample at several angles of incidence.

A beam that is polarized at 45 degrees, from a display through a polarizer, is reflected by the sample. The ratio of its
reflected p and s amplitudes, tan(psi) e^{i delta}, follows from the Stokes vectors that the camera records, and eta - i k
from that (R. Azzam and N. Bashara, Ellipsometry and Polarized Light, 1977, section 4.2, closed form for one interface). The
renderer's constants are the truth.

    python3 ellipsometry.py [PRESET]
"""

import json
import pathlib
import sys
import tempfile

import malus
import numpy as np

ANGLES = (55.0, 65.0, 72.0, 78.0)


def write_quad(file, centre, normal, size):
    """A square, as OBJ, facing its normal."""
    normal = np.array(normal) / np.linalg.norm(normal)
    u = np.array([0.0, 1.0, 0.0])
    v = np.cross(normal, u)
    corners = [np.array(centre) + size * (a * u + b * v) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    lines = ["v {:.9f} {:.9f} {:.9f}".format(*corner) for corner in corners]
    area = np.cross(corners[1] - corners[0], corners[2] - corners[1])
    lines.append("f 1 2 3 4" if area @ normal > 0 else "f 4 3 2 1")
    file.write_text("\n".join(lines) + "\n")


def write_scene(folder, preset, degrees):
    """The sample in the plane z = 0; camera and light in the plane y = 0."""
    t = np.radians(degrees)
    light = np.array([np.sin(t), 0, np.cos(t)])
    write_quad(folder / "sample.obj", (0, 0, 0), (0, 0, 1), 0.5)
    write_quad(folder / "sheet.obj", 2 * light, -light, 1)
    write_quad(folder / "lamp.obj", 3 * light, -light, 1)
    axis = np.cross(light, (0, 1, 0)) + (0, 1, 0)  # at 45 degrees to the plane of incidence
    scene = {"malus": 1, "name": "ellipsometer", "resolution": [9, 9], "depth": 4,
             "camera": {"position": [-3 * np.sin(t), 0, 3 * np.cos(t)], "target": [0, 0, 0], "verticalFovDegrees": 0.5},
             "environment": {"radiance": [0, 0, 0]},
             "materials": {"sample": {"type": "metal", "preset": preset},
                           "sheet": {"type": "polarizer", "axis": list(axis)},
                           "lamp": {"type": "emitter", "radiance": [1, 1, 1]}},
             "meshes": [{"name": name, "file": f"{name}.obj", "material": name} for name in ("sample", "sheet", "lamp")]}
    file = folder / f"scene-{degrees:g}.json"
    file.write_text(json.dumps(scene))
    return file


def measured_ratio(stokes):
    """r_p / r_s per colour, from a Stokes vector whose x axis is in the plane of incidence (p), for light that
    arrives at 45 degrees."""
    s0, s1, s2, s3 = np.moveaxis(stokes, -1, 0)
    power_p, power_s = (s0 + s1) / 2, (s0 - s1) / 2
    return np.sqrt(power_p / power_s) * np.exp(1j * np.arctan2(s3, s2))


def index_from_ratio(rho, degrees):
    """eta - i k of an opaque sample: eta^2 = sin^2 (1 + tan^2 ((1 - rho)/(1 + rho))^2)."""
    t = np.radians(degrees)
    index = np.sqrt(np.sin(t)**2 * (1 + np.tan(t)**2 * ((1 - rho) / (1 + rho))**2) + 0j)
    return np.where(index.real < 0, -index, index)


def main():
    preset = sys.argv[1] if len(sys.argv) > 1 else "gold"
    found = []
    with tempfile.TemporaryDirectory() as temporary:
        for degrees in ANGLES:
            image = malus.bake(write_scene(pathlib.Path(temporary), preset, degrees)).render()
            middle = image.stokes[image.height // 2, image.width // 2].astype(float)
            found.append(index_from_ratio(measured_ratio(middle), degrees))
    found = np.array(found)
    found = found.real - 1j * abs(found.imag)  # the sign of delta depends on the side from which the beam is seen
    for colour, wavelength, values in zip(("red", "green", "blue"), (630, 532, 465), found.T):
        truth, mean = malus.material(preset).index(wavelength), values.mean()
        print(f"{colour}: eta {mean.real:.4f} (true {truth.real:.4f}), k {-mean.imag:.4f} (true {-truth.imag:.4f}), "
              f"spread over {len(ANGLES)} angles {abs(values - mean).max():.1e}")


if __name__ == "__main__":
    main()
