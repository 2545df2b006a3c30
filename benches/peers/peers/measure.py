"""A configuration of a code: the loosest setting at which it is exact enough, and its time there."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

from peers.units import Unit


class Call:
    """Units of work, ready to be done again and again."""

    units = 1
    """Independent units that one call does."""

    def result(self) -> Sequence[float]:
        """Does the work and hands out the result; of a batch that of its first unit."""
        raise NotImplementedError

    def repeat(self, count: int) -> None:
        """Does the work `count` times, for timing; codes that can loop outside Python do."""
        raise NotImplementedError


class Plain(Call):
    """A Python function as a call."""

    def __init__(self, function: Callable[[], Sequence[float]]) -> None:
        self.function = function

    def result(self) -> Sequence[float]:
        return self.function()

    def repeat(self, count: int) -> None:
        function = self.function
        for _ in range(count):
            function()


@dataclass(frozen=True)
class Attempt:
    """A way to use a code on a unit."""

    configuration: str
    build: Callable[[Any], Call] = field(repr=False)
    """Makes the call at a setting."""
    settings: Sequence[Any]
    """What is tried, the fastest first: tolerances or numbers of steps."""
    meaning: str = "rtol"
    """What a setting is, for the table."""


@dataclass(frozen=True)
class Unable:
    """A code that cannot do a unit by design; why, in one line."""

    configuration: str
    why: str


TOLERANCES = tuple(factor * 10.0**-power for power in range(4, 15) for factor in (1.0, 0.3))
"""Relative tolerances, the loosest first; absolute ones (SI units) are a tenth of them."""


def measure(attempt: Attempt | Unable, unit: Unit, quick: bool, budget: float = 180.0) -> dict[str, Any]:
    """One row of the table; `budget` (s) bounds the search for the setting."""
    row: dict[str, Any] = {"configuration": attempt.configuration}
    if isinstance(attempt, Unable):
        return row | {"status": "unable", "note": attempt.why}
    closest, failure, begun = float("inf"), "", time.perf_counter()
    for setting in attempt.settings:
        if time.perf_counter() - begun > budget:
            failure = f"stopped after {budget:.0f} s"
            break
        try:
            call = attempt.build(setting)
            result = call.result()
        except Exception as error:  # whatever a code throws is its answer
            failure = f"{type(error).__name__}: {error}".splitlines()[0][:160]
            continue
        closest = min(closest, unit.error(result))
        if unit.error(result) <= unit.wanted:
            shown = power(setting, 0) if isinstance(setting, float) else str(setting)
            return row | {
                "status": "ok",
                "setting": f"{attempt.meaning} {shown}",
                "error": unit.error(result),
                "deviation": unit.deviation(result),
                "median_us": microseconds(call, quick),
            }
    reached = f"closest: {power(closest, 1)}" if closest < float("inf") else ""
    return row | {"status": "missed", "note": "; ".join(x for x in (reached, failure) if x)}


def power(number: float, digits: int) -> str:
    """A number with a power of ten, as `3e-9`."""
    return f"{number:.{digits}e}".replace("e-0", "e-")


def microseconds(call: Call, quick: bool) -> float:
    """Minimum over repeats of the median time of a unit (us): other load on the computer only ever adds.

    Processor time, of all threads together: long units would count the waiting for a busy core.
    """
    repeats, seconds = (2, 0.02) if quick else (8, 0.25)

    def once(count: int) -> float:
        begun = time.process_time()
        call.repeat(count)
        return (time.process_time() - begun) / count

    # As many calls a sample as take about 50 us.
    count = max(1, min(10_000, round(50e-6 / max(1e-9, min(once(1), once(3))))))
    medians = []
    for _ in range(repeats):
        samples, begun = [], time.perf_counter()
        while time.perf_counter() - begun < seconds or len(samples) < 3:
            samples.append(once(count))
        medians.append(sorted(samples)[len(samples) // 2])
    return min(medians) / call.units * 1e6
