"""malus: polarized mirror and glass reflections, and what each level of accuracy costs.

    import malus
    scene = malus.bake("model.glb")                # or malus.Scene.load("engine.pack")
    image = scene.render(width=640, polarizer=90)
    print(image.stokes.shape, image.dolp().max())  # (480, 640, 3, 4) ...
    image.save("model.png")

Angles are in degrees unless stated, lengths in metres, wavelengths in nanometres. Colours are red, green and blue: 630,
532 and 465 nm unless the scene states others. Errors are malus.Error, a ValueError, with the text of the command line.
"""

from malus._malus import Error, Material, __version__, material, methods, presets
from malus.comparison import compare
from malus.image import Image
from malus.scene import Scene, bake

__all__ = ["Error", "Image", "Material", "Scene", "__version__", "bake", "compare", "material", "methods", "presets"]
