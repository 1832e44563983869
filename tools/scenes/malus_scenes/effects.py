"""The scenes under scenes/effects, each of which needs one effect: folder to writer."""
from . import effects_light, effects_surfaces

WRITERS = [
    effects_surfaces.textures, effects_surfaces.coating, effects_surfaces.rough_reflection, effects_surfaces.thin_glass,
    effects_light.absorption, effects_light.polarized_sky, effects_light.display, effects_light.polarizing_sheets,
]
SCENES = {"effects/" + writer.__name__.replace("_", "-"): writer for writer in WRITERS}
