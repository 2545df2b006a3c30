"""diffrax: compiled by JAX in double precision, a thousand independent units at a time (`vmap`), each with its own start."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import jax

jax.config.update("jax_enable_x64", True)

import diffrax as dfx  # noqa: E402
import jax.numpy as jnp  # noqa: E402
import numpy as np  # noqa: E402
import optimistix as optx  # noqa: E402

from peers import equations  # noqa: E402
from peers.measure import TOLERANCES, Attempt, Call  # noqa: E402
from peers.units import Unit  # noqa: E402

VERSIONS = ("diffrax", "jax")

BATCH = 1000
STIFF_BATCH = 10
"""Of unit c, which takes long enough to hide what a call costs."""
STIFF_STEPS = 10_000
"""Most steps of a unit by an implicit method."""
TOLERANCES_STIFF = (1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5)
STEPS = (2, 3, 4, 5, 6, 7, 8, 10, 12, 16)
GUESS = 1e-3
"""By how much the event's time is guessed wrongly on the fixed grid (s), as for the other codes that need a guess."""
Map = Callable[[Any], Any]
Controller = tuple[Any, Any]
"""Step size controller and first step."""


def attempts(unit: Unit) -> list[Attempt]:
    """An adaptive and a fixed grid for a and b, implicit methods for c."""
    if unit.key == "c":
        return [
            Attempt(
                f"Kvaerno5, over the crank angle, vmap {STIFF_BATCH}",
                lambda tol: Batch(crank(unit, dfx.Kvaerno5(), tol), unit, STIFF_BATCH),
                TOLERANCES_STIFF,
            )
        ]
    if unit.key == "a":
        adaptive, fixed = prescribed_adaptive, prescribed_fixed
        events = ("", "")
    else:
        adaptive, fixed = switched_adaptive, switched_fixed
        events = (", Event for its time, then up to there and Newton's step", f", event by Newton's method by hand from a guess {GUESS:g} s off")
    return [
        Attempt(
            f"Dopri8, adaptive, vmap {BATCH}{events[0]}", lambda tol: Batch(adaptive(unit, tol), unit, BATCH), TOLERANCES[6:]
        ),
        Attempt(
            f"Dopri8, fixed grid, vmap {BATCH}{events[1]}",
            lambda steps: Batch(fixed(unit, steps), unit, BATCH),
            STEPS,
            "steps",
        ),
    ]


class Batch(Call):
    """A map of section coordinates, compiled for many starts at once; the first is the unit's."""

    def __init__(self, made: Map, unit: Unit, size: int) -> None:
        self.units = size
        starts = np.array(unit.start) * (1.0 + 1e-5 * np.arange(size))[:, None]
        self.starts = jnp.asarray(starts)
        self.map = jax.jit(jax.vmap(made)).lower(self.starts).compile()

    def result(self) -> Sequence[float]:
        return np.asarray(self.map(self.starts))[0]

    def repeat(self, count: int) -> None:
        for _ in range(count):
            self.map(self.starts).block_until_ready()


def pid(tolerance: float) -> Any:
    """The adaptive controller at a tolerance."""
    return dfx.PIDController(rtol=tolerance, atol=0.1 * tolerance)


def flows(unit: Unit, columns: int) -> tuple[Any, Any, Any]:
    """Terms while the leg shortens and when it is short, with variations; the leg."""
    hang = equations.swing(unit.parameters, jnp.sin, jnp.cos)
    leg = equations.leg(unit.parameters, jnp.sin, jnp.cos)

    def both(r: Any, v: Any, y: Any) -> Any:
        out = [*hang.field(r, v, y[0], y[1])]
        for i in range(columns):
            out += hang.variation(r, v, y[0], y[2 + 2 * i], y[3 + 2 * i])
        return jnp.stack(out)

    first = dfx.ODETerm(lambda tau, y, _: both(*leg.shortening(tau), y))
    second = dfx.ODETerm(lambda _tau, y, _: both(leg.short, 0.0, y))
    return first, second, leg


