"""Comparison of all methods."""

import json
import tempfile

from malus._malus import _compare


def compare(packs, *, folder=None, methods=None, backends=("embree",), width=None, rounds=7, minutes=0.0,
            polarizer=None, threads=0, device="") -> dict:
    """Renders every method in interleaved rounds and returns errors and times, as `malus compare`.

    packs: a pack or model file, or a list of them. folder: receives the images; None: they are not kept. methods: None
    for all. width: pixels; None: the scene's. minutes: time limit; 0: none. polarizer: degrees.

    Returns the document of render/compare/RESULTS.md: result["rows"] has a dict per method, with "error" and
    "samplesMs". Raises malus.Error; Ctrl-C raises KeyboardInterrupt.
    """
    files = [packs] if isinstance(packs, str) or hasattr(packs, "__fspath__") else list(packs)
    with tempfile.TemporaryDirectory() as temporary:
        text = _compare(files, folder or temporary, list(methods or []), list(backends), width, rounds, minutes,
                        polarizer, threads, device)
    return json.loads(text)
