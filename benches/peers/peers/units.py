"""The units of work: a model's return map and its Jacobian at a gait, and how a result is judged.

A result is a flat sequence: the image of the section coordinates, then the Jacobian row by row, SI units.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

TITLES = {
    "a": "prescribed length, sprawl 25 deg",
    "b": "angle-switched",
    "c": "crank-slider",
}
# Largest error allowed: of the determinant of the Jacobian in a, of image and Jacobian in b and c.
WANTED = {"a": 1e-10, "b": 1e-9, "c": 1e-8}


@dataclass(frozen=True)
class Unit:
    """A model at its gait."""

    key: str
    parameters: dict[str, float]
    start: tuple[float, ...]
    """Section coordinates: (q_theta, p_theta), in b (p_theta,)."""
    duration: float
    """Duration of the step (s), for codes that need a guess."""
    reference: tuple[float, ...]
    wanted: float

    def deviation(self, result: Sequence[float]) -> float:
        """Largest deviation of image and Jacobian from the reference; infinite where a number is missing or not finite."""
        if len(result) != len(self.reference):
            return float("inf")
        worst = max(abs(float(a) - b) for a, b in zip(result, self.reference))
        return worst if worst == worst else float("inf")

    def error(self, result: Sequence[float]) -> float:
        """The error that counts."""
        if self.key != "a" or len(result) != len(self.reference):
            return self.deviation(result)
        error = abs(determinant(result) - determinant(self.reference))
        return error if error == error else float("inf")


def determinant(result: Sequence[float]) -> float:
    """Determinant of the Jacobian of a result in two coordinates."""
    _, _, j00, j01, j10, j11 = (float(x) for x in result)
    return j00 * j11 - j01 * j10


def read(path: Path, key: str) -> Unit:
    """The unit of a key from the file that the runner wrote."""
    unit = json.loads(path.read_text())[key]
    return Unit(
        key=key,
        parameters=unit["parameters"],
        start=tuple(unit["start"]),
        duration=unit["duration"],
        reference=tuple(unit["reference"]),
        wanted=unit["wanted"],
    )
