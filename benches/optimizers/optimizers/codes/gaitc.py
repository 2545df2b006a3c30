"""gaitc's own optimizer as the command line uses it, in process, one start, its confirmation by a fresh simulation included."""

from __future__ import annotations

import numpy as np

from optimizers.cases import Claim, Configuration, Start, Task

VERSIONS = ()


def configurations(task: Task) -> list[Configuration]:
    def solve(start: Start) -> Claim:
        found = task.posed.solve(start.p.tolist(), start.z.tolist())
        p, z = np.array(found["p"]), np.array(found["z"])
        return Claim(found["success"], found["status"], p, z, found["iterations"])

    return [Configuration("default", lambda: solve)]
