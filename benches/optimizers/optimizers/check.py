"""Whether what a code claims is so: simulated again by gaitc's map, compared with the best that any code found, and held against
the conditions of an optimum."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import nnls

from optimizers.cases import Task, Vector, rows

FEASIBLE = 1e-6
"""Largest violation: of periodicity (SI), of a margin relative to its bound, of the spectral radius."""
RIGHT = 1e-5
"""Largest distance of a right objective from the best known (SI)."""
STATIONARY = 1e-3
"""Largest part of the objective's gradient, over the ranges, that active constraints leave at an optimum."""
NEAR = 1e-4
"""A constraint is active when so little is left of it."""


@dataclass(frozen=True)
class Simulated:
    """A claimed gait, simulated."""

    objective: float
    violation: float
    residual: float
    """What active constraints leave of the objective's gradient, relative to it."""


def simulate(task: Task, p: Vector, z: Vector) -> Simulated | None:
    """None where there is no next step or a number is not finite."""
    if not (np.all(np.isfinite(p)) and np.all(np.isfinite(z))):
        return None
    values = task.posed.values(p.tolist(), z.tolist())
    if values is None:
        return None
    jacobian = rows(values["jacobian"], task.m + task.d)
    margins = np.array(values["margins"]) / task.scales
    radius = float(np.abs(np.linalg.eigvals(jacobian[:, task.m :])).max(initial=0.0))
    span = task.upper - task.lower
    low, high = (p - task.lower) / span, (task.upper - p) / span
    violations = [np.abs(np.array(values["image"]) - z), -margins, [radius - task.radius], -low, -high]
    violation = float(max(np.max(v, initial=0.0) for v in violations))
    return Simulated(values["objective"], violation, stationarity(task, p, z, values, margins, low, high))


def stationarity(task: Task, p: Vector, z: Vector, values: dict, margins: Vector, low: Vector, high: Vector) -> float:
    """Least |gradient - sum of multipliers times active constraints' gradients|, relative to the gradient, over scaled unknowns."""
    unit = np.concatenate([task.upper - task.lower, np.ones(task.d)])
    periodic = rows(values["jacobian"], len(unit)) * unit
    periodic[:, task.m :] -= np.eye(task.d)
    active = [*periodic, *-periodic]
    gradients = rows(values["margin_gradients"], len(unit)) * unit / task.scales[:, None]
    active += [gradient for gradient, margin in zip(gradients, margins) if margin < NEAR]
    active += [row for row, left in zip(np.eye(len(unit)), low) if left < NEAR]
    active += [-row for row, left in zip(np.eye(len(unit)), high) if left < NEAR]
    jacobian = rows(values["jacobian"], len(unit))[:, task.m :]
    eigenvalues = np.abs(np.linalg.eigvals(jacobian))
    if task.radius - eigenvalues.max(initial=0.0) < NEAR:
        curvature = task.posed.jacobian_derivative(p.tolist(), z.tolist())
        if curvature is None:
            return float("inf")
        active.append(radius_slope(jacobian, np.array(curvature) * unit[:, None, None]))
    gradient = task.sign * np.array(values["gradient"]) * unit
    _, left = nnls(np.array(active).T, -gradient)
    return float(left / np.linalg.norm(gradient))


def radius_slope(jacobian: Vector, curvature: Vector) -> Vector:
    """Minus the gradient of the spectral radius."""
    values, right = np.linalg.eig(jacobian)
    k = int(np.abs(values).argmax())
    change = np.einsum("i,kij,j->k", np.linalg.inv(right)[k], curvature, right[:, k])
    return -(values[k].conjugate() * change).real / abs(values[k])


def verdict(task: Task, success: bool, simulated: Simulated | None, best: float) -> str:
    """`right`, `other` (another local optimum), `wrong` (claimed, but neither) or `none` (not claimed)."""
    if not success:
        return "none"
    if simulated is None or not simulated.violation <= FEASIBLE:
        return "wrong"
    if abs(simulated.objective - best) <= RIGHT:
        return "right"
    return "other" if simulated.residual <= STATIONARY else "wrong"
