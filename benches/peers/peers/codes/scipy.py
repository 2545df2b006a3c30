"""SciPy with right-hand sides compiled by numba; state and variations as one system."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numba import njit
from scipy.integrate import ode, solve_ivp

from peers import equations
from peers.measure import TOLERANCES, Attempt, Plain
from peers.units import Unit

VERSIONS = ("scipy", "numba")

sin, cos, sqrt = math.sin, math.cos, math.sqrt


def attempts(unit: Unit) -> list[Attempt]:
    """Explicit methods for a and b, stiff ones for c: by the compiled integrators of `ode`, and by `solve_ivp`."""
    over = ", over the crank angle" if unit.key == "c" else ""
    compiled = [
        Attempt(f"ode({method!r}), numba{over}", lambda tol, method=method: Plain(by_ode(unit, method, tol)), TOLERANCES)
        for method in (("lsoda",) if unit.key == "c" else ("dop853", "lsoda"))
        if unit.key != "b"
    ]
    if unit.key == "b":
        how = "ode('dop853'), numba, event by Newton's method by hand"
        compiled = [Attempt(how, lambda tol: Plain(stopped(unit, tol)), TOLERANCES)]
    build = {"a": prescribed, "b": switched, "c": crank}[unit.key]
    event = ", terminal event" if unit.key == "b" else ""
    return compiled + [
        Attempt(
            f"solve_ivp, {method}, numba{event}{over}",
            lambda tol, method=method: Plain(build(unit, method, tol)),
            TOLERANCES,
        )
        for method in (("LSODA", "Radau", "BDF") if unit.key == "c" else ("DOP853",))
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


def by_ode(unit: Unit, method: str, tolerance: float) -> Callable[[], list[float]]:
    """Units a and c by one of the compiled integrators, which is set up once."""
    if unit.key == "a":
        right, matrix, (end, first) = pendulum(unit, 2)[0], None, (math.pi / unit.parameters["omega"], 0)
        start = np.array([*unit.start, 1.0, 0.0, 0.0, 1.0])
    else:
        right, matrix, start = over_crank(unit)
        end, first = math.pi, 1
    more = {"with_jacobian": True} if matrix else {}
    run = ode(right, matrix).set_integrator(method, rtol=tolerance, atol=0.1 * tolerance, nsteps=100_000, **more)
    i, n = first, 2 + first

    def work() -> list[float]:
        run.set_initial_value(start, 0.0)
        y = run.integrate(end)
        return equations.landed(unit.parameters, y[i:n], (y[n + i : 2 * n], y[2 * n + i : 3 * n]))

    return work


def stopped(unit: Unit, tolerance: float) -> Callable[[], list[float]]:
    """Unit b: stopped after the step that crosses the event, then back to it by Newton's method, one integration an iteration."""
    first, second, leg = pendulum(unit, 1)
    psi = unit.parameters["psi"]
    start = np.array([psi, unit.start[0], 0.0, 1.0])

    def crossed(_tau: float, y: np.ndarray) -> int:
        return -1 if y[0] < psi else 0

    def made(right: Any) -> Any:
        return ode(right).set_integrator("dop853", rtol=tolerance, atol=0.1 * tolerance)

    one, two, back = made(first), made(second), made(second)
    two.set_solout(crossed)

    def work() -> list[float]:
        one.set_initial_value(start, 0.0)
        two.set_initial_value(one.integrate(leg.shortened), 0.0)
        y = two.integrate(2.0)
        for _ in range(4):
            miss = (psi - y[0]) / (y[1] / leg.short)
            if abs(miss) < 1e-13:
                break
            back.set_initial_value(y, 0.0)
            y = back.integrate(miss)
        return equations.switched(unit.parameters, *y.tolist(), sin)

    return work


def over_crank(unit: Unit) -> tuple[Any, Any, np.ndarray]:
    """Unit c: right-hand side, matrix for Newton's method, and start.

    The matrix is that of the state, repeated for the variations: what it lacks only slows convergence.
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

    return right, matrix, start


def crank(unit: Unit, method: str, tolerance: float) -> Callable[[], list[float]]:
    """Unit c over the crank angle by `solve_ivp`."""
    right, matrix, start = over_crank(unit)
    options = {"method": method, "rtol": tolerance, "atol": 0.1 * tolerance, "jac": matrix, "t_eval": (math.pi,)}

    def work() -> list[float]:
        y = solve_ivp(right, (0.0, math.pi), start, **options).y[:, -1]
        return equations.landed(unit.parameters, y[1:3], (y[4:6], y[7:9]))

    return work
