"""heyoka: Taylor's method with compiled coefficients; state and variations as one system, one at a time or eight in SIMD lanes."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import heyoka as hy
import numpy as np

from peers import equations
from peers.measure import Attempt, Call, Unable, power
from peers.units import Unit

VERSIONS = ("heyoka",)

LANES = 8
FLOOR = 1e-8
"""Added in unit c (kg m^2). Steps go with its inverse square root; it alone makes an error of 4.5e-9."""
TOLERANCES = tuple(factor * 10.0**-power for power in range(6, 16) for factor in (1.0, 0.3))
"""Tolerances of Taylor's method, which fixes its order."""
Expressions = list[tuple[Any, Any]]


def attempts(unit: Unit) -> list[Attempt | Unable]:
    """One unit at a time, and a batch."""
    if unit.key == "c":
        how = f"over the crank angle, {power(FLOOR, 0)} kg m^2 added to the mass that vanishes"
        return [
            Attempt(f"Taylor, {how}", lambda tol: Crank(unit, tol, 1), TOLERANCES, "tol"),
            Attempt(f"Taylor, {how}, {LANES} at a time", lambda tol: Crank(unit, tol, LANES), TOLERANCES, "tol"),
            Unable("Taylor, the equations as they are", "the method is explicit; it needs the mass inverted"),
        ]
    made = Prescribed if unit.key == "a" else Switched
    event = "" if unit.key == "a" else ", terminal event and event-time term by hand"
    return [
        Attempt(f"Taylor{event}", lambda tol: made(unit, tol, 1), TOLERANCES, "tol"),
        Attempt(f"Taylor{event}, {LANES} at a time", lambda tol: made(unit, tol, LANES), TOLERANCES, "tol"),
    ]


def system(unit: Unit, shortening: bool, columns: int) -> Expressions:
    """Equations of state and variations while the leg shortens, or when it is short."""
    hang = equations.swing(unit.parameters, hy.sin, hy.cos)
    leg = equations.leg(unit.parameters, hy.sin, hy.cos)
    r, v = leg.shortening(hy.time) if shortening else (hy.expression(leg.short), hy.expression(0.0))
    q, p = hy.make_vars("q", "p")
    variables, right = [q, p], [*hang.field(r, v, q, p)]
    for i in range(columns):
        dq, dp = hy.make_vars(f"dq{i}", f"dp{i}")
        variables += [dq, dp]
        right += hang.variation(r, v, q, dq, dp)
    return list(zip(variables, right))


def integrator(equations_: Expressions, tolerance: float, lanes: int, events: Sequence[Any] = ()) -> Any:
    """A compiled integrator at time 0."""
    state = np.zeros(len(equations_) if lanes == 1 else (len(equations_), lanes))
    options = {"tol": tolerance, **({"t_events": list(events)} if events else {})}
    if lanes == 1:
        return hy.taylor_adaptive(equations_, state, **options)
    return hy.taylor_adaptive_batch(equations_, state, **options)


def starts(unit: Unit, lanes: int) -> np.ndarray:
    """Section coordinates of the lanes, a column each, none like another as in a sweep; the first is the unit's."""
    return np.array(unit.start)[:, None] * (1.0 + 1e-3 * np.arange(lanes))


def rewind(flow: Any, lanes: int) -> None:
    """Back to time 0."""
    if lanes == 1:
        flow.time = 0.0
    else:
        flow.set_time(0.0)


class Prescribed(Call):
    """Unit a. What is timed leaves the state and its variations just before touch-down, which is a constant linear map."""

    def __init__(self, unit: Unit, tolerance: float, lanes: int) -> None:
        self.unit, self.units = unit, lanes
        self.flow = integrator(system(unit, True, 2), tolerance, lanes)
        ones = np.tile([[1.0], [0.0], [0.0], [1.0]], lanes)
        self.start = np.vstack([starts(unit, lanes), ones]).reshape(self.flow.state.shape)
        self.end = equations.leg(unit.parameters, hy.sin, hy.cos).shortened

    def result(self) -> Sequence[float]:
        self.repeat(1)
        y = self.flow.state.reshape(6, -1)[:, 0]
        return equations.landed(self.unit.parameters, y[:2], (y[2:4], y[4:6]))

    def repeat(self, count: int) -> None:
        flow, start, end, lanes = self.flow, self.start, self.end, self.units
        for _ in range(count):
            rewind(flow, lanes)
            flow.state[:] = start
            flow.propagate_until(end)


class Switched(Call):
    """Unit b: two integrators, since the leg's length is not smooth at the end of its stroke."""

    def __init__(self, unit: Unit, tolerance: float, lanes: int) -> None:
        self.unit, self.units = unit, lanes
        psi = unit.parameters["psi"]
        self.first = integrator(system(unit, True, 1), tolerance, lanes)
        made = hy.t_event if lanes == 1 else hy.t_event_batch
        back = made(hy.make_vars("q") - psi, direction=hy.event_direction.negative)
        self.second = integrator(system(unit, False, 1), tolerance, lanes, (back,))
        rest = np.tile([[0.0], [1.0]], lanes)
        self.start = np.vstack([np.full(lanes, psi), starts(unit, lanes), rest]).reshape(self.first.state.shape)
        self.end = equations.leg(unit.parameters, hy.sin, hy.cos).shortened

    def result(self) -> Sequence[float]:
        lanes = [np.ravel(x) for x in self.once()]
        missed = np.abs(self.second.state[0] - self.unit.parameters["psi"])
        if np.max(missed) > 1e-12:
            raise RuntimeError(f"an event is missed by {np.max(missed):.1e}")
        return [float(lane[0]) for lane in lanes]

    def once(self) -> Sequence[Any]:
        first, second, lanes = self.first, self.second, self.units
        rewind(first, lanes)
        first.state[:] = self.start
        first.propagate_until(self.end)
        second.reset_cooldowns()
        rewind(second, lanes)
        second.state[:] = first.state
        second.propagate_until(2.0)
        if lanes == 1:
            return equations.switched(self.unit.parameters, *second.state.tolist(), math.sin)
        return equations.switched(self.unit.parameters, *second.state, np.sin)

    def repeat(self, count: int) -> None:
        for _ in range(count):
            self.once()


class Crank(Call):
    """Unit c. What is timed leaves the state and its variations just before touch-down, as in unit a."""

    def __init__(self, unit: Unit, tolerance: float, lanes: int) -> None:
        self.unit, self.units = unit, lanes
        made = equations.crank(unit.parameters, hy.sin, hy.cos, hy.sqrt, floor=FLOOR)
        state = hy.make_vars("w", "q", "p")
        variables, right = [*state], [*made.field(hy.time, *state)]
        for i in range(2):
            d = hy.make_vars(f"dw{i}", f"dq{i}", f"dp{i}")
            variables += d
            right += made.variation(hy.time, *state, *d)
        self.flow = integrator(list(zip(variables, right)), tolerance, lanes)
        rest = np.tile([[0.0], [1.0], [0.0], [0.0], [0.0], [1.0]], lanes)
        start = np.vstack([np.full(lanes, made.idle), starts(unit, lanes), rest])
        self.start = start.reshape(self.flow.state.shape)

    def result(self) -> Sequence[float]:
        self.repeat(1)
        y = self.flow.state.reshape(9, -1)[:, 0]
        return equations.landed(self.unit.parameters, y[1:3], (y[4:6], y[7:9]))

    def repeat(self, count: int) -> None:
        flow, start, lanes = self.flow, self.start, self.units
        for _ in range(count):
            rewind(flow, lanes)
            flow.state[:] = start
            flow.propagate_until(math.pi)
