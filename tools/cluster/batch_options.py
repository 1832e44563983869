"""Options of `malus batch`, read from its help text, so that tools/cluster/submit passes on those of every version."""
import dataclasses
import pathlib
import re
import subprocess

# Options that submit sets. The shard and the folder differ between the tasks.
RESERVED = {"--help", "--output", "--shard", "--json"}

# Options for model files, which `malus bake` has under the same names.
FOR_BAKING = {"--camera", "--environment", "--allow-open-glass"}

LINE = re.compile(r"  (?:-\w,)?(--[\w-]+)(?: (\S.*?))?(?:  .*)?$")


class OptionsError(Exception):
    """A message of one line."""


class ValueRefused(Exception):
    """The message of `malus batch`."""


@dataclasses.dataclass(frozen=True)
class BatchOption:
    name: str
    values: int  # 0 for a flag
    is_file: bool  # the value may name a file


def parse_help(text: str) -> list[BatchOption]:
    """Reads the lines '  -s,--name TYPE ...  Description' and the numbers of values ('x 4') behind the types."""
    options = []
    for line in text.splitlines():
        match = LINE.match(line)
        if not match or match.group(1) in RESERVED:
            continue
        kind = match.group(2) or ""
        several = re.search(r" x (\d+)$", kind)
        values = int(several.group(1)) if several else 1 if kind else 0
        options.append(BatchOption(match.group(1), values, kind.startswith("FILE")))
    return options


def read_options(malus: str) -> list[BatchOption]:
    try:
        done = subprocess.run([malus, "batch", "--help"], capture_output=True, text=True, check=False)
    except OSError as error:
        raise OptionsError(f"{malus}: cannot run: {error.strerror}; expected the command malus: --malus FILE") from error
    options = parse_help(done.stdout)
    if done.returncode != 0 or not options:
        raise OptionsError(f"{malus}: 'batch --help' lists no options; expected malus with the command batch: --malus FILE")
    return options


def split_options(options: list[BatchOption], given: dict) -> tuple[list[str], list[str]]:
    """Command line arguments for `malus bake` and for `malus batch`. given: name -> list of lists of values. Existing
    files become absolute, because tasks may start in another folder."""
    bake, batch = [], []
    for option in options:
        for values in given.get(option.name, []):
            if option.is_file and pathlib.Path(values[0]).exists():
                values = [str(pathlib.Path(values[0]).resolve())]
            (bake if option.name in FOR_BAKING else batch).extend([option.name, *values])
    return bake, batch


def check_values(malus: str, scene: str, jobs: str, arguments: list[str]) -> None:
    """Throws ValueRefused if `malus batch` refuses a value: it checks values before it prints its help."""
    done = subprocess.run([malus, "batch", scene, jobs, "-o", "frames", *arguments, "--help"], capture_output=True,
                          text=True, check=False)
    if done.returncode != 0:
        raise ValueRefused(done.stderr.strip().splitlines()[-1] if done.stderr.strip() else "'malus batch' failed")
