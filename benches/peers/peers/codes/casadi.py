"""CasADi, in three ways: fixed grids unrolled into one expression whose value and Jacobian are generated as C and compiled;
collocation the same way; and CVODES with its forward sensitivities.
"""

from __future__ import annotations

import ctypes
import math
import subprocess
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np
from scipy.integrate._ivp import dop853_coefficients as dop853

from peers import equations
from peers.measure import TOLERANCES, Attempt, Call, Unable
from peers.units import Unit

VERSIONS = ("casadi",)

sin, cos, sqrt = ca.sin, ca.cos, ca.sqrt
State = list[Any]
Field = Callable[[Any, State], State]
"""Derivatives of a state at a time, as expressions."""

ORDER_8 = (dop853.A[:12, :12], dop853.B, dop853.C[:12])
ORDER_4 = (
    np.array([[0, 0, 0, 0], [0.5, 0, 0, 0], [0, 0.5, 0, 0], [0, 0, 1.0, 0]]),
    np.array([1, 2, 2, 1]) / 6,
    np.array([0, 0.5, 0.5, 1.0]),
)
NO_EVENT = "measured: `zero` and `transition`, marked experimental, find the event and then end in CV_ILL_INPUT"
GUESS = 1e-3
"""By how much the event's time is guessed wrongly in unit b (s): a fixed grid needs a guess, and a sweep has one of about that quality."""


def attempts(unit: Unit) -> list[Attempt | Unable]:
    """The ways that suit a unit."""
    over = ", over the crank angle" if unit.key == "c" else ""
    with_cvodes = [
        Attempt(f"CVODES, {how}{over}", lambda tol, flag=flag: cvodes(unit, tol, flag), TOLERANCES)
        for how, flag in (("its forward sensitivities", True), ("variations as part of the system", False))
    ]
    if unit.key == "c":
        grid = Attempt(
            "generated C, fixed grid over the crank angle, Radau IIA with 5 stages",
            lambda size: Compiled(collocated(unit, *size), unit.start),
            [(steps, iterations) for steps in (5, 6, 7, 8, 9, 10, 12, 14, 16, 20, 24) for iterations in (2, 3)],
            "(steps, Newton iterations)",
        )
        return [grid, *with_cvodes]
    how = "" if unit.key == "a" else f", event by Newton's method from a guess {GUESS:g} s off"
    grids: list[Attempt | Unable] = [
        Attempt(
            f"generated C, fixed grid, {name}{how}",
            lambda steps, tableau=tableau: Compiled(unrolled(unit, tableau, steps), unit.start),
            sizes,
            "steps",
        )
        for name, tableau, sizes in (
            ("order 8 (12 stages)", ORDER_8, (2, 3, 4, 5, 6, 7, 8, 10, 12)),
            ("RK4", ORDER_4, (16, 24, 32, 48, 64, 80, 96, 128, 192, 256)),
        )
    ]
    if unit.key == "b":
        with_guess = Attempt(f"CVODES, variations as part of the system{how}", lambda tol: guessed(unit, tol), TOLERANCES)
        return [*grids, with_guess, Unable("CVODES, its own events", NO_EVENT)]
    return [*grids, *with_cvodes]


def runge_kutta(field: Field, tableau: Any, begin: Any, width: Any, steps: int, state: State) -> State:
    """An explicit method on a grid of equal steps."""
    a, b, c = tableau
    h = width / steps
    for i in range(steps):
        at, k = begin + i * h, []
        for row, where in zip(a, c):
            stage = [x + h * sum(w * d[j] for w, d in zip(row, k) if w) for j, x in enumerate(state)]
            k.append(field(at + where * h, stage))
        state = [x + h * sum(w * d[j] for w, d in zip(b, k) if w) for j, x in enumerate(state)]
    return state


