"""Runs one code on one problem: `python -m optimizers.worker CODE CASE COUNT SEED`, one JSON object a line, as it is known.

A process of its own: a code that crashes or hangs costs the table its row and nothing else.
"""

from __future__ import annotations

import importlib
import json
import sys
import time
import warnings
from collections.abc import Callable
from importlib.metadata import version
from typing import Any

from optimizers.cases import CASES, Claim, Configuration, Start, Task
from optimizers.check import simulate

REPEATS, ENOUGH = 3, 1.0
"""Solves of one start, the quickest of which counts, as other load only ever adds; no more after so many seconds."""


def main(words: list[str]) -> None:
    code, key, count, seed = words
    # What SciPy says of its quasi-Newton updates is no news here.
    warnings.simplefilter("ignore")
    task = Task(CASES[key])
    module = importlib.import_module(f"optimizers.codes.{code}")
    say({"versions": {name: version(name) for name in module.VERSIONS}})
    starts = task.starts(int(count), int(seed))
    for configuration in module.configurations(task):
        run(task, code, configuration, starts)


def run(task: Task, code: str, configuration: Configuration, starts: list[Start]) -> None:
    begun = time.process_time()
    solve = configuration.prepare()
    shared = {"code": code, "case": task.case.key, "configuration": configuration.name, "build": time.process_time() - begun}
    for number, start in enumerate(starts):
        claim, seconds = timed(solve, start)
        found = simulate(task, claim.p, claim.z)
        say(shared | {
            "start": number, "gait": start.duration is not None, "seconds": seconds, "success": claim.success,
            "status": claim.status, "iterations": claim.iterations, "p": claim.p.tolist(), "z": claim.z.tolist(),
            "simulated": found and vars(found),
        })


def timed(solve: Callable[[Start], Claim], start: Start) -> tuple[Claim, float]:
    """The claim and the processor time of the quickest solve (s)."""
    best, total = float("inf"), 0.0
    for _ in range(REPEATS):
        begun = time.process_time()
        claim = solve(start)
        seconds = time.process_time() - begun
        best, total = min(best, seconds), total + seconds
        if total > ENOUGH:
            break
    return claim, best


def say(row: dict[str, Any]) -> None:
    print(json.dumps(row), flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
