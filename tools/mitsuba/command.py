"""The command `malus`, for the scripts of this folder."""
import argparse
import pathlib
import subprocess

HERE = pathlib.Path(__file__).resolve().parent
SCENES = HERE.parents[1] / "scenes"


def add_options(parser: argparse.ArgumentParser, width: int, scenes: str) -> None:
    """Adds the options of every comparison. width: the default. scenes: the default of --scenes, in words."""
    parser.add_argument("--malus", type=pathlib.Path, default=HERE.parents[1] / "build/release/bin/malus")
    parser.add_argument("--scenes", help=f"folders in scenes/, separated by commas (default: {scenes})")
    parser.add_argument("--width", type=int, default=width, help="largest width of the images [pixels]")
    parser.add_argument("--json", type=pathlib.Path, help="file for the results")


def parse(parser: argparse.ArgumentParser, count: str) -> argparse.Namespace:
    """Parses the arguments. count: name of an option that must be 1 or more, as --width. Raises RuntimeError if the
    program does not exist."""
    given = parser.parse_args()
    if given.width < 1 or getattr(given, count) < 1:
        parser.error(f"--width and --{count}: expected 1 or more")
    if not given.malus.is_file():
        raise RuntimeError(f"{given.malus} does not exist: build malus with tools/build, or give its path with --malus")
    return given


def malus(program: pathlib.Path, *arguments) -> str:
    """Runs the command and returns what it prints. Raises RuntimeError with its last line on stderr if it fails."""
    done = subprocess.run([program, "-q", *arguments], capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"malus {arguments[0]} failed: {(done.stderr.strip() or 'no message').splitlines()[-1]}")
    return done.stdout
