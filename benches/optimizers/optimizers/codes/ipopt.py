"""CasADi and IPOPT: direct collocation of one step with its variations, stability by the Jury inequalities of the Jacobian."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import casadi as ca
import numpy as np

from optimizers.cases import Claim, Configuration, Start, Task, Vector
from optimizers.climbers import CLIMBERS
from optimizers.collocation import Flow, Points, Symbol

VERSIONS = ("casadi",)

ROUNDS = 5
"""How often the places are moved where bounds along the path are imposed."""
WITHIN = 1e-7
"""Largest violation of such a bound between those places, relative to the bound."""
FINE = 21
"""Where the polynomials of an interval are looked at for that."""


@dataclass(frozen=True)
class Setting:
    """One way to use IPOPT."""

    name: str
    options: Mapping[str, Any] = field(default_factory=dict)


SETTINGS = (
    Setting("exact Hessian"),
    Setting("exact Hessian, not scaled by IPOPT", {"nlp_scaling_method": "none"}),
    Setting("quasi-Newton Hessian", {"hessian_approximation": "limited-memory"}),
)
"""The best of what was tried, see README.md."""
GRIDS = {"self_exciting": (7, 12), "prescribed_length": (5, 4), "angle_switched": (5, 4), "power_stroke": (5, 8)}
"""Degree and number of intervals with which the objective is right to 1e-6 at the optimum."""
LIMITS = {"max_iter": 1000, "max_cpu_time": 60.0}


def configurations(task: Task) -> list[Configuration]:
    return [Configuration(setting.name, lambda s=setting: Collocated(task, s).solve) for setting in SETTINGS]


class Collocated:
    """The program of a task, and its solvers: one from a start, one from a solution with other places for bounds."""

    def __init__(self, task: Task, setting: Setting) -> None:
        self.task = task
        degree, intervals = GRIDS[task.case.model]
        self.climber = CLIMBERS[task.case.model](task, intervals)
        extra = len(self.climber.durations(Start(task.given, task.guess, None)))
        self.constants = task.m + task.d + extra
        points = Points(degree)
        self.flows = [Flow(phase, self.climber.size, task.d, self.constants, points) for phase in self.climber.phases]
        self.build(setting)

    def build(self, setting: Setting) -> None:
        task, climber = self.task, self.climber
        w = ca.MX.sym("w", self.constants)
        inner = [ca.MX.sym(f"inner{i}", flow.rows, flow.count) for i, flow in enumerate(self.flows)]
        places = [ca.MX.sym(f"places{i}", len(task.margins) if f.margins else 0, len(f.widths)) for i, f in enumerate(self.flows)]
        self.begin = self.beginning()
        begin, equal, margins, total = self.begin(w), [], [], 0.0
        between = []
        for flow, part, at in zip(self.flows, inner, places):
            equal.append(ca.vec(flow.defects(begin, part, w)))
            total = total + flow.integral(part, w)
            if flow.margins is not None:
                margins.append(ca.vec(flow.margins_at_points(begin, part, w)))
                between.append(flow.margins_between(begin, part, w, at))
            begin = part[:, -1]
        end, columns = begin[: climber.size], ca.reshape(begin[climber.size :], climber.size, task.d)
        image, jacobian, ended = climber.landed(end, columns, w)
        equal += [image - w[task.m : task.m + task.d], ended]
        margins += [ca.vec(m) for m in between] + [jury(jacobian, task.d, task.radius)]
        equal, margins = ca.vertcat(*equal), ca.vertcat(*margins)
        x, parameters = ca.vertcat(w, *(ca.vec(p) for p in inner)), ca.vertcat(ca.MX(0, 1), *(ca.vec(p) for p in places))
        program = {"x": x, "p": parameters, "f": -task.sign * climber.objective(end, total, w), "g": ca.vertcat(equal, margins)}
        self.between = ca.Function("between", [x, parameters], [ca.horzcat(*between)] if between else [ca.MX(0, 0)])
        self.lower_g = np.zeros(program["g"].numel())
        self.upper_g = np.concatenate([np.zeros(equal.numel()), np.full(margins.numel(), np.inf)])
        self.bounds(x.numel())
        options = {"expand": True, "print_time": False, "ipopt": {"print_level": 0, "sb": "yes", **LIMITS, **setting.options}}
        self.first = ca.nlpsol("first", "ipopt", program, options)
        warm = {"warm_start_init_point": "yes", "mu_init": 1e-6, "warm_start_bound_push": 1e-9, "warm_start_mult_bound_push": 1e-9}
        self.again = ca.nlpsol("again", "ipopt", program, options | {"ipopt": options["ipopt"] | warm}) if between else None
        self.marchers = [flow.marcher() for flow in self.flows]

    def beginning(self) -> ca.Function:
        """x and its columns at the beginning, of w."""
        task, w = self.task, ca.SX.sym("w", self.constants)
        x = self.climber.begin(w)
        columns = ca.jacobian(x, w)[:, task.m : task.m + task.d]
        return ca.Function("beginning", [w], [ca.vertcat(x, ca.vec(columns))])

    def bounds(self, size: int) -> None:
        task = self.task
        self.lower, self.upper = np.full(size, -np.inf), np.full(size, np.inf)
        self.lower[: task.m], self.upper[: task.m] = 0.0, 1.0
        of = slice(task.m + task.d, self.constants)
        self.lower[of], self.upper[of] = 1e-3, self.climber.longest

    def solve(self, start: Start) -> Claim:
        """IPOPT from the simulated gait; where bounds along the path are violated between their places, these are moved to the worst
        and IPOPT goes on from its solution."""
        places = [np.full((f.margins.size1_out(0), len(f.widths)), 0.5) for f in self.flows if f.margins is not None]
        found = self.first(x0=self.guess(start), p=flat(places), lbx=self.lower, ubx=self.upper, lbg=self.lower_g, ubg=self.upper_g)
        status, iterations = self.first.stats(), self.first.stats()["iter_count"]
        for _ in range(ROUNDS if self.again is not None and status["success"] else 0):
            places, worst = self.worst(np.array(found["x"]).ravel())
            if worst > -WITHIN:
                break
            found = self.again(
                x0=found["x"], lam_x0=found["lam_x"], lam_g0=found["lam_g"], p=flat(places),
                lbx=self.lower, ubx=self.upper, lbg=self.lower_g, ubg=self.upper_g,
            )
            status = self.again.stats()
            iterations += status["iter_count"]
            if not status["success"]:
                break
        w, task = np.array(found["x"]).ravel()[: self.constants], self.task
        p = np.clip(task.lower + w[: task.m] * (task.upper - task.lower), task.lower, task.upper)
        return Claim(bool(status["success"]), status["return_status"], p, w[task.m : task.m + task.d], iterations)

    def guess(self, start: Start) -> Vector:
        """Start, and the step from there on the mesh; a constant state where it cannot be integrated."""
        task = self.task
        u = (start.p - task.lower) / (task.upper - task.lower)
        w = np.concatenate([u, start.z, self.climber.durations(start)])
        begin, parts = np.array(self.begin(w)).ravel(), []
        for flow, march in zip(self.flows, self.marchers):
            part = march(begin, w)
            part = np.tile(begin[:, None], flow.count) if part is None else part
            parts.append(part.ravel(order="F"))
            begin = part[:, -1]
        return np.concatenate([w, *parts])

    def worst(self, x: Vector) -> tuple[list[Vector], float]:
        """Where the margins are least in each interval, and the least of all."""
        (flow,) = (f for f in self.flows if f.margins is not None)
        at, worst = flow.worst_places(lambda at: np.array(self.between(x, flat([at]))), FINE)
        return [at], worst


def flat(places: list[Vector]) -> Vector:
    return np.concatenate([np.zeros(0), *(at.ravel(order="F") for at in places)])


def jury(jacobian: Symbol, size: int, radius: float) -> Symbol:
    """What must not be negative for a spectral radius of at most `radius`, for one or two coordinates; as it is kindest to a solver."""
    if math.isinf(radius):
        return ca.MX(0, 1)
    scaled = jacobian / radius
    if size == 1:
        return ca.vertcat(1.0 - scaled, 1.0 + scaled)
    trace = scaled[0, 0] + scaled[1, 1]
    determinant = scaled[0, 0] * scaled[1, 1] - scaled[0, 1] * scaled[1, 0]
    return ca.vertcat(1.0 - trace + determinant, 1.0 + trace + determinant, 1.0 - determinant)
