"""Shape from polarization: the normals of a painted sphere from the degree and angle of polarization of one image.

Light that leaves paint is polarized by the refraction at its surface, in the plane of the normal and the ray: the angle
of polarization gives the normal's azimuth up to half a turn, the degree its zenith (G. Atkinson and E. Hancock, Recovery
of surface orientation from diffuse polarization, IEEE Transactions on Image Processing 15(6), 2006). The half turn is
chosen by the knowledge that the sphere is convex. The result is compared with the ground truth of the same image. In the
dark nothing is reflected at the surface, and the method is exact; in a bright room the error that is printed is that of the
method, because reflected light is polarized across the plane.

    python3 shape_from_polarization.py [FOLDER]
"""

import json
import pathlib
import sys
import tempfile

import malus
import numpy as np

ETA = 1.5


def write_sphere(file, rings=96, around=192):
    """A unit sphere with its normals, as OBJ."""
    lines = []
    for i in range(rings + 1):
        for j in range(around):
            theta, phi = np.pi * i / rings, 2 * np.pi * j / around
            p = np.sin(theta) * np.cos(phi), np.cos(theta), np.sin(theta) * np.sin(phi)
            lines.append("v {:.9f} {:.9f} {:.9f}".format(*p))
    for i in range(rings):
        for j in range(around):
            a, b = 1 + i * around + j, 1 + i * around + (j + 1) % around
            c, d = a + around, b + around
            if i > 0:
                lines.append(f"f {a} {b} {c}")
            if i + 1 < rings:
                lines.append(f"f {b} {d} {c}")
    file.write_text("\n".join(lines) + "\n")


def write_scene(folder, room):
    """The sphere under lamps around the camera, in a room of uniform radiance."""
    write_sphere(folder / "sphere.obj")
    lamps = [{"type": "point", "position": [4 * x, 4 * y, 6], "intensity": [60, 60, 60]} for x, y in ((1, 1), (-1, 1), (1, -1), (-1, -1))]
    scene = {"malus": 1, "name": "painted-sphere", "resolution": [480, 480], "depth": 1,
             "camera": {"position": [0, 0, 12], "target": [0, 0, 0], "orthographicHeight": 2.3},
             "environment": {"radiance": [room, room, room]}, "lights": lamps,
             "materials": {"paint": {"type": "paint", "albedo": [0.7, 0.7, 0.7], "eta": [ETA, ETA, ETA]}},
             "meshes": [{"name": "sphere", "file": "sphere.obj", "material": "paint"}]}
    file = folder / "scene.json"
    file.write_text(json.dumps(scene))
    return file


def diffuse_dolp(zenith):
    """Degree of polarization of light that leaves a dielectric at an angle to the normal: (T_p - T_s)/(T_p + T_s)."""
    rs, rp = malus.material(eta=ETA).reflectance(np.degrees(zenith))
    return (rs - rp) / (2 - rs - rp)


def normals_from_polarization(dolp, aolp, away):
    """Normals in the axes of an orthographic camera. away: direction in the image, away from the object's middle, that
    decides between the two azimuths."""
    zeniths = np.linspace(0, np.radians(89.9), 2000)
    zenith = np.interp(dolp, diffuse_dolp(zeniths), zeniths)
    azimuth = aolp[..., None] + np.array([0, np.pi])
    directions = np.stack([np.cos(azimuth), np.sin(azimuth)], axis=-1)
    best = np.argmax((directions * away[..., None, :]).sum(-1), axis=-1)
    direction = np.take_along_axis(directions, best[..., None, None], axis=-2)[..., 0, :]
    return np.concatenate([direction * np.sin(zenith)[..., None], np.cos(zenith)[..., None]], axis=-1)


def measure_error(image):
    """Angles between the normals that are found and the true ones, in degrees."""
    valid = image.truth["Valid"] > 0
    y, x = np.mgrid[0:image.height, 0:image.width]
    away = np.stack([x + 0.5 - image.width / 2, image.height / 2 - y - 0.5], axis=-1)
    found = normals_from_polarization(image.dolp()[..., 1], image.aolp()[..., 1], away)
    cosine = np.clip((found * image.truth["NormalCamera"]).sum(-1)[valid], -1, 1)
    return np.degrees(np.arccos(cosine))


def main():
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        for name, room in (("dark", 0.0), ("room", 0.3)):
            image = malus.bake(write_scene(folder, room)).render(ground_truth=True)
            error = measure_error(image)
            print(f"{name}: {error.size} pixels, median error {np.median(error):.2f} degrees, mean {error.mean():.2f}, "
                  f"95 % below {np.percentile(error, 95):.2f}")
            if len(sys.argv) > 1:
                image.save(folder / f"{name}.png")


if __name__ == "__main__":
    main()