def run(term: Any, end: Any, start: Any, tolerance: float | None, steps: int = 1) -> Any:
    """The state after a time: adaptively, or on a grid of equal steps where there is no tolerance."""
    if tolerance is None:
        controller, first, most = dfx.ConstantStepSize(), end / steps, steps + 1
    else:
        controller, first, most = pid(tolerance), None, 512
    solution = dfx.diffeqsolve(
        term, dfx.Dopri8(), 0.0, end, first, start, stepsize_controller=controller, max_steps=most,
        adjoint=dfx.ForwardMode(),
    )
    return solution.ys[0]


def prescribed_adaptive(unit: Unit, tolerance: float | None, steps: int = 1) -> Map:
    """Unit a."""
    first, _, leg = flows(unit, 2)

    def work(z: Any) -> Any:
        y = run(first, leg.shortened, jnp.array([z[0], z[1], 1.0, 0.0, 0.0, 1.0]), tolerance, steps)
        return jnp.stack(equations.landed(unit.parameters, y[:2], (y[2:4], y[4:6])))

    return work


def prescribed_fixed(unit: Unit, steps: int) -> Map:
    """Unit a on a fixed grid."""
    return prescribed_adaptive(unit, None, steps)


def newton(unit: Unit, term: Any, y: Any, short: float, times: int) -> Any:
    """Steps over the time that misses the event, on the solution itself."""
    for _ in range(times):
        y = run(term, (unit.parameters["psi"] - y[0]) / (y[1] / short), y, None)
    return y


def switched_adaptive(unit: Unit, tolerance: float) -> Map:
    """Unit b: the event's time from a run of the state alone; then state and variations up to there, and Newton's step.

    The state that `Event` gives comes from the interpolant, which misses the wanted error at any tolerance.
    """
    first, second, leg = flows(unit, 1)
    psi = unit.parameters["psi"]

    def crossing(t: Any, y: Any, args: Any, **_: Any) -> Any:  # diffrax passes these names
        return y[0] - psi

    root = optx.Newton(rtol=1e-8, atol=1e-8)
    alone = flows(unit, 0)[1]

    def work(z: Any) -> Any:
        middle = run(first, leg.shortened, jnp.array([psi, z[0], 0.0, 1.0]), tolerance)
        found = dfx.diffeqsolve(
            alone, dfx.Dopri8(), 0.0, 2.0, None, middle[:2], stepsize_controller=pid(1e-5), max_steps=512,
            adjoint=dfx.ForwardMode(), event=dfx.Event(crossing, root, direction=False),
        )
        y = newton(unit, second, run(second, found.ts[0], middle, tolerance), leg.short, 2)
        return jnp.stack(equations.switched(unit.parameters, *y, jnp.sin))

    return work


def switched_fixed(unit: Unit, steps: int) -> Map:
    """Unit b on a fixed grid up to a guess of the event."""
    first, second, leg = flows(unit, 1)
    rest = unit.duration + GUESS - leg.shortened
    more = max(1, round(steps * rest / leg.shortened))

    def work(z: Any) -> Any:
        start = jnp.array([unit.parameters["psi"], z[0], 0.0, 1.0])
        y = run(second, rest, run(first, leg.shortened, start, None, steps), None, more)
        return jnp.stack(equations.switched(unit.parameters, *newton(unit, second, y, leg.short, 2), jnp.sin))

    return work


def crank(unit: Unit, solver: Any, tolerance: float) -> Map:
    """Unit c over the crank angle."""
    made = equations.crank(unit.parameters, jnp.sin, jnp.cos, jnp.sqrt)

    def field(phi: Any, y: Any, _: Any) -> Any:
        out = [*made.field(phi, y[0], y[1], y[2])]
        for i in (3, 6):
            out += made.variation(phi, y[0], y[1], y[2], y[i], y[i + 1], y[i + 2])
        return jnp.stack(out)

    def work(z: Any) -> Any:
        start = jnp.array([made.idle, z[0], z[1], 0.0, 1.0, 0.0, 0.0, 0.0, 1.0])
        y = dfx.diffeqsolve(
            dfx.ODETerm(field), solver, 0.0, math.pi, None, start, stepsize_controller=pid(tolerance),
            max_steps=STIFF_STEPS, adjoint=dfx.ForwardMode(),
        ).ys[0]
        return jnp.stack(equations.landed(unit.parameters, y[1:3], (y[4:6], y[7:9])))

    return work
