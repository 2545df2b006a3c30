"""Measures one code on one unit: `python -m peers.worker CODE UNIT CASES [--quick]`, one JSON object a line, flushed as it is known.

A process of its own: a code that crashes or hangs costs the table its row and nothing else.
"""

from __future__ import annotations

import importlib
import json
import sys
from importlib.metadata import version
from pathlib import Path

from peers import measure, units


def main(words: list[str]) -> None:
    quick = "--quick" in words
    code, key, cases = (word for word in words if not word.startswith("--"))
    module = importlib.import_module(f"peers.codes.{code}")
    unit = units.read(Path(cases), key)
    print(json.dumps({"versions": {name: version(name) for name in module.VERSIONS}}), flush=True)
    for attempt in module.attempts(unit):
        print(json.dumps(measure.measure(attempt, unit, quick)), flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
