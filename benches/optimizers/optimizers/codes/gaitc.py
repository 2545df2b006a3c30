"""gaitc's own optimizer, in process, one start, its confirmation by a fresh simulation included."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from optimizers.cases import Claim, Configuration, Start, Task

VERSIONS = ()


def configurations(task: Task) -> list[Configuration]:
    """As the command line uses it, and with looser maps."""
    return [Configuration(f"maps to {accuracy:.0e}", lambda a=accuracy: prepare(task, a)) for accuracy in (1e-12, 1e-10)]


def prepare(task: Task, accuracy: float) -> Callable[[Start], Claim]:
    posed = Task(task.case, accuracy).posed

    def solve(start: Start) -> Claim:
        found = posed.solve(start.p.tolist(), start.z.tolist())
        p, z = np.array(found["p"]), np.array(found["z"])
        return Claim(found["success"], found["status"], p, z, found["iterations"])

    return solve
