"""What solve_ivp gives back, as SciPy has it."""

from __future__ import annotations

import numpy as np


class OdeResult(dict):
    """The members of a solution, as attributes and as keys:

    t, y: times and the solution there.  # (n_times), (n, n_times)
    sol: with `dense_output` an OdeSolution, else None.
    t_events, y_events: of each event the times, and the solution there; None without events.
    nfev, njev, nlu: how often the law and its derivatives were computed.
    status: 0 the end was reached, 1 an event ended it, -1 the numbers failed. message: in words. success: status >= 0.
    """

    def __getattr__(self, name):
        try:
            return self[name]
        except KeyError as error:
            raise AttributeError(name) from error

    __setattr__ = dict.__setitem__
    __delattr__ = dict.__delitem__

    def __dir__(self):
        return list(self)

    def __repr__(self):
        width = max(map(len, self), default=0)
        return "\n".join(f"{key:>{width}}: {value!r}" for key, value in self.items())


class OdeSolution:
    """The solution as a function of time: `sol(t)` has the shape (n,), for an array of times (n, times).

    ts: the ends of the steps. ValueError for times outside t_min … t_max: nothing is known there.
    """

    def __init__(self, ts, evaluate):
        self.ts = np.asarray(ts, dtype=float)
        self.t_min, self.t_max = float(min(self.ts)), float(max(self.ts))
        self._evaluate = evaluate

    def __call__(self, t):
        times = np.asarray(t, dtype=float)
        if times.ndim > 1:
            raise ValueError("`t` must be a float or a 1-D array.")
        outside = ~((times >= self.t_min) & (times <= self.t_max))
        if np.any(outside):
            raise ValueError(f"t = {np.atleast_1d(times)[np.atleast_1d(outside)][0]} lies outside the solution, which is known "
                             f"from {self.t_min} to {self.t_max}")
        values = self._evaluate(np.atleast_1d(times))
        return values[:, 0] if times.ndim == 0 else values


class Pieces:
    """Polynomials one behind the other, each in its own step."""

    def __init__(self, t0):
        self.ends = [float(t0)]
        self._begins, self._coefficients = [], []

    def append(self, t1, begin, coefficients):
        """The step to t1; `coefficients` of the powers of t - begin.  # (n, degree + 1)"""
        self.ends.append(float(t1))
        self._begins.append(begin)
        self._coefficients.append(coefficients)

    def last(self, times):
        """The last step at times on it."""
        return _polynomial(self._coefficients[-1], times - self._begins[-1])

    def __call__(self, times):
        """The solution at times within.  # (n, times)"""
        ends = np.array(self.ends)
        order = 1.0 if ends[-1] >= ends[0] else -1.0
        at = np.clip(np.searchsorted(order * ends, order * times, side="left") - 1, 0, len(self._begins) - 1)
        values = np.empty((len(self._coefficients[0]), len(times)))
        for i in np.unique(at):
            values[:, at == i] = _polynomial(self._coefficients[i], times[at == i] - self._begins[i])
        return values


def _polynomial(coefficients, tau):
    values = np.repeat(coefficients[:, -1:], len(tau), axis=1)
    for k in range(coefficients.shape[1] - 2, -1, -1):
        values = values * tau + coefficients[:, k : k + 1]
    return values
