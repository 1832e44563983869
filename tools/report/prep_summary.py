#!/usr/bin/env python3
"""Prints one line per mesh with the counts of `malus prep`, from the JSON reports in a folder."""
import json
import pathlib
import sys


def main() -> None:
    for path in sorted(pathlib.Path(sys.argv[1]).glob("*.json")):
        report = json.loads(path.read_text())
        done = ", ".join(f"{s['name']} {s['count']}" for s in report["steps"] if s["count"])
        before, after = report["input"], report["output"]
        print(f"  {path.stem}: {before['vertices']} vertices, {before['faces']} faces -> "
              f"{after['vertices']}, {after['triangles']}" + (f"  ({done})" if done else ""))


if __name__ == "__main__":
    main()
