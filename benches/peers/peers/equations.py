"""The equations of the three units, once for all codes.

Each function here makes functions of plain scalars from a unit's parameters and the mathematics of a code (`sin` of numba,
CasADi, heyoka, JAX, mpmath ...). `jit` wraps every one of them: numba compiles only what it is given.

The climber hangs from one attachment point: leg length r, its angle q from the downward vertical, the tangential velocity
p = r q'. With the leg's length given, r' = v:

    q' = p/r,   p' = -g sin(q) - v p/r

Units a and b prescribe r(tau) = l_b + l_s/2 (1 + cos(omega tau)) up to tau = pi/omega, and l_b after that. Unit c drives the leg by
a motor behind a crank-slider. Its equation in time, m r_1^2 Omega' = ..., has a mass that vanishes at both dead centres of the crank.
Here it is written over the crank angle phi, with r_1 = dr/dphi and r_2 = dr_1/dphi:

    m r_1^2 Omega dOmega/dphi = r_1 F + c (Omega_0 - Omega) - m r_1 r_2 Omega^2,   F = m g cos(q) + m p^2/r - k (r - l_b)
    Omega dq/dphi = p/r,   Omega dp/dphi = -g sin(q) - r_1 Omega p/r

for phi from 0 to pi: the step then ends at a known place, in every peer's favour. c is the damping of the motor, Omega_0 its idle rate.
A variation is written d. of the same name.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from types import SimpleNamespace
from typing import Any

FLOOR = 1e-9
"""Added to m r_1^2 (kg m^2) where an equation is divided by it; it changes the map by half of it, 4.5e-10."""
Scalar = Any
"""A number, or whatever a code computes with."""
Function = Callable[..., Any]


def as_it_is(function: Function) -> Function:
    """The `jit` of codes that need none."""
    return function


def swing(values: Mapping[str, float], sin: Function, cos: Function, jit: Function = as_it_is) -> SimpleNamespace:
    """Flow of a climber whose leg has length r and speed v: `field`, `variation`."""
    g = values["g"]

    @jit
    def field(r: Scalar, v: Scalar, q: Scalar, p: Scalar) -> tuple[Scalar, Scalar]:
        return p / r, -g * sin(q) - v * p / r

    @jit
    def variation(r: Scalar, v: Scalar, q: Scalar, dq: Scalar, dp: Scalar) -> tuple[Scalar, Scalar]:
        return dp / r, -g * cos(q) * dq - v * dp / r

    return SimpleNamespace(field=field, variation=variation)


def leg(values: Mapping[str, float], sin: Function, cos: Function, jit: Function = as_it_is) -> SimpleNamespace:
    """The prescribed leg: `shortening(tau)` gives r and v up to `shortened` (s); after that r = `short` and v = 0."""
    half, short, omega = 0.5 * values["l_s"], values["l_b"], values["omega"]

    @jit
    def shortening(tau: Scalar) -> tuple[Scalar, Scalar]:
        return short + half * (1.0 + cos(omega * tau)), -half * omega * sin(omega * tau)

    return SimpleNamespace(shortening=shortening, short=short, shortened=math.pi / omega)


def crank(
    values: Mapping[str, float],
    sin: Function,
    cos: Function,
    sqrt: Function,
    jit: Function = as_it_is,
    floor: float = FLOOR,
) -> SimpleNamespace:
    """The crank-slider climber over phi.

    `legs(phi)`: r, r_1, r_2. `forces(phi, w, q, p)`: right-hand side of the first equation, with w = Omega.
    `idle`: Omega_0. `damping`: c. `residual(phi, u, du)`: left minus right-hand sides, the first one divided by c.
    `field(phi, w, q, p)` and `variation(phi, w, q, p, dw, dq, dp)`: solved for the derivatives, for codes that need that. There m r_1^2
    is 0 at the dead centres and gets `floor` (kg m^2) added.
    """
    m, g, k, l_b = values["m"], values["g"], values["k"], values["l_b"]
    a, b = values["l_crank"], values["l_coupler"]
    damping = values["G"] ** 2 * values["tau_stall"] / values["omega_nl"]
    idle = values["command"] * values["omega_nl"] / values["G"]

    @jit
    def legs(phi: Scalar) -> tuple[Scalar, Scalar, Scalar]:
        s, c = sin(phi), cos(phi)
        root = sqrt(b * b - a * a * s * s)
        slope = -a * a * s * c / root
        bend = (-a * a * (c * c - s * s) - slope * slope) / root
        return l_b + a * c + root - (b - a), -a * s + slope, -a * c + bend

    @jit
    def pull(r: Scalar, q: Scalar, p: Scalar) -> Scalar:
        return m * g * cos(q) + m * p * p / r - k * (r - l_b)

    @jit
    def forces(phi: Scalar, w: Scalar, q: Scalar, p: Scalar) -> Scalar:
        r, r_1, r_2 = legs(phi)
        return r_1 * pull(r, q, p) + damping * (idle - w) - m * r_1 * r_2 * w * w

    @jit
    def residual(phi: Scalar, u: tuple[Scalar, ...], du: tuple[Scalar, ...]) -> tuple[Scalar, Scalar, Scalar]:
        w, q, p = u[0], u[1], u[2]
        r, r_1, _ = legs(phi)
        return (
            (m * r_1 * r_1 * w * du[0] - forces(phi, w, q, p)) / damping,
            w * du[1] - p / r,
            w * du[2] + g * sin(q) + r_1 * w * p / r,
        )

    @jit
    def field(phi: Scalar, w: Scalar, q: Scalar, p: Scalar) -> tuple[Scalar, Scalar, Scalar]:
        r, r_1, _ = legs(phi)
        return (
            forces(phi, w, q, p) / ((m * r_1 * r_1 + floor) * w),
            p / (r * w),
            -g * sin(q) / w - r_1 * p / r,
        )

    @jit
    def variation(
        phi: Scalar, w: Scalar, q: Scalar, p: Scalar, dw: Scalar, dq: Scalar, dp: Scalar
    ) -> tuple[Scalar, Scalar, Scalar]:
        r, r_1, r_2 = legs(phi)
        dpull = -m * g * sin(q) * dq + 2.0 * m * p / r * dp
        dforces = r_1 * dpull - (damping + 2.0 * m * r_1 * r_2 * w) * dw
        return (
            (dforces - forces(phi, w, q, p) / w * dw) / ((m * r_1 * r_1 + floor) * w),
            dp / (r * w) - p / (r * w * w) * dw,
            -g * cos(q) / w * dq + g * sin(q) / (w * w) * dw - r_1 * dp / r,
        )

    return SimpleNamespace(
        legs=legs, forces=forces, residual=residual, field=field, variation=variation, idle=idle,
        damping=damping, mass=m,
    )


def landed(values: Mapping[str, float], end: Any, columns: Any) -> list[Scalar]:
    """The result of units a and c: touch-down and mirror of the end state (q, p), and of its two variations (dq, dp).

    q+ = -(q + 2 psi), p+ = -cos(2 psi) p. In c the leg's velocity is zero at the dead centre and has no part in it.
    """
    psi = values["psi"]
    factor = math.cos(2.0 * psi)
    (q, p), (dq0, dp0), (dq1, dp1) = end, columns[0], columns[1]
    return [-(q + 2.0 * psi), -factor * p, -dq0, -dq1, -factor * dp0, -factor * dp1]


def switched(values: Mapping[str, float], q: Scalar, p: Scalar, dq: Scalar, dp: Scalar, sin: Function) -> list[Scalar]:
    """The result of unit b at the event q = psi with the leg short: p+ = -cos(2 psi) p.

    The event moves with the start: its time changes by -dq/q', so the velocity there by dp - p' dq/q'.
    """
    psi, r = values["psi"], values["l_b"]
    factor = math.cos(2.0 * psi)
    rate_q, rate_p = p / r, -values["g"] * sin(q)
    return [-factor * p, -factor * (dp - rate_p * dq / rate_q)]
