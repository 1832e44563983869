#!/usr/bin/python3
"""Writes the page of `malus compare --show`: FOLDER/index.html, results of several devices side by side.

    devices_report.py FOLDER METHOD,... RESULTS...

METHOD,...: the order of the rows. One column per device and renderer, one table per scene; of several views the largest is taken. Exit codes: 0 done,
1 failed (one line on stderr), 2 usage. Debian package: python3-jinja2.
"""
import pathlib
import sys

sys.dont_write_bytecode = True  # the folder of the script may be read-only

from report_data import ReportError, number, read_results_file, write_page  # noqa: E402

kHere = pathlib.Path(__file__).resolve().parent


class Column:
    """The rows of one renderer in one file, with the largest view of a scene."""

    def __init__(self, results: dict, scene: str, renderer: str):
        def of_scene(name):
            return [r for r in results.get(name) or [] if r["scene"] == scene and r["renderer"] == renderer]
        pixels = max(r["width"] * r["height"] for r in of_scene("rows"))
        self.device = (results.get("devices") or {}).get(renderer) or renderer
        info = results.get("deviceInfo") or {}
        self.cores = info.get("rayTracingCores") if renderer == "vulkan" else None
        self.rows = {}
        for name in ("rows", "rowsOnSecondPath"):
            for row in of_scene(name):
                if row["width"] * row["height"] == pixels:
                    self.view = f"{row['width']} × {row['height']}, depth {row['depth']}"
                    path = row.get("embreePath") or row.get("vulkanPath")
                    self.rows[row["method"] if name == "rows" else f"{row['method']}, {path}"] = row

    def cell(self, name: str) -> str:
        row = self.rows.get(name)
        if row is None:
            return "–"
        if row["status"] != "ok":
            return "failed"
        ms, ratio = number(row, "medianMs"), number(row, "ratioToSchlick", "median")
        if ms is None:
            return "not timed"
        if ratio is None:
            return f"{ms:.2f} ms"
        low, high = number(row, "ratioToSchlick", "low"), number(row, "ratioToSchlick", "high")
        return f"{ratio:.3f} ({low:.3f}–{high:.3f}), {ms:.2f} ms"


def scene_tables(files: list, methods: list) -> list:
    """Returns (scene, columns, names of the rows) of each scene: methods in their order, then second paths."""
    def place(name):
        method = name.split(", ")[0]
        return ", " in name, methods.index(method) if method in methods else len(methods), name
    tables = []
    for scene in dict.fromkeys(name for results in files for name in results["scenes"]):
        columns = [Column(results, scene, renderer) for results in files
                   for renderer in dict.fromkeys(r["renderer"] for r in results["rows"] if r["scene"] == scene)]
        if columns:
            tables.append((scene, columns, sorted({name for column in columns for name in column.rows}, key=place)))
    return tables


def main() -> int:
    if len(sys.argv) < 4 or sys.argv[1].startswith("-"):
        print("usage: devices_report.py FOLDER METHOD,... RESULTS...", file=sys.stderr)
        return 2
    try:
        import jinja2
        from markupsafe import Markup
    except ImportError as error:
        print(f"devices_report: {error.name}: cannot be imported by {sys.executable}; install python3-jinja2",
              file=sys.stderr)
        return 1
    try:
        files = [read_results_file(pathlib.Path(path)) for path in sys.argv[3:]]
        environment = jinja2.Environment(loader=jinja2.FileSystemLoader(kHere / "templates"), autoescape=True,
                                         trim_blocks=True, lstrip_blocks=True, undefined=jinja2.StrictUndefined)
        text = environment.get_template("devices.html.j2").render(
            tables=scene_tables(files, sys.argv[2].split(",")), style=Markup((kHere / "report.css").read_text(encoding="utf-8")))
        write_page(pathlib.Path(sys.argv[1]), text)
    except ReportError as error:
        print(f"devices_report: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
