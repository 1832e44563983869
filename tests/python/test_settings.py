"""Settings of an image, ground truth and the stubs."""

import ast
import inspect
import pathlib

import malus
import numpy as np
import pytest

PACKAGE = pathlib.Path(malus.__file__).parent


@pytest.fixture(scope="module")
def scene(packs):
    return malus.Scene.load(packs["cornell-box"])


def test_a_camera_moves_and_the_next_image_has_the_old_one(scene):
    before = scene.render(width=40).stokes.copy()
    moved = scene.render(width=40, camera={"position": [0.1, 1, 3], "target": [0, 1, 0]})
    assert not np.array_equal(moved.stokes, before)
    np.testing.assert_allclose(np.array(moved.camera["cameraToWorld"])[:3, 3], [0.1, 1, 3], atol=1e-12)
    np.testing.assert_array_equal(scene.render(width=40).stokes, before)


def test_numpy_values_are_settings(scene):
    pose = np.array(scene.render(width=8).camera["cameraToWorld"])
    image = scene.render(width=np.int64(40), camera={"pose": pose})
    np.testing.assert_allclose(image.stokes, scene.render(width=40).stokes, rtol=1e-4, atol=1e-5)


def test_ground_truth_is_consistent(scene):
    image = scene.render(width=60, ground_truth=True)
    truth = image.truth
    valid = truth["Valid"] > 0
    assert truth["Depth"].shape == (image.height, 60) and truth["Position"].shape == (image.height, 60, 3)
    camera = np.array(image.camera["worldToCamera"])
    position = truth["Position"] @ camera[:3, :3].T + camera[:3, 3]
    np.testing.assert_allclose(-position[..., 2][valid], truth["Depth"][valid], rtol=1e-5)
    np.testing.assert_allclose(np.linalg.norm(truth["Normal"][valid], axis=-1), 1, atol=1e-6)
    names = scene.materials
    assert all(0 <= i < len(names) for i in np.unique(truth["IndexMA"][valid]).astype(int))
    with pytest.raises(malus.Error, match="ground_truth"):
        scene.render(width=8).truth  # noqa: B018


def test_a_region_is_part_of_the_image(scene):
    whole = scene.render(width=64)
    part = scene.render(width=64, region=(8, 16, 24, 32))
    np.testing.assert_array_equal(part.stokes, whole.stokes[16:48, 8:32])


def test_wrong_settings_are_errors(scene):
    for settings, words in (({"materials": {"nosuch": {}}}, "nosuch"), ({"camera": {"positon": [0, 0, 0]}}, "positon"),
                            ({"width": 0}, "width"), ({"effects": ["nosuch"]}, "nosuch"),
                            ({"polarizer": 0, "analyser": "right"}, "analyser"), ({"region": (0, 0, 9999, 1)}, "region"),
                            ({"backend": "nosuch"}, "nosuch")):
        with pytest.raises(malus.Error, match=words):
            scene.render(**{"width": 16, **settings})


def parameters(function):
    return [name for name in inspect.signature(function).parameters if name != "self"]


def test_the_stubs_have_the_names_of_the_package():
    stubs = ast.parse((PACKAGE / "__init__.pyi").read_text())
    classes = {node.name: node for node in stubs.body if isinstance(node, ast.ClassDef)}
    functions = {node.name: node for node in stubs.body if isinstance(node, ast.FunctionDef)}
    assert set(malus.__all__) - {"__version__"} == classes.keys() | functions.keys()
    for name in ("Scene", "Image"):
        stub = {node.name for node in classes[name].body if isinstance(node, ast.FunctionDef)}
        assert stub == {member for member in vars(getattr(malus, name)) if not member.startswith("_")}
    for owner, name, node in [(malus, n, functions[n]) for n in ("bake", "compare")] + [
            (malus.Scene, n.name, n) for n in classes["Scene"].body
            if isinstance(n, ast.FunctionDef) and n.name in ("load", "render")]:
        stub = [a.arg for a in node.args.args + node.args.kwonlyargs if a.arg != "self"]
        assert stub == parameters(getattr(owner, name)), name


def test_everything_public_is_documented():
    for name in malus.__all__:
        if name not in ("Error", "__version__"):
            assert inspect.getdoc(getattr(malus, name)), name
    for owner in (malus.Scene, malus.Image, malus.Material):
        for name, member in vars(owner).items():
            if not name.startswith("_") and name != "name":
                assert inspect.getdoc(member), f"{owner.__name__}.{name}"
