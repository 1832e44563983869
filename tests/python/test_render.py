"""Images of the Python package against those of the command."""

import subprocess
import sys
import threading
import time

import malus
import numpy as np
import OpenImageIO as oiio
import pytest
from conftest import SCENES, run


def read(file):
    """Channels of an EXR file by name."""
    image = oiio.ImageInput.open(str(file))
    pixels = image.read_image("float")
    return {name: pixels[:, :, i] for i, name in enumerate(image.spec().channelnames)}


@pytest.mark.parametrize("name", ["glass-wall", "cornell-box"])
def test_pixels_are_those_of_the_command(packs, tmp_path, name):
    scene = malus.Scene.load(packs[name])
    image = scene.render(width=120, polarizer=30)
    assert run("render", packs[name], "-o", tmp_path / "a.exr", "--method", "stokes", "--width", 120, "--polarizer",
               30).returncode == 0
    channels = read(tmp_path / "a.exr")
    for c, colour in enumerate("RGB"):
        np.testing.assert_array_equal(image.rgb[:, :, c], channels[colour])
        for k in range(4):
            np.testing.assert_array_equal(image.stokes[:, :, c, k], channels[f"S{k}.{colour}"])
    assert (image.method, image.backend) == ("stokes", "embree")
    image.save(tmp_path / "b.exr")
    saved = read(tmp_path / "b.exr")
    assert saved.keys() == channels.keys()
    for key, values in saved.items():
        np.testing.assert_array_equal(values, channels[key])


def test_polarization_is_that_of_the_stokes_vectors(packs):
    image = malus.Scene.load(packs["glass-wall"]).render(width=64)
    s = image.stokes.astype(float)
    with np.errstate(divide="ignore", invalid="ignore"):
        dolp = np.where(s[..., 0] > 0, np.hypot(s[..., 1], s[..., 2]) / s[..., 0], 0)
    np.testing.assert_allclose(image.dolp(), np.clip(dolp, 0, 1), atol=1e-12)
    np.testing.assert_allclose(np.exp(2j * image.aolp()) * np.hypot(s[..., 1], s[..., 2]),
                               s[..., 1] + 1j * s[..., 2], atol=1e-12)


def test_arrays_are_views_that_outlive_the_image(packs):
    image = malus.Scene.load(packs["glass-wall"]).render(width=32)
    stokes, again = image.stokes, image.stokes
    assert stokes.shape == (image.height, 32, 3, 4) and stokes.dtype == np.float32
    assert np.shares_memory(stokes, again)
    assert not stokes.flags.writeable
    expected = stokes.copy()
    del image, again
    np.testing.assert_array_equal(stokes, expected)


def test_bake_gives_the_scene_of_the_command(packs, tmp_path):
    baked = malus.bake(SCENES / "glass-wall" / "scene.json")
    loaded = malus.Scene.load(packs["glass-wall"])
    assert (baked.name, baked.triangles, baked.effects) == (loaded.name, loaded.triangles, loaded.effects)
    np.testing.assert_array_equal(baked.render(width=48).stokes, loaded.render(width=48).stokes)
    malus.bake(SCENES / "glass-wall" / "scene.json", output=tmp_path / "a.pack")
    assert malus.Scene.load(tmp_path / "a.pack").name == loaded.name


def test_a_model_file_is_a_scene():
    scene = malus.bake(SCENES / "models" / "watch.glb")
    assert scene.render(width=40, light_samples=1).rgb.max() > 0


def test_errors_have_the_text_of_the_command(packs, tmp_path):
    missing = tmp_path / "none.pack"
    with pytest.raises(malus.Error) as error:
        malus.Scene.load(missing)
    assert f"malus: {error.value}" == run("render", missing, "-o", tmp_path / "a.png").stderr.strip()
    scene = malus.Scene.load(packs["glass-wall"])
    with pytest.raises(malus.Error, match="nosuch"):
        scene.render(method="nosuch")
    with pytest.raises(malus.Error, match="no Stokes vectors"):
        scene.render(method="schlick", width=8).stokes  # noqa: B018
    with pytest.raises(TypeError):
        scene.render(widht=8)


def test_other_threads_run_while_an_image_renders(packs):
    scene = malus.Scene.load(packs["cornell-box"])
    finished = threading.Event()
    worker = threading.Thread(target=lambda: (scene.render(width=400, samples=4), finished.set()))
    worker.start()
    ticks = 0
    while not finished.is_set():
        ticks += 1
        time.sleep(0.001)
    worker.join()
    assert ticks > 5


def test_two_threads_render_the_same_scene(packs):
    scene = malus.Scene.load(packs["cornell-box"])
    images = [None, None]

    def work(i):
        images[i] = scene.render(width=100).stokes.copy()

    workers = [threading.Thread(target=work, args=(i,)) for i in range(2)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    np.testing.assert_array_equal(images[0], images[1])


CTRL_C = """
import os, signal, sys, threading, malus
scene = malus.Scene.load(sys.argv[1])
threading.Timer(1.0, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
try:
    scene.render(width=4000, samples=16)
except KeyboardInterrupt:
    print("interrupted")
print(scene.render(width=20).width)
"""


def test_ctrl_c_raises_keyboard_interrupt(packs):
    start = time.monotonic()
    done = subprocess.run([sys.executable, "-c", CTRL_C, packs["cornell-box"]], capture_output=True, text=True,
                          timeout=120, check=False)
    assert done.stdout.split() == ["interrupted", "20"], done.stderr
    assert time.monotonic() - start < 60
