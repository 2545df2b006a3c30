"""The problems, and what a code is given of one: gaitc's functions, the ranges, the starts."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import gaitc_problem
import numpy as np
from numpy.typing import NDArray

Vector = NDArray[np.float64]


@dataclass(frozen=True)
class Case:
    """A problem of a spec, or one with some of its constraints."""

    key: str
    title: str
    model: str
    problem: str
    only: tuple[str, ...] | None = None


CASES = {
    case.key: case
    for case in (
        # All bounds but the one on the spring's power, which limits neither this optimum nor the search.
        Case(
            "crank",
            "`self_exciting --problem fastest_stable`",
            "self_exciting",
            "fastest_stable",
            ("peak_motor_speed <= 1500 rad/s", "peak_pull <= 200 N", "peak_push <= 100 N", "spectral_radius <= 0.95"),
        ),
        Case(
            "crank_stable",
            "the same with the bound on stability alone",
            "self_exciting",
            "fastest_stable",
            ("spectral_radius <= 0.95",),
        ),
        Case("prescribed", "`prescribed_length --problem fastest_stable`", "prescribed_length", "fastest_stable"),
        Case("switched", "`angle_switched --problem fastest`", "angle_switched", "fastest"),
        Case("stroke", "`power_stroke --problem fastest_stable`", "power_stroke", "fastest_stable"),
    )
}


@dataclass(frozen=True)
class Start:
    """Where all codes begin: parameters, and the gait there (z, and its duration in s) where gaitc finds one.

    Where it finds none, z is the spec's first guess and the duration None.
    """

    p: Vector
    z: Vector
    duration: float | None


class Task:
    """A problem ready for any code, in SI units; x = (p, z)."""

    def __init__(self, case: Case, accuracy: float = 1e-12) -> None:
        self.case = case
        only = None if case.only is None else list(case.only)
        self.posed = gaitc_problem.Posed(case.model, case.problem, accuracy, only)
        info: dict[str, Any] = self.posed.info()
        self.varied: list[str] = info["varied"]
        self.lower, self.upper = np.array(info["lower"]), np.array(info["upper"])
        self.given, self.guess = np.array(info["start"]), np.array(info["guess"])
        self.parameters: dict[str, float] = info["parameters"]
        self.sign = 1.0 if info["maximise"] else -1.0
        self.margins: list[str] = info["margins"]
        self.scales = np.array(info["scales"])
        self.radius: float = math.inf if info["radius"] is None else info["radius"]
        self.m, self.d = len(self.varied), len(self.guess)

    def starts(self, count: int, seed: int) -> list[Start]:
        """The spec's own start, then `count` random ones, uniform in the ranges."""
        random = np.random.default_rng(seed)
        drawn = self.lower + random.random((count, self.m)) * (self.upper - self.lower)
        own = np.clip(self.given, self.lower, self.upper)
        return [self.start(p) for p in (own, *drawn)]

    def start(self, p: Vector) -> Start:
        gait = self.posed.gait(p.tolist())
        return Start(p, self.guess, None) if gait is None else Start(p, np.array(gait[0]), gait[1])


@dataclass(frozen=True)
class Claim:
    """What a code says it has found."""

    success: bool
    status: str
    p: Vector
    z: Vector
    iterations: int


@dataclass(frozen=True)
class Configuration:
    """A way to use a code: `prepare` builds what all starts share, and gives what solves from one start."""

    name: str
    prepare: Callable[[], Callable[[Start], Claim]]


def rows(matrix: Sequence[Sequence[float]], columns: int) -> Vector:
    """A matrix from its rows, also when there are none."""
    return np.array(matrix, dtype=np.float64).reshape(len(matrix), columns)
