"""The climbers' steps for collocation: phases, return map, objective. The equations come from `benches/peers`.

Constants of a step are w = (u, z, e): the varied parameters as fractions of their ranges, the section coordinates, and what of the
step's duration is unknown (s). What the optimizer of gaitc gets from its specs stands here in the form that suits collocation best:
the crank-slider over its crank angle, where the end of a step is known; mean speeds from the height between beginning and end.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import pi
from typing import Any

import casadi as ca
import numpy as np

from optimizers.cases import Start, Task
from optimizers.collocation import Phase, Symbol
from peers import equations


@dataclass(frozen=True)
class Climber:
    """One step of a climber, as expressions."""

    size: int
    """Of the state x."""
    phases: list[Phase]
    begin: Callable[[Symbol], Symbol]
    """x at the beginning, of w."""
    landed: Callable[[Symbol, Symbol, Symbol], tuple[Symbol, Symbol, Symbol]]
    """Of x and dx/dz at the end and of w: the return map, its Jacobian, and what is zero where the step ends."""
    objective: Callable[[Symbol, Symbol, Symbol], Symbol]
    """Of x at the end, the sum of the phases' integrals, and w."""
    durations: Callable[[Start], list[float]] = lambda start: []
    """The unknown durations at a start."""
    longest: float = 10.0
    """Bound on them (s)."""


class Values:
    """The parameters by name, the varied ones from w."""

    def __init__(self, task: Task, w: Symbol) -> None:
        spans = (task.upper - task.lower).tolist()
        varied = {name: low + span * w[i] for i, (name, low, span) in enumerate(zip(task.varied, task.lower.tolist(), spans))}
        self.of: dict[str, Any] = task.parameters | varied
        self.z = [w[task.m + i] for i in range(task.d)]
        self.e = w[task.m + task.d :]


def crank(task: Task, mesh: int) -> Climber:
    """The self-exciting climber over s = phi/pi; x = (Omega/idle, q, p), of which the dead centres determine the first."""

    def parts(w: Symbol) -> tuple[Any, Any, Any]:
        values = Values(task, w)
        return values, equations.crank(values.of, ca.sin, ca.cos, ca.sqrt), values.of["omega_nl"] * values.of["command"]

    def residual(s: Symbol, x: Symbol, dx: Symbol, w: Symbol) -> Symbol:
        _, machine, _ = parts(w)
        idle = machine.idle
        first, second, third = machine.residual(
            pi * s, (idle * x[0], x[1], x[2]), (idle * dx[0] / pi, dx[1] / pi, dx[2] / pi)
        )
        return ca.vertcat(first / idle, second / idle, third / idle)

    def rate(s: Symbol, x: Symbol, w: Symbol) -> Symbol:
        return pi / (parts(w)[1].idle * x[0])

    def margins(s: Symbol, x: Symbol, dx: Symbol, w: Symbol) -> Symbol:
        values, machine, no_load = parts(w)
        r, slope, bend = machine.legs(pi * s)
        omega, change = machine.idle * x[0], machine.idle * dx[0] / pi
        m, g = values.of["m"], values.of["g"]
        force = m * g * ca.cos(x[1]) + m * x[2] ** 2 / r - m * omega * (bend * omega + slope * change)
        known = {
            "peak_motor_speed <= 1500 rad/s": 1.0 - no_load * x[0] / 1500.0,
            "peak_pull <= 200 N": 1.0 - force / 200.0,
            "peak_push <= 100 N": 1.0 + force / 100.0,
        }
        return ca.vertcat(*(known[name] for name in task.margins))

    def landed(x: Symbol, columns: Symbol, w: Symbol) -> tuple[Symbol, Symbol, Symbol]:
        return swung(Values(task, w).of["psi"], x[1:3], columns[1:3, :])

    def objective(x: Symbol, duration: Symbol, w: Symbol) -> Symbol:
        values, machine, _ = parts(w)
        return (machine.legs(0.0)[0] * ca.cos(values.z[0]) - machine.legs(pi)[0] * ca.cos(x[1])) / duration

    def begin(w: Symbol) -> Symbol:
        return ca.vertcat(1.0, *Values(task, w).z)

    phase = Phase(residual, rate, margins if task.margins else None, graded(mesh))
    return Climber(3, [phase], begin, landed, objective)


def graded(intervals: int) -> np.ndarray:
    """A mesh finer towards both ends, where the motor catches the mass near the dead centres: the lower the gear, the faster."""
    return 0.5 - 0.5 * np.cos(pi * np.linspace(0.0, 1.0, intervals + 1))


def swung(psi: Symbol, x: Symbol, columns: Symbol) -> tuple[Symbol, Symbol, Symbol]:
    """Touch-down and mirror of (q, p) where the leg has no speed; a step of known end."""
    factor = ca.cos(2.0 * psi)
    image = ca.vertcat(-(x[0] + 2.0 * psi), -factor * x[1])
    return image, ca.vertcat(-columns[0, :], -factor * columns[1, :]), ca.DM(0, 1)


def shortening(task: Task, w: Symbol) -> tuple[Any, Any, Any]:
    values = Values(task, w)
    return values, equations.leg(values.of, ca.sin, ca.cos), equations.swing(values.of, ca.sin, ca.cos)