def unrolled(unit: Unit, tableau: Any, steps: int) -> ca.Function:
    """Units a and b: from section coordinates to image and Jacobian, parameters built in."""
    z = ca.SX.sym("z", len(unit.start))
    hang = equations.swing(unit.parameters, sin, cos)
    # Times are numbers on this grid, so the leg's length folds to constants.
    leg = equations.leg(unit.parameters, math.sin, math.cos)
    shortening: Field = lambda tau, y: list(hang.field(*leg.shortening(tau), *y))
    short: Field = lambda _tau, y: list(hang.field(leg.short, 0.0, *y))
    psi = unit.parameters["psi"]
    if unit.key == "a":
        q, p = runge_kutta(shortening, tableau, 0.0, leg.shortened, steps, [z[0], z[1]])
        variations = [[ca.jacobian(x, z)[i] for x in (q, p)] for i in range(2)]
        return function(z, equations.landed(unit.parameters, (q, p), variations))
    middle = runge_kutta(shortening, tableau, 0.0, leg.shortened, steps, [ca.SX(psi), z[0]])
    rest = unit.duration + GUESS - leg.shortened
    q, p = runge_kutta(short, tableau, 0.0, rest, max(1, round(steps * rest / leg.shortened)), middle)
    # Newton's method on the true solution: one step of the same method over the time that misses, twice.
    for _ in range(2):
        q, p = runge_kutta(short, tableau, 0.0, (psi - q) / (p / leg.short), 1, [q, p])
    # The event's time has been differentiated along, one iteration behind; the event-time term is what is left of that.
    return function(z, equations.switched(unit.parameters, q, p, ca.jacobian(q, z), ca.jacobian(p, z), sin))


def collocated(unit: Unit, steps: int, iterations: int) -> ca.Function:
    """Unit c: Radau IIA with 5 stages over phi, each step its own function that takes its guess from the step before.

    Simplified Newton's method with the matrix at the guess, then one iteration with the matrix there, which also
    gives the variations (implicit function theorem). The grid is finer towards both dead centres.
    """
    made = equations.crank(unit.parameters, sin, cos, sqrt)
    step = radau_step(made, iterations)
    grid = [math.pi * 0.5 * (1 - math.cos(math.pi * i / steps)) for i in range(steps + 1)]
    begins, widths = ca.DM(grid[:-1]).T, ca.DM(grid[1:]).T - ca.DM(grid[:-1]).T
    ratios = ca.DM([1e-9, *(float(widths[i + 1] / widths[i]) for i in range(steps - 1))]).T
    z = ca.MX.sym("z", 2)
    start = ca.vertcat(made.idle, z)
    carried = ca.vertcat(start, ca.DM([0, 1, 0, 0, 0, 1]), *[start] * 5)
    end = step.mapaccum(steps)(carried, ca.vertcat(begins, widths, ratios))[:, -1]
    result = equations.landed(unit.parameters, (end[1], end[2]), ((end[4], end[5]), (end[7], end[8])))
    return ca.Function("unit", [z], [ca.vertcat(*result)])


def radau_step(made: Any, iterations: int) -> ca.Function:
    """One step. Carried: u, its two variations, the stages. Input: begin, width, width over that of the step before."""
    nodes = ca.collocation_points(STAGES, "radau")
    slopes = lagrange([0.0, *nodes], [0.0, *nodes])[1]
    carried, where = ca.SX.sym("carried", 9 + 3 * STAGES), ca.SX.sym("where", 3)
    begin, width, ratio = where[0], where[1], where[2]
    u0, unknown = ca.SX.sym("u0", 3), ca.SX.sym("stages", 3 * STAGES)
    points = [u0, *(unknown[3 * i : 3 * i + 3] for i in range(STAGES))]
    rows: list[Any] = []
    for i, node in enumerate(nodes, start=1):
        du = [sum(slopes[i][j] * point[k] for j, point in enumerate(points)) / width for k in range(3)]
        rows += made.residual(begin + node * width, (points[i][0], points[i][1], points[i][2]), du)
    residual = ca.vertcat(*rows)
    inputs = [unknown, u0, where]
    rest = ca.Function("rest", inputs, [residual])
    with_stages = ca.Function("with_stages", inputs, [ca.jacobian(residual, unknown)])
    with_start = ca.Function("with_start", inputs, [ca.jacobian(residual, u0)])
    start, before = carried[:3], [carried[9 + 3 * i : 12 + 3 * i] for i in range(STAGES)]
    # The polynomial of the step before, continued; at the first step it is constant.
    value = lagrange_at(nodes, before, [1 + ratio * node for node in nodes])
    stages = ca.vertcat(*value)
    factors = Lu(with_stages(stages, start, where))
    for _ in range(iterations):
        stages = stages - factors.solve(rest(stages, start, where))
    factors = Lu(with_stages(stages, start, where))
    variations = []
    for column in (carried[3:6], carried[6:9]):
        right = -ca.mtimes(with_start(stages, start, where), column)
        variations.append(factors.solve(right)[-3:])
    stages = stages - factors.solve(rest(stages, start, where))
    return ca.Function("step", [carried, where], [ca.vertcat(stages[-3:], *variations, stages)], {"cse": True})


STAGES = 5


