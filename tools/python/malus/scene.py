"""Scene packs."""

import json

from malus._malus import _bake, _load, _Scene
from malus.image import Image


class Scene:
    """A scene pack in memory. Renderers and their acceleration structures stay from image to image."""

    def __init__(self, scene: _Scene):
        self._scene = scene

    @staticmethod
    def load(file) -> "Scene":
        """Reads a scene pack. Raises malus.Error for a file that is not one."""
        return Scene(_load(file))

    name = property(lambda self: self._scene.name, doc="Name of the scene.")
    width = property(lambda self: self._scene.width, doc="Pixels per row.")
    height = property(lambda self: self._scene.height, doc="Rows.")
    depth = property(lambda self: self._scene.depth, doc="Most specular interactions along a path.")
    triangles = property(lambda self: self._scene.triangles, doc="Triangles; a mesh that is placed twice counts once.")
    materials = property(lambda self: self._scene.materials, doc="Names of the materials, in the order of their indices.")
    meshes = property(lambda self: self._scene.meshes, doc="Names of meshes and instances, in the order of their indices.")
    effects = property(lambda self: self._scene.effects, doc="By name: (whether the scene needs the effect, why).")

    def render(self, *, method=None, backend="embree", width=None, height=None, camera=None, polarizer=None,
               analyser=None, wave_plate=None, effects=None, depth=None, samples=None, light_samples=None,
               region=(), materials=None, lights=None, environment=None, wavelengths=None, exposure=None,
               tolerance=0.0, stokes=True, ground_truth=False, threads=0, device="") -> Image:
        """Renders an image. Other Python threads run meanwhile, and Ctrl-C raises KeyboardInterrupt.

        Settings that are None are those of the scene. They mean what the keys of a batch mean (render/batch/BATCH.md):

        method         a name of malus.methods(); "stokes" by default. The backend "reference" ignores it.
        backend        "embree", "vulkan" or "reference" (double precision)
        width, height  pixels; one of them keeps the aspect
        camera         dict: "position", "target", "up" [m] or "pose" (3 or 4 rows of 4 numbers, from camera axes to
                       world space), and "verticalFovDegrees", "orthographicHeight" [m] or "intrinsics" (dict of fx,
                       fy, cx, cy in pixels)
        polarizer      angle of a linear polarizer in degrees, counter-clockwise from the image's x axis
        analyser       "right" or "left": circular
        wave_plate     axis in degrees, or (axis, retardance)
        effects        "auto" (what the image needs), "all", or a list of names
        depth          most specular interactions along a path
        samples        rays per pixel along each axis
        light_samples  rays to area lights, and to the environment, at each hit
        region         (x, y, width, height) in pixels
        materials      dict of changed values by material: {"gold": {"roughness": 0.2}}
        lights         True, False or a list of them, one per light
        environment    {"rotationDegrees": angle}
        wavelengths    three of red, green and blue [nm]
        exposure       of Image.save() as .png, in stops
        tolerance      of iterative methods: share of a source's radiance that a path may lose
        stokes         False: the intensity behind the filter alone, by a cheaper method where that is exact
        ground_truth   also compute Image.truth
        threads        0: all. device: of Vulkan, number or part of its name

        Raises malus.Error with the text of the command line.
        """
        if wave_plate is not None:
            axis, retardance = wave_plate if isinstance(wave_plate, (tuple, list)) else (wave_plate, 90)
            wave_plate = {"axisDegrees": axis, "retardanceDegrees": retardance}
        settings = {"method": method, "width": width, "height": height, "camera": camera, "polarizer": polarizer,
                    "analyser": analyser, "wavePlate": wave_plate, "effects": effects, "depth": depth,
                    "samples": samples, "lightSamples": light_samples, "materials": materials, "lights": lights,
                    "environment": environment, "wavelengthsNm": wavelengths, "exposure": exposure}
        text = json.dumps({key: value for key, value in settings.items() if value is not None}, default=_plain)
        return Image(self._scene.render(text, backend, device, threads, list(region), tolerance, stokes, ground_truth))

    def __repr__(self):
        return f"<malus.Scene '{self.name}'>"


def _plain(value):
    """numpy arrays and numbers as lists and numbers."""
    if hasattr(value, "tolist"):
        return value.tolist()
    raise TypeError(f"{type(value).__name__} is not a setting")


def bake(file, *, output=None, camera="", environment=None, allow_open_glass=False) -> Scene:
    """Bakes a scene.json or a model file (glTF, OBJ, PLY, STL, OFF), as `malus bake`.

    output: pack to write; None: none. camera: of a model file, name or number, or "frame" for a view of the whole
    model. environment: latitude-longitude image around a model. allow_open_glass: glass that is not a certified body
    is a warning. Raises malus.Error.
    """
    return Scene(_bake(file, output, camera, environment, allow_open_glass))
