"""Reads and validates results.json, and groups the rows that may be compared with each other."""
import json
import math
import os
import pathlib
from dataclasses import dataclass, field

from report_text import printable, printable_json


# Keys of earlier versions of malus that are still read.
kEarlierKeys = {"picture": "image", "indistinguishable": "noSignificantDifference"}


class ReportError(Exception):
    """An error message of one line: the file, the problem and what was expected."""

    def __init__(self, message: str):
        super().__init__(printable(message))


@dataclass
class Group:
    """Rows of one scene, one size and one depth. They trace the same rays, so times and errors are comparable."""
    scene: str
    width: int
    height: int
    depth: int
    rows: list = field(default_factory=list)
    choices: list = field(default_factory=list)  # of malus render --max-error
    reference: dict = None

    @property
    def key(self) -> str:
        return f"{self.scene}-{self.width}x{self.height}-{self.depth}"

    @property
    def renderers(self) -> list:
        return list(dict.fromkeys(row["renderer"] for row in self.rows))

    def points(self, renderer: str) -> list:
        """The rows and choices of a renderer: the points of the plot of error against time."""
        return [row for row in self.rows + self.choices if row["renderer"] == renderer]

    def row(self, renderer: str, method: str):
        """Returns the row, or None if it is missing or failed."""
        for row in self.rows:
            if row["renderer"] == renderer and row["method"] == method and row["status"] == "ok":
                return row
        return None


def read_results(folder: pathlib.Path) -> dict:
    if not folder.is_dir():
        raise ReportError(f"{folder}: no such folder; expected an output folder of malus compare")
    return read_results_file(folder / "results.json")


def read_results_file(path: pathlib.Path) -> dict:
    try:
        results = printable_json(json.loads(path.read_text(encoding="utf-8", errors="replace")))
    except OSError as error:
        raise ReportError(f"{path}: cannot be read: {error.strerror}") from None
    except ValueError as error:
        raise ReportError(f"{path}: not JSON: {error}") from None
    if not isinstance(results, dict):
        raise ReportError(f"{path}: expected an object, found {type(results).__name__}")
    for name, kind in (("scenes", dict), ("rows", list), ("references", list)):
        if not isinstance(results.get(name), kind):
            raise ReportError(f"{path}: expected '{name}' to be {'an object' if kind is dict else 'a list'}")
    for entry in results["rows"] + results["references"]:
        for earlier, name in kEarlierKeys.items():
            if isinstance(entry, dict) and earlier in entry:
                entry.setdefault(name, entry.pop(earlier))
    for at, row in enumerate(results["rows"]):
        for name in ("scene", "renderer", "method", "width", "height", "depth", "status"):
            if not isinstance(row, dict) or name not in row:
                raise ReportError(f"{path}: row {at} has no '{name}'")
        if row["scene"] not in results["scenes"]:
            raise ReportError(f"{path}: row {at} names scene '{row['scene']}', which is not in 'scenes'")
    for at, reference in enumerate(results["references"]):
        for name in ("scene", "width", "height", "depth", "image"):
            if not isinstance(reference, dict) or name not in reference:
                raise ReportError(f"{path}: reference {at} has no '{name}'")
    return results


def write_page(folder: pathlib.Path, text: str) -> None:
    """Writes FOLDER/index.html under another name and renames it, so that an interruption leaves no partial page."""
    unfinished = folder / "index.html.part"
    try:
        unfinished.write_text(text, encoding="utf-8")
        os.replace(unfinished, folder / "index.html")
    except OSError as error:
        raise ReportError(f"{error.filename or unfinished}: {error.strerror}") from None
    finally:
        unfinished.unlink(missing_ok=True)


def group_rows(results: dict) -> list:
    groups = {}
    for row in results["rows"]:
        key = (row["scene"], row["width"], row["height"], row["depth"])
        groups.setdefault(key, Group(*key)).rows.append(row)
    for choice in results.get("rowsWithinError") or []:
        key = tuple(choice[name] for name in ("scene", "width", "height", "depth"))
        if key in groups:
            groups[key].choices.append(choice)
    for reference in results["references"]:
        key = tuple(reference[name] for name in ("scene", "width", "height", "depth"))
        if key in groups:
            groups[key].reference = reference
    # Sort the largest and deepest group of a scene first: the summary sentences describe that group.
    scenes = list(results["scenes"])
    return sorted(groups.values(), key=lambda g: (scenes.index(g.scene), -g.width * g.height, -g.depth))


def number(row: dict, *names):
    """Returns a finite number of a row, or None (failed rows contain nulls)."""
    value = row
    for name in names:
        value = value.get(name) if isinstance(value, dict) else None
    return value if isinstance(value, (int, float)) and math.isfinite(value) else None


# Rounds from which the sign test of render/compare/statistics.h can reject equality at 5 %: 2 / 2^6 = 0.031.
kFewestRounds = 6


def has_enough_rounds(row: dict) -> bool:
    return len(row.get("samplesMs") or []) >= kFewestRounds


def timed(row: dict) -> bool:
    return row["status"] == "ok" and (number(row, "medianMs") or 0) > 0


def pareto(rows: list) -> list:
    """Returns the Pareto front of time and relative RMS error, fastest row first."""
    front, best = [], math.inf
    known = [row for row in rows if timed(row) and number(row, "error", "relRms") is not None]
    for row in sorted(known, key=lambda r: (r["medianMs"], r["error"]["relRms"])):
        if row["error"]["relRms"] < best:
            best = row["error"]["relRms"]
            front.append(row)
    return front
