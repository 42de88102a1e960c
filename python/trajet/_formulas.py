"""Systems of differential equations by formulas: scenes of extra states alone."""

from __future__ import annotations

import math
import re

import numpy as np

from . import _core
from ._document import Document
from ._errors import SceneError
from ._roots import ZeroWatch

DIRECTIONS = {1: "rising", -1: "falling", 0: "any"}
NAME = re.compile(r"[A-Za-z_]\w*")


class FormulaSolver:
    """Solves dy/dt = formulas as a run does, with every crossing of the events by formulas."""

    def __init__(self, fun, t_span, y0, method, watched, args, settings):
        self._names, rates, start = _equations(fun, y0)
        self._watched = [each for each in watched if each.is_formula]
        document = Document(self._scene(rates, start, t_span, method, args, settings))
        try:
            scene = _core.parse_scene(document.text, "")
            limits = [(_name(each), int(each.limit)) for each in self._watched if 1 < each.limit < math.inf]
            self._motion = _core.compute_motion(scene, limits)
        except SceneError as error:
            raise _as_argument(error, document, fun) from None
        self._forward = t_span[1] >= t_span[0]
        for event in self._motion_events():
            event[0].times.append(event[1])
        self.ts = self._step_ends(float(t_span[0]))
        self.nfev = self._motion.statistics["law_evaluations"]
        self.failure = self._motion.failure

    def evaluate(self, times):
        """The solution at times within.  # (n, times)"""
        return np.array([self._motion.value(name, times) for name in self._names])

    def find_touches(self, touch):
        """What the run does not count: where an event's formula comes to zero and goes back."""
        for i, each in enumerate(self._watched):
            if each.direction != 0:
                continue
            watch = ZeroWatch(touch)
            values = lambda times, i=i: self._motion.event_values(i, times)
            for a, b in zip(self.ts, self.ts[1:]):
                each.times += [t for t, direction in watch.search(values, a, b) if direction == 0]

    def _scene(self, rates, start, t_span, method, args, settings):
        if args is not None and not isinstance(args, dict):
            raise TypeError("`args` of formulas is a dict of parameters: {'a': 1.5}")
        atol = settings["atol"]
        if atol is not None and np.size(atol) > 1:
            if np.size(np.unique(atol)) > 1:
                raise ValueError("one `atol` for all components of formulas expected")
            atol = float(np.ravel(atol)[0])
        options = {"name": method or "taylor", "rtol": settings["rtol"], "atol": atol, "step": settings["first_step"]}
        if np.isfinite(settings["max_step"]):
            options["max_step"] = float(settings["max_step"])
        return {
            "time": {"start": float(t_span[0]), "end": float(t_span[1])},
            "method": {key: value for key, value in options.items() if value is not None},
            "parameters": dict(args or {}),
            "state": [
                {"name": name, "value": value, "rate": rate} for name, value, rate in zip(self._names, start, rates)
            ],
            "event": [
                {
                    "name": _name(each),
                    "when": each.when,
                    "direction": DIRECTIONS[int(np.sign(each.direction))],
                    "action": "stop" if each.limit == 1 else "record",
                }
                for each in self._watched
            ],
        }

    def _motion_events(self):
        columns = self._motion.event_columns()
        by_name = {_name(each): each for each in self._watched}
        return [(by_name[name], t) for name, t in zip(columns["event"], columns["time"]) if name in by_name]

    def _step_ends(self, t0):
        ends = t0 + np.array(self._motion.joints())
        ends = np.unique(np.append(ends, [t0, self._motion.end_time]))
        # by rounding, what was elapsed can be behind the end
        ends = ends[(ends >= min(t0, self._motion.end_time)) & (ends <= max(t0, self._motion.end_time))]
        return ends if self._forward else ends[::-1]


def _equations(fun, y0):
    """Names, rates and starts."""
    if isinstance(fun, dict):
        names = list(fun)
        rates = list(fun.values())
        start = [y0[name] for name in names] if isinstance(y0, dict) else list(np.atleast_1d(y0))
    else:
        rates = [fun] if isinstance(fun, str) else list(fun)
        names = [f"y{i}" for i in range(len(rates))]
        start = list(np.atleast_1d(y0))
    for rate in rates:
        if not isinstance(rate, (str, int, float)):
            raise TypeError(f"`fun` is a function, a list of formulas or a dict of formulas by name; got {rate!r} in it")
    if len(start) != len(rates):
        raise ValueError(f"`fun` has {len(rates)} formulas and `y0` {len(start)} numbers")
    if any(isinstance(value, complex) or np.iscomplexobj(value) for value in start):
        raise ValueError("formulas have real numbers: write real and imaginary part")
    for name in names:
        if not NAME.fullmatch(name):
            raise ValueError(f"'{name}' is no name: letters, digits and _ expected")
    return names, rates, start


def _name(event):
    return f"event_{event.index}"


def _as_argument(error, document, fun):
    """The error of the scene as one of the argument that is wrong."""
    if error.line is None:
        return error
    path = document.path(error.line, error.column)
    state = re.match(r"state\[(\d+)\]\.(value|rate)", path)
    if state:
        index = int(state[1])
        owner = "y0" if state[2] == "value" else "fun"
        place = repr(list(fun)[index]) if isinstance(fun, dict) else index
        return SceneError(error.message, key=f"{owner}[{place}]")
    event = re.match(r"event\[(\d+)\]", path)
    if event:
        return SceneError(error.message, key=f"events[{event[1]}]")
    return SceneError(error.message, key={"parameters": "args", "time": "t_span"}.get(path.split(".")[0], path))
