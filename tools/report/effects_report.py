#!/usr/bin/python3
"""Writes the page of `malus compare --effects`: FOLDER/index.html from FOLDER/results.json and FOLDER/images.

    effects_report.py FOLDER

Exit codes: 0 done, 1 failed (one line on stderr), 2 usage. Debian packages: python3-matplotlib, python3-jinja2,
python3-numpy, python3-openimageio.
"""
import pathlib
import sys

sys.dont_write_bytecode = True  # the folder of the script may be read-only

kHere = pathlib.Path(__file__).resolve().parent


def main() -> int:
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        print("usage: effects_report.py FOLDER", file=sys.stderr)
        return 2
    folder = pathlib.Path(sys.argv[1])
    try:
        from report_ablation import page, read_ablation
        from report_data import ReportError, write_page
    except ImportError as error:
        print(f"effects_report: {error.name}: cannot be imported by {sys.executable}; install python3-matplotlib, "
              "python3-jinja2, python3-numpy and python3-openimageio", file=sys.stderr)
        return 1
    try:
        write_page(folder, page(folder, read_ablation(folder)))
    except ReportError as error:
        print(f"effects_report: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