def lagrange(nodes: Sequence[float], at: Sequence[float]) -> tuple[np.ndarray, np.ndarray]:
    """Values and slopes of the Lagrange polynomials of the nodes: a row a point, a column a polynomial."""
    values, slopes = np.zeros((len(at), len(nodes))), np.zeros((len(at), len(nodes)))
    for j, node in enumerate(nodes):
        polynomial = np.poly1d([1.0])
        for other in nodes:
            if other != node:
                polynomial *= np.poly1d([1.0, -other]) / (node - other)
        values[:, j], slopes[:, j] = polynomial(at), polynomial.deriv()(at)
    return values, slopes


def lagrange_at(nodes: Sequence[float], values: Sequence[Any], at: Sequence[Any]) -> list[Any]:
    """The polynomial through values at nodes, at points that are expressions."""
    out = []
    for x in at:
        weights = [math.prod((x - b) / (a - b) for b in nodes if b != a) for a in nodes]
        out.append(sum(w * value for w, value in zip(weights, values)))
    return out


class Lu:
    """Elimination without pivoting, unrolled, on whatever is not structurally zero."""

    def __init__(self, matrix: ca.SX) -> None:
        n = matrix.shape[0]
        self.rows = [[matrix[i, j] if matrix.sparsity().has_nz(i, j) else 0.0 for j in range(n)] for i in range(n)]
        self.inverse = []
        for k in range(n):
            self.inverse.append(1.0 / self.rows[k][k])
            for i in range(k + 1, n):
                if is_zero(self.rows[i][k]):
                    continue
                factor = self.rows[i][k] = self.rows[i][k] * self.inverse[k]
                for j in range(k + 1, n):
                    if not is_zero(self.rows[k][j]):
                        self.rows[i][j] = self.rows[i][j] - factor * self.rows[k][j]

    def solve(self, right: ca.SX) -> ca.SX:
        """The solution for a right-hand side."""
        x = [right[i] for i in range(len(self.rows))]
        for i, row in enumerate(self.rows):
            for j in range(i):
                if not is_zero(row[j]):
                    x[i] = x[i] - row[j] * x[j]
        for i in reversed(range(len(x))):
            for j in range(i + 1, len(x)):
                if not is_zero(self.rows[i][j]):
                    x[i] = x[i] - self.rows[i][j] * x[j]
            x[i] = x[i] * self.inverse[i]
        return ca.vertcat(*x)


def is_zero(entry: Any) -> bool:
    """Whether an entry is zero by structure."""
    return isinstance(entry, float) and entry == 0.0


def function(z: ca.SX, result: Sequence[Any]) -> ca.Function:
    """From section coordinates to a result, common subexpressions shared."""
    return ca.Function("unit", [z], [ca.vertcat(*result)], {"cse": True})


class Compiled(Call):
    """A function as C, compiled for this processor, with a loop around it so that Python is not timed."""

    LOOP = """
void repeat(casadi_int n, const double** arg, double** res, casadi_int* iw, double* w) {
  for (casadi_int i = 0; i < n; ++i) unit(arg, res, iw, w, 0);
}
"""

    def __init__(self, made: ca.Function, start: Sequence[float]) -> None:
        with tempfile.TemporaryDirectory() as folder:
            library = compile_c(made, Path(folder), self.LOOP)
        self.start, self.out = np.array(start), np.zeros(made.size1_out(0))
        pointer = ctypes.POINTER(ctypes.c_double)
        self.arguments = (pointer * made.sz_arg())(self.start.ctypes.data_as(pointer))
        self.results = (pointer * made.sz_res())(self.out.ctypes.data_as(pointer))
        self.integers = (ctypes.c_longlong * max(1, made.sz_iw()))()
        self.numbers = (ctypes.c_double * max(1, made.sz_w()))()
        self.loop = library.repeat

    def result(self) -> Sequence[float]:
        self.repeat(1)
        return self.out.copy()

    def repeat(self, count: int) -> None:
        self.loop(ctypes.c_longlong(count), self.arguments, self.results, self.integers, self.numbers)


def compile_c(made: ca.Function, folder: Path, more: str) -> ctypes.CDLL:
    """Generates C in a folder, compiles and loads it."""
    generator = ca.CodeGenerator("unit.c", {"with_header": False})
    generator.add(made)
    generator.generate(f"{folder}/")
    source = folder / "unit.c"
    source.write_text(source.read_text() + more)
    command = ["cc", "-O3", "-march=native", "-ffast-math", "-fno-finite-math-only", "-shared", "-fPIC"]
    subprocess.run([*command, "-o", folder / "unit.so", source, "-lm"], check=True, capture_output=True)
    return ctypes.CDLL(str(folder / "unit.so"))


