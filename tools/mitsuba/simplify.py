"""Rewrites a scene.json (bake/SCENE.md) into one that malus and Mitsuba shade alike.

Mitsuba lacks polarized light from a Lambert surface under a smooth interface, a Phong lobe for point lights only,
diffuse light under a metal, and ambient light without interreflection. These are replaced or removed, each with a
sentence; everything else is kept. Materials of imported files are not changed.
"""
import json
import pathlib


def simplified(scene: dict) -> tuple[dict, list[str]]:
    """Returns the new scene and a sentence for each change."""
    scene, changes = json.loads(json.dumps(scene)), []
    for name, m in scene["materials"].items():
        if m.pop("highlight", None) is not None:
            changes.append(f"Material '{name}': the highlight is removed.")
        if m["type"] == "paint":
            scene["materials"][name] = {k: m[k] for k in ("albedo", "outsideEta") if k in m} | {"type": "lambert"}
            changes.append(f"Material '{name}': paint becomes bare Lambert of the same albedo.")
        if m["type"] == "metal" and m.pop("albedo", None) is not None:
            changes.append(f"Material '{name}': the diffuse light under the metal is removed.")
    environment = scene.get("environment", {})
    if max(environment.pop(key, 0) for key in ("ambientIrradiance", "diffuseFill")) > 0:  # diffuseFill: deprecated
        changes.append("The ambient light on diffuse surfaces (ambientIrradiance) becomes 0.")
    if environment.pop("illuminates", False):
        changes.append("The light of the environment on diffuse surfaces (illuminates) is removed.")
    return scene, changes


def write_simplified(source: pathlib.Path, target: pathlib.Path) -> list[str]:
    """Reads a scene.json and writes the simplified one with absolute paths. Returns a sentence for each change."""
    folder = source.resolve().parent
    scene, changes = simplified(json.loads(source.read_text()))
    for entry in scene.get("meshes", []) + scene.get("imports", []):
        entry["file"] = str(folder / entry["file"])
    if "image" in scene.get("environment", {}):
        scene["environment"]["image"] = str(folder / scene["environment"]["image"])
    target.write_text(json.dumps(scene, indent=1))
    return changes
