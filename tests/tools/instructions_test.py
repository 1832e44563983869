#!/usr/bin/python3
"""Effects that are off cost no instructions. Counts the instructions of Embree's renderer with valgrind's callgrind,
whose counts do not depend on the load of the machine. Environment: MALUS the command, MALUS_PROBE the program
instructions_probe, MALUS_SCENES the folder of scenes, MALUS_MOST_BYTES the largest size of the command (absent: not
checked)."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

kMalus = os.environ["MALUS"]
kProbe = os.environ["MALUS_PROBE"]
kScenes = pathlib.Path(os.environ["MALUS_SCENES"])
kTolerance = 3e-3  # relative difference between two counts of the same work, by scheduler and allocator


def run(*arguments) -> str:
    done = subprocess.run([str(a) for a in arguments], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise AssertionError(f"{arguments}: {done.stderr}")
    return done.stdout


def plain_material(m: dict) -> dict:
    """Returns the material without the keys of optional effects."""
    if "albedoMap" in m:
        m.setdefault("albedo", 1)
    optional = ("absorption", "outsideAbsorption", "coating", "roughness", "polarization", "albedoMap", "etaMap", "kMap",
                "projection", "specularFactor", "clearCoat")
    return {key: value for key, value in m.items() if key not in optional}


class Instructions(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        cls.packs = {}

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def pack(self, scene: str, plain: bool = False) -> pathlib.Path:
        name = pathlib.Path(scene).name + ("-plain" if plain else "")
        if name not in self.packs:
            source = kScenes / scene
            if plain:
                copied = self.folder / (name + "-source")
                shutil.copytree(source, copied)
                text = json.loads((copied / "scene.json").read_text())
                text["materials"] = {key: plain_material(m) for key, m in text["materials"].items()}
                text["environment"].pop("sky", None) if "environment" in text else None
                (copied / "scene.json").write_text(json.dumps(text))
                source = copied
            self.packs[name] = self.folder / (name + ".pack")
            run(kMalus, "bake", source / "scene.json", "-o", self.packs[name])
        return self.packs[name]

    def counts(self, images: list) -> list:
        """Returns the instructions of each image (pack, method, removed effect, effects)."""
        out = self.folder / "callgrind"
        for old in self.folder.glob("callgrind*"):
            old.unlink()
        run("valgrind", "--tool=callgrind", f"--callgrind-out-file={out}",
            "--collect-atstart=no", kProbe, *(a for p in images for a in p))
        found = []
        for i in range(1, len(images) + 1):
            text = (self.folder / f"callgrind.{i}").read_text(errors="replace")
            found.append(int(re.search(r"^(?:summary|totals): (\d+)", text, re.MULTILINE).group(1)))
            self.assertGreater(found[-1], 100000)  # something was counted
        return found

    def test_an_effect_that_is_off_costs_nothing(self):
        scenes = {"textures": "textures", "absorption": "absorption", "polarized-sky": "sky",
                  "display": "polarized-emitters", "coating": "coatings", "rough-reflection": "roughness"}
        cases = [(scene, effect, method) for scene, effect in scenes.items() for method in ("importance", "stokes")]
        images = []
        for scene, effect, method in cases:
            pack, plain = self.pack(f"effects/{scene}"), self.pack(f"effects/{scene}", plain=True)
            images += [(plain, method, "-", "auto"), (pack, method, effect, "auto"), (pack, method, "-", "auto")]
        counts = self.counts(images)
        for i, (scene, _, method) in enumerate(cases):
            without, off, on = counts[3 * i:3 * i + 3]
            print(f"{scene} {method}: without {without}, off {off}, on {on}")
            with self.subTest(scene=scene, method=method):
                self.assertLess(abs(off - without), kTolerance * without)
                self.assertGreater(on, without)

    def test_auto_does_less_than_all(self):
        cases = [(scene, method) for scene in ("hard/mirror-loop", "hard/glass-slab")
                 for method in ("schlick-iterative", "stokes")]
        counts = self.counts([(self.pack(scene), method, "-", effects) for scene, method in cases
                              for effects in ("auto", "all")])
        for i, (scene, method) in enumerate(cases):
            some, everything = counts[2 * i:2 * i + 2]
            print(f"{scene} {method}: auto {some}, all {everything}")
            with self.subTest(scene=scene, method=method):
                self.assertLess(some, 0.99 * everything)

    def test_polarization_without_effect_costs_nothing(self):
        # With one interaction no path has two diattenuators, and the command uses fresnel, which is counted here.
        pack = self.pack("hard/glass-slab")
        output = run(kMalus, "render", pack, "--backend", "embree", "--method", "stokes", "--depth", "1", "--intensity",
                   "--width", "24", "-o", self.folder / "image.png")
        self.assertRegex(output, r"\bfresnel\b.*\bstokes\b")
        fresnel, stokes = self.counts([(pack, method, "-", "DEPTH=1") for method in ("fresnel", "stokes")])
        print(f"depth 1: fresnel {fresnel}, stokes {stokes}")
        self.assertLess(fresnel, 0.95 * stokes)

    def test_the_builds_stay_small(self):
        most = os.environ.get("MALUS_MOST_BYTES")
        if not most:
            self.skipTest("MALUS_MOST_BYTES is not set")
        self.assertLess(os.path.getsize(kMalus), int(most))


if __name__ == "__main__":
    unittest.main()
