"""Scenes that grow in one number, for tools/scaling: finer engines, more lights, more panes of glass."""
import functools
import json

from . import cornell_box, engine
from .hard_scene import camera
from .scene import Part, write_scene
from .shapes import finer, quad


_counts = functools.cache(engine.counts)
_sky = functools.cache(engine.sky)


def write_engine(folder, steps):
    """Writes the engine with `steps` times as many sides and pieces of each shape: 2.0 million triangles at 14."""
    counts = _counts()
    with finer(steps):
        parts = engine.parts(*counts)
    for part in parts:
        part.blemishes = (0, 0)
    write_scene(folder, engine.SETTINGS, engine.MATERIALS, parts, None, _sky())


def write_lights(folder, count):
    """Writes the Cornell box with `count` point lights below the ceiling, which share the intensity of its light."""
    cornell_box.write(folder)
    scene = json.loads((folder / "scene.json").read_text(encoding="utf-8"))
    light = scene["lights"][0]
    intensity = [v / count for v in light["intensity"]]
    side = next(n for n in range(1, count + 1) if n * n >= count)
    scene["lights"] = [{**light, "intensity": intensity,
                        "position": [1.6 * ((i % side + 0.5) / side - 0.5), light["position"][1],
                                     1.6 * ((i // side + 0.5) / side - 0.5)]} for i in range(count)]
    (folder / "scene.json").write_text(json.dumps(scene, indent=1) + "\n", encoding="utf-8")


def write_panes(folder, count):
    """Writes `count` parallel panes of thin glass, tilted in front of a wall. The depth is count + 2, so that light
    from the wall passes through all panes, also after two reflections."""
    panes = [Part(f"pane-{i + 1}", "pane", quad((-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)), flat=True, sheet=True,
                  instances=[{"rotateDegrees": [0.0, 35.0, 0.0], "translate": [0.0, 0.0, -0.1 * i]}])
             for i in range(count)]
    z = -0.1 * count - 1.5
    wall = Part("wall", "wall", quad((-4, -4, z), (4, -4, z), (4, 4, z), (-4, 4, z)), flat=True)
    settings = {"name": "panes", "title": "Parallel panes of thin glass", "camera": camera((0, 0, 3), (0, 0, 0), 30),
                "resolution": [512, 512], "depth": count + 2, "environment": {"radiance": [0.3, 0.35, 0.4]},
                "lights": [{"type": "point", "position": [0.0, 2.0, 3.0], "intensity": [20.0, 20.0, 20.0]}]}
    materials = {"pane": {"type": "thin-glass", "eta": 1.5},
                 "wall": {"type": "paint", "eta": 1.5, "albedo": [0.6, 0.5, 0.4]}}
    write_scene(folder, settings, materials, [*panes, wall], None)
