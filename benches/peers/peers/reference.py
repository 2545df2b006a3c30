"""What the units' results are, to 15 digits, by a route that no peer takes: collocation in multiple precision.

On each element the solution is a polynomial through Chebyshev-Lobatto points that satisfies the equations at all of them but the first.
Newton's method takes its residuals in multiple precision and its matrix in double precision, which is enough to
converge. The Jacobian of the map is a central difference in the same precision, so no derivative is derived by hand.
"""

from __future__ import annotations

import json
import math
import os
import sys
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import mpmath
import numpy as np
from mpmath import mpf

from peers import equations, units

DIGITS = 40
"""Working precision; differences with a step of 1e-12 keep more than 20 digits."""
RESOLUTIONS = {"a": ((22, 6), (18, 5)), "b": ((22, 6), (18, 5)), "c": ((24, 10), (20, 9))}
"""Degree and number of elements of the two resolutions that are compared."""
LARGEST_SPREAD = 1e-13
"""By how much they may differ."""
Residual = Callable[[Any, Sequence[Any], Sequence[Any]], Sequence[Any]]


class Collocation:
    """Polynomials of a degree on a number of equal elements."""

    def __init__(self, degree: int, elements: int) -> None:
        self.degree, self.elements = degree, elements
        self.nodes = [-mpmath.cos(mpmath.pi * j / degree) for j in range(degree + 1)]
        self.slopes = self._slopes()

    def _slopes(self) -> list[list[mpf]]:
        """Matrix that takes values at the nodes to derivatives there (barycentric formula)."""
        n = self.degree
        weight = [mpf((-1) ** j) * (mpf(1) / 2 if j in (0, n) else 1) for j in range(n + 1)]
        matrix = [[mpf(0)] * (n + 1) for _ in range(n + 1)]
        for i in range(n + 1):
            for j in range(n + 1):
                if i != j:
                    matrix[i][j] = weight[j] / weight[i] / (self.nodes[i] - self.nodes[j])
            matrix[i][i] = -mpmath.fsum(matrix[i])
        return matrix

    def solve(self, residual: Residual, begin: Any, end: Any, start: Sequence[Any]) -> list[mpf]:
        """The state at `end` of the solution that has the state `start` at `begin`."""
        at, state = mpf(begin), [mpf(x) for x in start]
        width = (mpf(end) - at) / self.elements
        for _ in range(self.elements):
            state = self._element(residual, at, width, state)
            at += width
        return state

    def _element(self, residual: Residual, begin: mpf, width: mpf, start: list[mpf]) -> list[mpf]:
        n, d = self.degree, len(start)
        points = [begin + width * (1 + node) / 2 for node in self.nodes]
        values = [list(start) for _ in range(n + 1)]
        last = math.inf
        for _ in range(40):
            slopes = [
                [2 / width * mpmath.fdot(self.slopes[j], [value[i] for value in values]) for i in range(d)]
                for j in range(n + 1)
            ]
            rest = [residual(points[j], values[j], slopes[j]) for j in range(1, n + 1)]
            size = float(max(abs(x) for row in rest for x in row))
            if size == 0.0 or (size < 1e-25 and size > 0.01 * last):
                return values[n]
            last = size
            # Scaled, so that double precision holds a residual of 1e-30.
            right = np.array([float(x / size) for row in rest for x in row])
            change = np.linalg.solve(self._matrix(residual, points, values, slopes, float(width)), right)
            for j in range(1, n + 1):
                for i in range(d):
                    values[j][i] -= size * mpf(change[d * (j - 1) + i])
        raise ArithmeticError("the reference did not converge")

    def _matrix(self, residual: Residual, points: Any, values: Any, slopes: Any, width: float) -> np.ndarray:
        """Derivatives of the residuals at nodes 1..n with respect to the values there, roughly, in double precision."""
        n, d, step = self.degree, len(values[0]), mpf("1e-15")
        matrix = np.zeros((n * d, n * d))
        for j in range(1, n + 1):
            base = residual(points[j], values[j], slopes[j])
            for k in range(d):
                moved = [x + step if i == k else x for i, x in enumerate(values[j])]
                steeper = [x + step if i == k else x for i, x in enumerate(slopes[j])]
                by_value = [float((x - y) / step) for x, y in zip(residual(points[j], moved, slopes[j]), base)]
                by_slope = [float((x - y) / step) for x, y in zip(residual(points[j], values[j], steeper), base)]
                for i in range(d):
                    row = d * (j - 1) + i
                    matrix[row, d * (j - 1) + k] += by_value[i]
                    for other in range(1, n + 1):
                        matrix[row, d * (other - 1) + k] += by_slope[i] * 2 / width * float(self.slopes[j][other])
        return matrix


