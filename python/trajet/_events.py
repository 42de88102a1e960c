"""Events of solve_ivp, as SciPy has them."""

from __future__ import annotations

import dataclasses
import math

import numpy as np

from ._roots import ZeroWatch


@dataclasses.dataclass
class Event:
    """An event given by a formula: the solution crosses or touches its zero.

    terminal: True ends the solution there, a number at so many of them. direction: 1 rising, -1 falling, 0 any, touches
    too.
    """

    when: str
    terminal: object = False
    direction: float = 0.0


@dataclasses.dataclass
class Watched:
    """An event of whichever kind, and what was found of it."""

    index: int
    when: object  # a formula, or a function of t and y
    limit: float  # so many of them end the solution
    direction: float
    times: list = dataclasses.field(default_factory=list)

    @property
    def is_formula(self):
        return isinstance(self.when, str)

    def wants(self, direction):
        return self.direction == 0 or (direction != 0 and (direction > 0) == (self.direction > 0))


def watched_events(events, args):
    """The events of a call; functions get the arguments of the law."""
    if events is None:
        return []
    if callable(events) or isinstance(events, (str, Event)):
        events = (events,)
    return [_watched(i, event, args) for i, event in enumerate(events)]


def _watched(index, event, args):
    terminal = getattr(event, "terminal", False)
    limit = math.inf if terminal is None or terminal is False else 1 if terminal is True else terminal
    if not (limit == math.inf or (float(limit).is_integer() and limit > 0)):
        raise ValueError("The `terminal` attribute of each event must be a boolean or positive integer.")
    when = event if isinstance(event, str) else event.when if isinstance(event, Event) else event
    if not isinstance(when, str) and not callable(when):
        raise TypeError(f"an event is a function of t and y, a formula or an Event, got {event!r}")
    function = when
    if callable(when) and args:
        function = lambda t, y: when(t, y, *args)
    return Watched(index, function, limit, getattr(event, "direction", 0.0) or 0.0)


def touch_size(rtol, atol):
    """How small an extremum counts as a touch, of the largest value: what the tolerances leave open."""
    return 10.0 * (rtol + float(np.max(atol))) + 1e-13


class FunctionWatch:
    """Looks for the events that functions of t and y say, step by step."""

    def __init__(self, watched, touch):
        self._watched = [each for each in watched if not each.is_formula]
        self._searches = [ZeroWatch(touch) for _ in self._watched]

    def search(self, a, b, y_at):
        """Of the step from a to b, on which `y_at(times)` is the solution.  # (n, times)"""
        for event, search in zip(self._watched, self._searches):

            def g(times, event=event):
                states = y_at(times)
                return np.array([float(np.squeeze(event.when(t, y))) for t, y in zip(times, states.T)])

            event.times += [t for t, direction in search.search(g, a, b) if event.wants(direction)]

    def end(self):
        """The solution has come to its end."""
        for event, search in zip(self._watched, self._searches):
            event.times += [t for t, direction in search.end() if event.wants(direction)]


def first_end(watched, forward):
    """When the first event ends the solution; None if none does."""
    order = 1.0 if forward else -1.0
    ends = [order * sorted(each.times, key=lambda t: order * t)[int(each.limit) - 1]
            for each in watched if each.limit <= len(each.times)]
    return order * min(ends) if ends else None