class Buffered(Call):
    """A function called in place, without converting arguments."""

    def __init__(self, made: ca.Function, start: Sequence[float]) -> None:
        self.made, self.start, self.out = made, np.array(start), np.zeros(made.size1_out(0))
        self.buffer, self.work = made.buffer()
        self.buffer.set_arg(0, memoryview(self.start))
        self.buffer.set_res(0, memoryview(self.out))

    def result(self) -> Sequence[float]:
        self.out[:] = np.nan
        self.work()
        return self.out.copy()

    def repeat(self, count: int) -> None:
        for _ in range(count):
            self.work()


def cvodes(unit: Unit, tolerance: float, by_casadi: bool) -> Call:
    """Units a and c by CVODES: variations by CasADi's forward sensitivities, or as part of the system."""
    values, time = unit.parameters, ca.SX.sym("t")
    size, columns = (3 if unit.key == "c" else 2), (0 if by_casadi else 2)
    x = ca.SX.sym("x", size * (1 + columns))
    parts = [[x[size * i + j] for j in range(size)] for i in range(1 + columns)]
    if unit.key == "c":
        made = equations.crank(values, sin, cos, sqrt)
        right = [*made.field(time, *parts[0])]
        for part in parts[1:]:
            right += made.variation(time, *parts[0], *part)
        end, start = math.pi, [made.idle]
    else:
        hang, leg = equations.swing(values, sin, cos), equations.leg(values, sin, cos)
        r_v = leg.shortening(time)
        right = [*hang.field(*r_v, *parts[0])]
        for part in parts[1:]:
            right += hang.variation(*r_v, parts[0][0], *part)
        end, start = leg.shortened, []
    options = {"reltol": tolerance, "abstol": 0.1 * tolerance, "max_num_steps": 100_000}
    problem = {"x": x, "t": time, "ode": ca.vertcat(*right)}
    solver = ca.integrator("flow", "cvodes", problem, 0.0, end, options)
    z = ca.MX.sym("z", 2)
    ones = [] if by_casadi else [0.0] * len(start) + [1.0, 0.0] + [0.0] * len(start) + [0.0, 1.0]
    final = solver(x0=ca.vertcat(*start, z, *ones))["xf"]
    q, p = final[size - 2], final[size - 1]
    if by_casadi:
        jacobian = ca.jacobian(ca.vertcat(q, p), z)
        variations = [(jacobian[0, i], jacobian[1, i]) for i in range(2)]
    else:
        variations = [(final[size * i + size - 2], final[size * i + size - 1]) for i in (1, 2)]
    result = ca.vertcat(*equations.landed(values, (q, p), variations))
    return Buffered(ca.Function("unit", [z], [result]), unit.start)


def guessed(unit: Unit, tolerance: float) -> Call:
    """Unit b by CVODES up to a guess of the event, then Newton's method on the solution; time is scaled so that it can vary."""
    values, tau, span, y = unit.parameters, ca.SX.sym("tau"), ca.SX.sym("span"), ca.SX.sym("y", 4)
    hang, leg = equations.swing(values, sin, cos), equations.leg(values, sin, cos)
    options = {"reltol": tolerance, "abstol": 0.1 * tolerance, "max_num_steps": 100_000}

    def flow(name: str, r: Any, v: Any, problem: dict[str, Any], end: float) -> ca.Function:
        right = ca.vertcat(*hang.field(r, v, y[0], y[1]), *hang.variation(r, v, y[0], y[2], y[3]))
        scale = problem.get("p", 1.0)
        return ca.integrator(name, "cvodes", {"x": y, "ode": scale * right, **problem}, 0.0, end, options)

    first = flow("first", *leg.shortening(tau), {"t": tau}, leg.shortened)
    second = flow("second", leg.short, 0.0, {"p": span}, 1.0)
    z = ca.MX.sym("z")
    state = first(x0=ca.vertcat(values["psi"], z, 0.0, 1.0))["xf"]
    state = second(x0=state, p=unit.duration + GUESS - leg.shortened)["xf"]
    for _ in range(2):
        state = second(x0=state, p=(values["psi"] - state[0]) / (state[1] / leg.short))["xf"]
    result = ca.vertcat(*equations.switched(values, *(state[i] for i in range(4)), sin))
    return Buffered(ca.Function("unit", [z], [result]), unit.start)