def image(
    key: str, values: Mapping[str, float], start: Sequence[Any], duration: float, method: Collocation
) -> list[mpf]:
    """The return map of a unit, without its Jacobian. The duration (s) need not be exact."""
    if key == "c":
        made = equations.crank(values, mpmath.sin, mpmath.cos, mpmath.sqrt)
        _, q, p = method.solve(made.residual, 0, mpmath.pi, [mpf(made.idle), *start])
        return [-(q + 2 * mpf(values["psi"])), -mpmath.cos(2 * mpf(values["psi"])) * p]
    psi, omega = mpf(values["psi"]), mpf(values["omega"])
    hang = equations.swing(values, mpmath.sin, mpmath.cos)
    leg = equations.leg(values, mpmath.sin, mpmath.cos)

    def shortening(tau: Any, u: Any, du: Any) -> list[Any]:
        return [x - y for x, y in zip(du, hang.field(*leg.shortening(tau), u[0], u[1]))]

    def short(_tau: Any, u: Any, du: Any) -> list[Any]:
        return [x - y for x, y in zip(du, hang.field(mpf(leg.short), mpf(0), u[0], u[1]))]

    if key == "a":
        q, p = method.solve(shortening, 0, mpmath.pi / omega, start)
        return [-(q + 2 * psi), -mpmath.cos(2 * psi) * p]
    middle = method.solve(shortening, 0, mpmath.pi / omega, [psi, *start])
    # When the leg swings back through psi: Newton's method on the time of that.
    time = mpf(duration) - mpmath.pi / omega
    for _ in range(12):
        state = method.solve(short, 0, time, middle)
        miss = (state[0] - psi) / (state[1] / mpf(leg.short))
        if abs(miss) < mpf("1e-20"):
            break
        time -= miss
    # What is left of the miss is squared by this last step along the flow.
    state = [x - miss * slope for x, slope in zip(state, hang.field(mpf(leg.short), mpf(0), state[0], state[1]))]
    return [-mpmath.cos(2 * psi) * state[1]]


def result(key: str, values: Mapping[str, float], start: Sequence[float], duration: float, method: Collocation) -> list[mpf]:
    """Image, then Jacobian row by row."""
    step = mpf("1e-12")
    columns = []
    for i in range(len(start)):
        ahead, behind = ([mpf(x) + sign * step * (j == i) for j, x in enumerate(start)] for sign in (1, -1))
        pair = zip(*(image(key, values, begin, duration, method) for begin in (ahead, behind)))
        columns.append([(x - y) / (2 * step) for x, y in pair])
    rows = [column[i] for i in range(len(start)) for column in columns]
    return [*image(key, values, [mpf(x) for x in start], duration, method), *rows]


def compute(key: str, values: Mapping[str, float], start: Sequence[float], duration: float) -> tuple[list[float], float]:
    """The result of a unit, and by how much two resolutions differ."""
    with mpmath.workdps(DIGITS):
        fine = result(key, values, start, duration, Collocation(*RESOLUTIONS[key][0]))
        coarse = result(key, values, start, duration, Collocation(*RESOLUTIONS[key][1]))
        spread = max(abs(x - y) for x, y in zip(fine, coarse))
        if key == "a":
            psi, short = mpf(values["psi"]), mpf(values["l_b"])
            closed = mpmath.cos(2 * psi) * (short + mpf(values["l_s"])) / short
            _, _, j00, j01, j10, j11 = fine
            # The flow preserves area in (q, r p), so the determinant has a closed form.
            spread = max(spread, abs(j00 * j11 - j01 * j10 - closed))
        return [float(x) for x in fine], float(spread)


def main(gaits: Path, cases: Path) -> None:
    """Adds the results to the gaits: the file of units that all codes read."""
    known = json.loads(gaits.read_text())
    for key, case in known.items():
        values, spread = compute(key, case["parameters"], case["start"], case["duration"])
        print(f"reference of unit {key}: two resolutions differ by {spread:.1e}", file=sys.stderr)
        if not spread <= LARGEST_SPREAD:
            raise ArithmeticError(f"the reference of unit {key} is not exact enough")
        case |= {"reference": values, "wanted": units.WANTED[key]}
    whole = cases.with_suffix(".new")
    whole.write_text(json.dumps(known, indent=1))
    os.replace(whole, cases)


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
