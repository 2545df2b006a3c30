"""SciPy's SLSQP and trust-constr on gaitc's own return map: exact gradients of objective, periodicity and margins.

Stability either as spectral_radius <= r itself or as the Jury inequalities; both differentiate the Jacobian as gaitc does where it
can, else by central differences.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from scipy.optimize import Bounds, NonlinearConstraint, minimize

from optimizers.cases import Claim, Configuration, Start, Task, Vector, rows

VERSIONS = ("scipy",)


def configurations(task: Task) -> list[Configuration]:
    ways = [("SLSQP", True), ("SLSQP", False), ("trust-constr", True)]
    return [
        Configuration(f"{method}, {'Jury inequalities' if jury else 'spectral radius'}", lambda m=method, j=jury: Searched(task, m, j).solve)
        for method, jury in ways
    ]


class Stopped(Exception):
    """The map has no next step at the start, or its Jacobian no derivative."""


BAD = 1e3
"""An objective worse than any (m/s)."""


class Searched:
    """A task in scaled unknowns: parameters as fractions of their ranges, coordinates as they are."""

    def __init__(self, task: Task, method: str, jury: bool) -> None:
        self.task, self.method, self.jury = task, method, jury
        self.unit = np.concatenate([task.upper - task.lower, np.ones(task.d)])
        self.offset = np.concatenate([task.lower, np.zeros(task.d)])
        self.at: Vector | None = None
        self.known: dict[str, Any] = {}

    def split(self, x: Vector) -> tuple[list[float], list[float]]:
        task = self.task
        physical = self.offset + self.unit * x
        p = np.clip(physical[: task.m], task.lower, task.upper)
        return p.tolist(), physical[task.m :].tolist()

    def values(self, x: Vector) -> dict[str, Any]:
        """Map, objective and margins at x, computed once for all functions that ask."""
        if self.at is None or not np.array_equal(x, self.at):
            found = self.task.posed.values(*self.split(x))
            if found is None and not self.known:
                raise Stopped
            # SciPy cannot be told that a trial point has no next step; a bad objective makes it turn back.
            self.at, self.known = x.copy(), found or self.known | {"objective": -self.task.sign * BAD}
        return self.known

    def curvature(self, x: Vector) -> Vector:
        """dJ/dx, d x d for each unknown."""
        known = self.values(x)
        if "curvature" not in known:
            found = self.task.posed.jacobian_derivative(*self.split(x))
            if found is None:
                raise Stopped
            known["curvature"] = np.array(found) * self.unit[:, None, None]
        return known["curvature"]

    def jacobian(self, x: Vector) -> Vector:
        """dP/dx."""
        return rows(self.values(x)["jacobian"], len(x)) * self.unit

    def objective(self, x: Vector) -> float:
        return -self.task.sign * self.values(x)["objective"]

    def gradient(self, x: Vector) -> Vector:
        return -self.task.sign * np.array(self.values(x)["gradient"]) * self.unit

    def periodic(self, x: Vector) -> Vector:
        return np.array(self.values(x)["image"]) - x[self.task.m :]

    def periodic_slopes(self, x: Vector) -> Vector:
        slopes = self.jacobian(x).copy()
        slopes[:, self.task.m :] -= np.eye(self.task.d)
        return slopes

    def margins(self, x: Vector) -> Vector:
        given = np.array(self.values(x)["margins"]) / self.task.scales
        return np.concatenate([given, self.stability(x)])

    def margin_slopes(self, x: Vector) -> Vector:
        given = rows(self.values(x)["margin_gradients"], len(x)) * self.unit / self.task.scales[:, None]
        return np.vstack([given, self.stability_slopes(x)])

    def stability(self, x: Vector) -> Vector:
        """What must not be negative for stability."""
        if math.isinf(self.task.radius):
            return np.zeros(0)
        j = self.jacobian(x)[:, self.task.m :] / self.task.radius
        if not self.jury:
            return np.array([1.0 - np.abs(np.linalg.eigvals(j)).max()])
        if len(j) == 1:
            return np.array([1.0 - j[0, 0], 1.0 + j[0, 0]])
        trace, determinant = np.trace(j), np.linalg.det(j)
        return np.array([1.0 - trace + determinant, 1.0 + trace + determinant, 1.0 - determinant])

    def stability_slopes(self, x: Vector) -> Vector:
        if math.isinf(self.task.radius):
            return np.zeros((0, len(x)))
        j, dj = self.jacobian(x)[:, self.task.m :] / self.task.radius, self.curvature(x) / self.task.radius
        if not self.jury:
            # d|lambda| = Re(conj(lambda) l' dJ r)/(|lambda| l' r) with left and right eigenvectors.
            values, right = np.linalg.eig(j)
            left = np.linalg.inv(right)
            k = int(np.abs(values).argmax())
            change = np.einsum("i,kij,j->k", left[k], dj, right[:, k])
            return -(values[k].conjugate() * change).real[None, :] / abs(values[k])
        if len(j) == 1:
            return np.vstack([-dj[:, 0, 0], dj[:, 0, 0]])
        trace = dj[:, 0, 0] + dj[:, 1, 1]
        adjugate = np.array([[j[1, 1], -j[0, 1]], [-j[1, 0], j[0, 0]]])
        determinant = np.einsum("ij,kji->k", adjugate, dj)
        return np.vstack([determinant - trace, determinant + trace, -determinant])

    def solve(self, start: Start) -> Claim:
        task = self.task
        x = np.concatenate([(start.p - task.lower) / (task.upper - task.lower), start.z])
        self.at, self.known = None, {}
        try:
            found = self.search(x)
        except Stopped:
            return Claim(False, "the map has no next step", *self.claimed(x), 0)
        return Claim(bool(found.success), str(found.message), *self.claimed(found.x), int(found.nit))

    def claimed(self, x: Vector) -> tuple[Vector, Vector]:
        p, z = self.split(x)
        return np.array(p), np.array(z)

    def search(self, x: Vector) -> Any:
        task = self.task
        low = np.concatenate([np.zeros(task.m), np.full(task.d, -np.inf)])
        high = np.concatenate([np.ones(task.m), np.full(task.d, np.inf)])
        bounds = Bounds(low, high)
        with np.errstate(all="ignore"):
            if self.method == "SLSQP":
                constraints: list[Any] = [
                    {"type": "eq", "fun": self.periodic, "jac": self.periodic_slopes},
                    {"type": "ineq", "fun": self.margins, "jac": self.margin_slopes},
                ]
                return minimize(
                    self.objective, x, jac=self.gradient, bounds=bounds, constraints=constraints, method="SLSQP",
                    options={"ftol": 1e-12, "maxiter": 500},
                )
            count = len(self.margins(x))
            constraints = [
                NonlinearConstraint(self.periodic, 0.0, 0.0, jac=self.periodic_slopes),
                NonlinearConstraint(self.margins, np.zeros(count), np.inf, jac=self.margin_slopes),
            ]
            found = minimize(
                self.objective, x, jac=self.gradient, bounds=bounds, constraints=constraints, method="trust-constr",
                options={"gtol": 1e-12, "barrier_tol": 1e-12, "xtol": 1e-14, "maxiter": 1000},
            )
            # Its flag also says yes where only the radius became small.
            found.success = found.status == 1 or (found.status == 2 and found.constr_violation < 1e-8)
            return found
