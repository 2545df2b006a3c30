"""Direct collocation of one step of a climber with its variational equations, as one nonlinear program for IPOPT.

A step is a chain of phases, each over s in [0, 1] with equations F(s, x, dx/ds, w) = 0; w holds all that is constant along a step.
Every phase is cut into intervals, where x is a polynomial through the Radau points, of which the last is the end of the interval.
The variations X = dx/dz obey F_x X + F_x' X' = 0; they are collocated on the same points, so that the derivative of the return map
is exact for the collocated map. Trajectories are matrices with a column a collocation point: x in the first rows, then X by columns.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

Vector = NDArray[np.float64]
Symbol = Any
"""A CasADi expression."""


@dataclass(frozen=True)
class Phase:
    """A stretch of a step with smooth equations.

    `residual(s, x, dx, w)` gives F, `rate(s, x, w)` a quantity whose integral over s is wanted (or None), and
    `margins(s, x, dx, w)` what must not be negative anywhere (or None), scaled.
    """

    residual: Callable[[Symbol, Symbol, Symbol, Symbol], Symbol]
    rate: Callable[[Symbol, Symbol, Symbol], Symbol] | None
    margins: Callable[[Symbol, Symbol, Symbol, Symbol], Symbol] | None
    mesh: Vector
    """Where the intervals begin and end, from 0 to 1."""


class Points:
    """Radau points of a degree, on [0, 1], and the polynomials through 0 and them."""

    def __init__(self, degree: int) -> None:
        self.degree = degree
        self.at = np.array(ca.collocation_points(degree, "radau"))
        nodes = np.concatenate([[0.0], self.at])
        self.basis = []
        for j, node in enumerate(nodes):
            polynomial = np.poly1d([1.0])
            for i, other in enumerate(nodes):
                if i != j:
                    polynomial *= np.poly1d([1.0, -other]) / (node - other)
            self.basis.append(polynomial)
        self.slopes = self.slope_weights(self.at)
        """(degree + 1) x degree: slopes at the points from values at 0 and at the points."""
        # The weights of Radau quadrature: integrals of the polynomials through the points alone.
        vandermonde = np.vander(self.at, increasing=True).T
        self.weights = np.linalg.solve(vandermonde, 1.0 / np.arange(1, degree + 1))

    def value_weights(self, at: Vector) -> Vector:
        return np.array([polynomial(at) for polynomial in self.basis])

    def slope_weights(self, at: Vector) -> Vector:
        return np.array([polynomial.deriv()(at) for polynomial in self.basis])

    def symbolic(self, at: Symbol) -> tuple[Symbol, Symbol]:
        """Weights of value and slope at a symbolic place."""

        def column(polynomials: Sequence[Any]) -> Symbol:
            return ca.vertcat(*(horner(polynomial.coeffs, at) for polynomial in polynomials))

        return column(self.basis), column([polynomial.deriv() for polynomial in self.basis])


def horner(coefficients: Vector, at: Symbol) -> Symbol:
    value: Symbol = 0.0
    for coefficient in coefficients:
        value = value * at + float(coefficient)
    return value


class Flow:
    """A phase on its mesh, with the variations along `columns` section coordinates."""

    def __init__(self, phase: Phase, size: int, columns: int, constants: int, points: Points) -> None:
        self.phase, self.points = phase, points
        self.n, self.rows = size, size * (1 + columns)
        s, w = ca.SX.sym("s"), ca.SX.sym("w", constants)
        y, dy = ca.SX.sym("y", self.rows), ca.SX.sym("dy", self.rows)
        x, dx = y[:size], dy[:size]
        equations = phase.residual(s, x, dx, w)
        varied = [
            ca.jtimes(equations, x, y[size * j : size * (j + 1)]) + ca.jtimes(equations, dx, dy[size * j : size * (j + 1)])
            for j in range(1, 1 + columns)
        ]
        self.equations = ca.Function("equations", [s, y, dy, w], [ca.vertcat(equations, *varied)])
        self.rate = None if phase.rate is None else ca.Function("rate", [s, x, w], [phase.rate(s, x, w)])
        self.margins = None
        if phase.margins is not None:
            self.margins = ca.Function("margins", [s, x, dx, w], [phase.margins(s, x, dx, w)])
        self.widths = np.diff(phase.mesh)
        self.places = np.concatenate([a + h * points.at for a, h in zip(phase.mesh, self.widths)])
        """s of all collocation points."""
        self.count = len(self.places)

    def rates(self, begin: Symbol, inner: Symbol) -> Symbol:
        """dy/ds at all collocation points."""
        degree, columns = self.points.degree, []
        for i, h in enumerate(self.widths):
            values = ca.horzcat(begin, inner[:, degree * i : degree * (i + 1)])
            columns.append(ca.mtimes(values, self.points.slopes / h))
            begin = inner[:, degree * (i + 1) - 1]
        return ca.horzcat(*columns)

    def defects(self, begin: Symbol, inner: Symbol, w: Symbol) -> Symbol:
        """The equations at all collocation points."""
        every = self.equations.map(self.count)
        repeated = ca.repmat(w, 1, self.count)
        return every(self.places.reshape(1, -1), inner, self.rates(begin, inner), repeated)

    def integral(self, inner: Symbol, w: Symbol) -> Symbol:
        """The integral of the rate over s."""
        if self.rate is None:
            return 0.0
        weights = np.concatenate([h * self.points.weights for h in self.widths])
        values = self.rate.map(self.count)(self.places.reshape(1, -1), inner[: self.n, :], ca.repmat(w, 1, self.count))
        return ca.mtimes(values, weights)

    def margins_at_points(self, begin: Symbol, inner: Symbol, w: Symbol) -> Symbol:
        """All margins at the beginning of the phase and at the collocation points, one column a point."""
        n, rates = self.n, self.rates(begin, inner)
        first = ca.mtimes(ca.horzcat(begin[:n], inner[:n, : self.points.degree]), self.points.slope_weights(np.array([0.0])) / self.widths[0])
        every = self.margins.map(self.count)
        later = every(self.places.reshape(1, -1), inner[:n, :], rates[:n, :], ca.repmat(w, 1, self.count))
        return ca.horzcat(self.margins(0.0, begin[:n], first, w), later)

    def margins_between(self, begin: Symbol, inner: Symbol, w: Symbol, at: Symbol) -> Symbol:
        """Margin i at the place `at[i, j]` of [0, 1] in interval j, on the polynomials."""
        degree, n, columns = self.points.degree, self.n, []
        for j, h in enumerate(self.widths):
            values = ca.horzcat(begin[:n], inner[:n, degree * j : degree * (j + 1)])
            found = []
            for i in range(at.shape[0]):
                value, slope = self.points.symbolic(at[i, j])
                s = self.phase.mesh[j] + h * at[i, j]
                found.append(self.margins(s, ca.mtimes(values, value), ca.mtimes(values, slope) / h, w)[i])
            columns.append(ca.vertcat(*found))
            begin = inner[:, degree * (j + 1) - 1]
        return ca.horzcat(*columns)

    def marcher(self) -> Callable[[Vector, Vector], Vector | None]:
        """Solves the equations interval by interval from the beginning: the trajectory at the collocation points."""
        degree, rows = self.points.degree, self.rows
        unknown = ca.MX.sym("unknown", rows, degree)
        begin, w = ca.MX.sym("begin", rows), ca.MX.sym("w", self.equations.size1_in(3))
        a, h = ca.MX.sym("a"), ca.MX.sym("h")
        rates = ca.mtimes(ca.horzcat(begin, unknown), self.points.slopes) / h
        places = ca.repmat(a, 1, degree) + h * self.points.at.reshape(1, -1)
        left = self.equations.map(degree)(places, unknown, rates, ca.repmat(w, 1, degree))
        solver = ca.rootfinder(
            "march", "newton", {"x": ca.vec(unknown), "p": ca.vertcat(begin, w, a, h), "g": ca.vec(left)},
            {"abstol": 1e-11, "error_on_fail": False, "max_iter": 50},
        )

        def march(begin: Vector, w: Vector) -> Vector | None:
            parts = []
            for a, h in zip(self.phase.mesh, self.widths):
                guess = np.tile(begin, degree)
                found = solver(x0=guess, p=np.concatenate([begin, w, [a, h]]))["x"]
                part = np.array(found).reshape(degree, rows).T
                if not (solver.stats()["success"] and np.all(np.isfinite(part))):
                    return None
                parts.append(part)
                begin = part[:, -1]
            return np.hstack(parts)

        return march

    def worst_places(self, margins: Callable[[Vector], Vector], fine: int) -> tuple[Vector, float]:
        """Where in each interval each margin is least, and the least of all; `margins(at)` takes places as `margins_between`."""
        grid = np.linspace(0.0, 1.0, fine)
        sampled = np.array([margins(np.full((self.margins.size1_out(0), len(self.widths)), xi)) for xi in grid])
        best = sampled.argmin(axis=0)
        # The parabola through the least and its neighbours.
        at = grid[best]
        inner = np.clip(best, 1, fine - 2)
        y0, y1, y2 = (np.take_along_axis(sampled, (inner + k)[None], axis=0)[0] for k in (-1, 0, 1))
        bend = y0 - 2.0 * y1 + y2
        moved = grid[inner] + 0.5 * (y0 - y2) / np.where(bend > 0.0, bend, 1.0) * (grid[1] - grid[0])
        at = np.where((bend > 0.0) & (best == inner), moved, at)
        return np.clip(at, 0.0, 1.0), float(min(sampled.min(), margins(at).min()))
