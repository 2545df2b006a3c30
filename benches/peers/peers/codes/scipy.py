"""SciPy's `solve_ivp` with right-hand sides compiled by numba; state and variations as one system."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numba import njit
from scipy.integrate import solve_ivp

from peers import equations
from peers.measure import TOLERANCES, Attempt, Call, Plain
from peers.units import Unit

VERSIONS = ("scipy", "numba")

sin, cos, sqrt = math.sin, math.cos, math.sqrt


def attempts(unit: Unit) -> list[Attempt]:
    """Explicit methods for a and b, stiff ones for c."""
    build = {"a": prescribed, "b": switched, "c": crank}[unit.key]
    methods = ("LSODA", "Radau", "BDF") if unit.key == "c" else ("DOP853", "LSODA")
    event = {"a": "", "b": ", terminal event", "c": ", over the crank angle"}
    return [
        Attempt(
            f"{method}, numba{event[unit.key]}",
            lambda tolerance, method=method: Plain(build(unit, method, tolerance)),
            TOLERANCES,
        )
        for method in methods
    ]


def pendulum(unit: Unit, columns: int) -> tuple[Callable[..., Any], Callable[..., Any], Any]:
    """Right-hand sides while the leg shortens and when it is short, with variations; the leg."""
    hang = equations.swing(unit.parameters, sin, cos, njit)
    leg = equations.leg(unit.parameters, sin, cos, njit)
    field, variation, shortening, short = hang.field, hang.variation, leg.shortening, leg.short

    @njit
    def both(r: float, v: float, y: np.ndarray) -> np.ndarray:
        out = np.empty(2 + 2 * columns)
        out[0], out[1] = field(r, v, y[0], y[1])
        for i in range(columns):
            out[2 + 2 * i], out[3 + 2 * i] = variation(r, v, y[0], y[2 + 2 * i], y[3 + 2 * i])
        return out

    @njit
    def first(tau: float, y: np.ndarray) -> np.ndarray:
        r, v = shortening(tau)
        return both(r, v, y)

    @njit
    def second(_tau: float, y: np.ndarray) -> np.ndarray:
        return both(short, 0.0, y)

    return first, second, leg


def prescribed(unit: Unit, method: str, tolerance: float) -> Callable[[], list[float]]:
    """Unit a: a fixed interval."""
    first, _, leg = pendulum(unit, 2)
    start = np.array([*unit.start, 1.0, 0.0, 0.0, 1.0])
    span = (0.0, leg.shortened)
    options = {"method": method, "rtol": tolerance, "atol": 0.1 * tolerance, "t_eval": (leg.shortened,)}

    def work() -> list[float]:
        y = solve_ivp(first, span, start, **options).y[:, -1]
        return equations.landed(unit.parameters, y[:2], (y[2:4], y[4:6]))

    return work


def switched(unit: Unit, method: str, tolerance: float) -> Callable[[], list[float]]:
    """Unit b: an interval, a restart where the leg's length stops changing smoothly, then up to the event."""
    first, second, leg = pendulum(unit, 1)
    psi = unit.parameters["psi"]
    start = np.array([psi, unit.start[0], 0.0, 1.0])
    span = (0.0, leg.shortened)
    options = {"method": method, "rtol": tolerance, "atol": 0.1 * tolerance}

    @njit
    def crossing(_tau: float, y: np.ndarray) -> float:
        return y[0] - psi

    def back(tau: float, y: np.ndarray) -> float:
        return crossing(tau, y)

    back.terminal, back.direction = True, -1.0  # type: ignore[attr-defined]

    def work() -> list[float]:
        middle = solve_ivp(first, span, start, t_eval=span[1:], **options).y[:, -1]
        run = solve_ivp(second, (0.0, 2.0), middle, events=back, **options)
        q, p, dq, dp = run.y_events[0][0]
        return equations.switched(unit.parameters, q, p, dq, dp, sin)

    return work


def crank(unit: Unit, method: str, tolerance: float) -> Callable[[], list[float]]:
    """Unit c over the crank angle.

    The matrix for Newton's method is that of the state, repeated for the variations: what it lacks only slows convergence.
    """
    made = equations.crank(unit.parameters, sin, cos, sqrt, njit)
    field, variation = made.field, made.variation
    start = np.array([made.idle, *unit.start, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0])

    @njit
    def right(phi: float, y: np.ndarray) -> np.ndarray:
        out = np.empty(9)
        out[0], out[1], out[2] = field(phi, y[0], y[1], y[2])
        for i in (3, 6):
            out[i], out[i + 1], out[i + 2] = variation(phi, y[0], y[1], y[2], y[i], y[i + 1], y[i + 2])
        return out

    @njit
    def matrix(phi: float, y: np.ndarray) -> np.ndarray:
        out = np.zeros((9, 9))
        for j in range(3):
            unit_j = (1.0 if j == 0 else 0.0, 1.0 if j == 1 else 0.0, 1.0 if j == 2 else 0.0)
            column = variation(phi, y[0], y[1], y[2], *unit_j)
            for i in (0, 3, 6):
                out[i, i + j], out[i + 1, i + j], out[i + 2, i + j] = column
        return out

    options = {"method": method, "rtol": tolerance, "atol": 0.1 * tolerance, "jac": matrix, "t_eval": (math.pi,)}

    def work() -> list[float]:
        y = solve_ivp(right, (0.0, math.pi), start, **options).y[:, -1]
        return equations.landed(unit.parameters, y[1:3], (y[4:6], y[7:9]))

    return work
