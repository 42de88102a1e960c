"""Zeros of functions that are known by their values alone."""

from __future__ import annotations

import functools

import numpy as np
from numpy.polynomial import chebyshev

DEGREES = (8, 16, 32)  # of the polynomials that stand for a function on a piece
CONVERGED = 1e-11  # their last coefficients, of the largest value
DEEPEST = 6  # a piece is halved so often at most where none of them does
MOST_HALVINGS = 200
ROUNDING = np.finfo(float).eps


@functools.lru_cache(maxsize=None)
def _interpolation(degree):
    """Points on [-1, 1] with the matrix that makes Chebyshev coefficients of values there."""
    points = np.cos(np.pi * np.arange(degree, -1, -1) / degree)
    return points, np.linalg.inv(chebyshev.chebvander(points, degree))


class ZeroWatch:
    """Finds where a function of time crosses zero or touches it, piece by piece, in the order of time.

    On each piece the function is replaced by a polynomial through many of its values, between whose extrema it is monotonous: so
    several zeros on a piece are several, and a touch is seen. The zeros themselves are polished on the function. What
    changes faster than the polynomials can tell is not seen.

    `touch`: values as small at an extremum, of the largest on the piece, count as zero there.
    """

    def __init__(self, touch):
        self._touch = touch
        self._sign = 0.0  # of the last value that was not zero
        self._last = None  # when that was
        self._zero = None  # when it came to zero since

    def search(self, g, a, b):
        """The zeros from a to b: [(time, direction)], direction 0 for a touch. `g(times)` gives an array."""
        found = []
        for t, value in self._monotonous(g, a, b, DEEPEST):
            sign = np.sign(value)
            if sign == 0.0:
                if self._zero is None and self._sign != 0.0:
                    self._zero = t
                continue
            if self._sign != 0.0 and sign != self._sign:
                found.append((t if self._zero is None else self._zero, sign, self._last, t, self._zero))
            elif self._zero is not None:
                found.append((self._zero, 0.0, None, None, self._zero))
            self._sign, self._last, self._zero = sign, t, None
        return [(_polished(g, each[2], each[3]) if each[4] is None else each[0], each[1]) for each in found]

    def end(self):
        """The zero on which the motion ends, if it does: [(time, direction)]."""
        return [(self._zero, -self._sign)] if self._zero is not None else []

    def _monotonous(self, g, a, b, depth):
        """(time, value) at the ends of stretches on which g is monotonous; small extrema are zeros."""
        for degree in DEGREES:
            points, to_coefficients = _interpolation(degree)
            times = 0.5 * (a + b) + 0.5 * (b - a) * points
            times[0], times[-1] = a, b
            values = g(times)
            scale = np.max(np.abs(values))
            coefficients = to_coefficients @ values
            if np.max(np.abs(coefficients[-2:])) <= CONVERGED * scale:
                break
        else:
            if depth > 0:
                middle = 0.5 * (a + b)
                yield from self._monotonous(g, a, middle, depth - 1)
                yield from self._monotonous(g, middle, b, depth - 1)
                return
        extrema = np.array([])
        if abs(coefficients[0]) <= np.sum(np.abs(coefficients[1:])) + CONVERGED * scale:  # else there is no zero
            slope = chebyshev.chebder(coefficients)
            slope = np.trim_zeros(np.where(np.abs(slope) > ROUNDING * scale, slope, 0.0), "b")
            if len(slope) > 1:
                roots = chebyshev.chebroots(slope)
                real = np.sort(roots.real[np.abs(roots.imag) < 1e-4])
                extrema = 0.5 * (a + b) + 0.5 * (b - a) * real[np.abs(real) < 1.0]
        yield a, values[0]
        if len(extrema):
            for t, value in zip(extrema, g(extrema)):
                yield t, 0.0 if abs(value) <= self._touch * scale else value
        yield b, values[-1]


def _polished(g, a, b):
    """The zero of g between a and b, where it has opposite signs; by regula falsi with halvings (Illinois)."""
    ga, gb = g(np.array([a, b]))
    if ga == 0.0 or gb == 0.0:
        return a if ga == 0.0 else b
    side = 0
    for i in range(MOST_HALVINGS):
        t = b - gb * (b - a) / (gb - ga) if i % 4 < 3 else 0.5 * (a + b)
        if not min(a, b) < t < max(a, b):
            t = 0.5 * (a + b)
        if abs(b - a) <= 2.0 * ROUNDING * max(abs(a), abs(b)) or t in (a, b):
            return t
        value = g(np.array([t]))[0]
        if value == 0.0:
            return t
        if np.sign(value) == np.sign(gb):
            b, gb = t, value
            ga = 0.5 * ga if side == 1 else ga
            side = 1
        else:
            a, ga = t, value
            gb = 0.5 * gb if side == -1 else gb
            side = -1
    return t