def pulled(task: Task) -> Callable[[Symbol, Symbol, Symbol, Symbol], Symbol]:
    """The swing while the prescribed leg shortens, over s = omega tau/pi; x = (q, p)."""

    def residual(s: Symbol, x: Symbol, dx: Symbol, w: Symbol) -> Symbol:
        _, leg, swing = shortening(task, w)
        r, v = leg.shortening(s * leg.shortened)
        return dx - leg.shortened * ca.vertcat(*swing.field(r, v, x[0], x[1]))

    return residual


def prescribed(task: Task, mesh: int) -> Climber:
    """The climber of prescribed length: one phase of known duration."""

    def landed(x: Symbol, columns: Symbol, w: Symbol) -> tuple[Symbol, Symbol, Symbol]:
        return swung(Values(task, w).of["psi"], x, columns)

    def objective(x: Symbol, _: Symbol, w: Symbol) -> Symbol:
        values, leg, _ = shortening(task, w)
        height = (leg.short + values.of["l_s"]) * ca.cos(values.z[0]) - leg.short * ca.cos(x[0])
        return height / leg.shortened

    phase = Phase(pulled(task), None, None, np.linspace(0.0, 1.0, mesh + 1))
    return Climber(2, [phase], lambda w: ca.vertcat(*Values(task, w).z), landed, objective)


def switched(task: Task, mesh: int) -> Climber:
    """The angle-switched climber: the leg shortens, then swings at its shortest for an unknown time, until it is back at psi."""

    def held(s: Symbol, x: Symbol, dx: Symbol, w: Symbol) -> Symbol:
        values, leg, swing = shortening(task, w)
        return dx - values.e[0] * ca.vertcat(*swing.field(leg.short, 0.0, x[0], x[1]))

    def landed(x: Symbol, columns: Symbol, w: Symbol) -> tuple[Symbol, Symbol, Symbol]:
        values, leg, swing = shortening(task, w)
        psi = values.of["psi"]
        factor = ca.cos(2.0 * psi)
        rates = swing.field(leg.short, 0.0, x[0], x[1])
        # The end of the step moves with its start.
        slope = -factor * (columns[1, 0] - rates[1] / rates[0] * columns[0, 0])
        return -factor * x[1], slope, x[0] - psi

    def objective(x: Symbol, _: Symbol, w: Symbol) -> Symbol:
        values, leg, _ = shortening(task, w)
        return values.of["l_s"] * ca.cos(values.of["psi"]) / (leg.shortened + values.e[0])

    def durations(start: Start) -> list[float]:
        shortened = pi / (task.parameters | dict(zip(task.varied, start.p)))["omega"]
        return [max((start.duration or 1.5 * shortened) - shortened, 0.01)]

    def begin(w: Symbol) -> Symbol:
        values = Values(task, w)
        return ca.vertcat(values.of["psi"], *values.z)

    even = np.linspace(0.0, 1.0, mesh + 1)
    return Climber(2, [Phase(pulled(task), None, None, even), Phase(held, None, None, even)], begin, landed, objective, durations)


def stroke(task: Task, mesh: int) -> Climber:
    """The vertical climber with rack and pinion: one phase of unknown duration; x = (y_1, y_2), scaled by nothing, both are about 1."""

    def forces(x: Symbol, w: Symbol) -> tuple[Any, Symbol, Symbol, Symbol]:
        """Values; force of the motor, of motor and spring, and of both at rest."""
        of = Values(task, w).of
        ratio = of["G"] / of["r_p"]
        motor = ratio * of["tau_stall"] * (of["command"] - ratio * x[1] / of["omega_nl"])
        spring = of["k"] * (of["l_s"] - x[0])
        return of, motor, motor + spring, ratio * of["tau_stall"] * of["command"] + spring

    def rates(x: Symbol, w: Symbol) -> Symbol:
        of, _, force, _ = forces(x, w)
        return ca.vertcat(x[1], force / of["m"] - of["g"])

    def residual(s: Symbol, x: Symbol, dx: Symbol, w: Symbol) -> Symbol:
        return dx - Values(task, w).e[0] * rates(x, w)

    def margins(s: Symbol, x: Symbol, dx: Symbol, w: Symbol) -> Symbol:
        of, motor, force, rest = forces(x, w)
        known = {
            "peak_pull <= 200 N": 1.0 - force / 200.0,
            "least_drive >= 5 N": motor / 5.0 - 1.0,
            "rest_margin >= 10 N": (rest - of["m"] * of["g"]) / 10.0 - 1.0,
        }
        return ca.vertcat(*(known[name] for name in task.margins))

    def landed(x: Symbol, columns: Symbol, w: Symbol) -> tuple[Symbol, Symbol, Symbol]:
        change = rates(x, w)
        return x[1], columns[1, 0] - change[1] / change[0] * columns[0, 0], x[0] - Values(task, w).of["l_s"]

    def objective(x: Symbol, _: Symbol, w: Symbol) -> Symbol:
        values = Values(task, w)
        return values.of["l_s"] / values.e[0]

    def durations(start: Start) -> list[float]:
        return [start.duration or 0.15]

    # The motor brings the mass to its speed in a small part of the stroke.
    phase = Phase(residual, None, margins, np.linspace(0.0, 1.0, mesh + 1) ** 2)
    return Climber(2, [phase], lambda w: ca.vertcat(0.0, *Values(task, w).z), landed, objective, durations)


CLIMBERS: dict[str, Callable[[Task, int], Climber]] = {
    "self_exciting": crank,
    "prescribed_length": prescribed,
    "angle_switched": switched,
    "power_stroke": stroke,
}
