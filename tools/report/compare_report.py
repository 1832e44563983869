#!/usr/bin/python3
"""Writes the report of `malus compare`: FOLDER/index.html from FOLDER/results.json and FOLDER/images.

    compare_report.py FOLDER

FOLDER/scaling.json, written by tools/scaling, is shown too if it is there. The page is self-contained: plots are SVG,
images are data URIs, style and script are inline. Exit codes: 0 done, 1 failed (one line on stderr), 2 usage. Debian
packages: python3-matplotlib, python3-jinja2, python3-numpy, python3-openimageio.
"""
import pathlib
import sys

sys.dont_write_bytecode = True  # the folder of the script may be read-only


def main() -> int:
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        print("usage: compare_report.py FOLDER", file=sys.stderr)
        return 2
    folder = pathlib.Path(sys.argv[1])
    try:
        from report_data import ReportError, read_results, write_page
    except ImportError as error:
        print(f"compare_report: {error}", file=sys.stderr)
        return 1
    try:
        results = read_results(folder)
        try:
            from report_page import page
        except ImportError as error:
            raise ReportError(f"{error.name}: cannot be imported by {sys.executable}; install python3-matplotlib, "
                              "python3-jinja2, python3-numpy and python3-openimageio") from None
        write_page(folder, page(folder, results))
    except ReportError as error:
        print(f"compare_report: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
