"""The motion that a run gives."""

from __future__ import annotations

import functools
import json

import numpy as np

from . import _core
from ._scene import Source
from ._tables import table


class Motion:
    """The motion of a scene as a function of time: what a run has found, and where everything was in between.

    World frame, SI units. Times are those of the scene's clock, from `start_time` to `end_time`, single or arrays in any
    order and shape; others raise ValueError, as do names that the scene does not have. Where the motion jumps, at an impact or an
    event that sets something, the answer is that behind the jump; `impacts` have both sides.
    """

    def __init__(self, core, source):
        self._core = core
        self._source = source

    @property
    def status(self):
        """`finished`, `stopped` (by an obstacle or an event), `failed` (the numbers: see `failure`) or `interrupted`."""
        return self._core.status

    @property
    def ok(self):
        """Whether the run has come to its end or to what was to stop it."""
        return self._core.ok

    @property
    def failure(self):
        """Where and why the numbers failed; empty if they did not."""
        return self._core.failure

    @property
    def title(self):
        """The scene's title."""
        return self._core.title

    @property
    def method(self):
        """The method's canonical name."""
        return self._core.method

    @property
    def start_time(self):
        """s, of the scene's clock."""
        return self._core.start_time

    @property
    def end_time(self):
        """s, of the scene's clock: where the run ended."""
        return self._core.end_time

    @property
    def bodies(self):
        """The names of the bodies, in the order of the scene."""
        return self._core.bodies

    @property
    def parameters(self):
        """The parameters with their numbers, SI."""
        return self._core.parameters

    @property
    def states(self):
        """The extra states at the end, by name."""
        return self._core.states

    @property
    def warnings(self):
        """Sentences on what a user should know."""
        return self._core.warnings

    @property
    def statistics(self):
        """What the run has cost: `steps`, `law_evaluations`, `wall_seconds`, …"""
        return self._core.statistics

    @functools.cached_property
    def impacts(self):
        """All impacts in the order of time, a structured array with the keys of the JSON report as fields.

        Vectors are (3,) each. `with_velocity_before` and its like are not-a-number where no body was met; `features` is what
        touched of both, such as "vertex face", or empty.
        """
        return table(self._core.impact_columns())

    @functools.cached_property
    def events(self):
        """All events, a structured array: `time`, `event`, `direction`, `law`."""
        return table(self._core.event_columns())

    @functools.cached_property
    def contacts(self):
        """The lasting contacts, a structured array: `from`, `to` (not-a-number: it lasts), `body`, `with`, `mode`."""
        return table(self._core.contact_columns())

    @functools.cached_property
    def final(self):
        """All bodies at the end, a structured array with the keys of the JSON report as fields."""
        return _bodies(self._core.final_columns())

    def state(self, t):
        """All bodies at a time, as `final`. Accelerations are the derivatives of the run's polynomials."""
        return _bodies(self._core.state_columns(t))

    def position(self, body, t):
        """Of the centre of mass, m.  # (3,), or t.shape + (3,)"""
        return _at(self._core.position, body, t)

    def velocity(self, body, t):
        """Of the centre of mass, m/s.  # (3,), or t.shape + (3,)"""
        return _at(self._core.velocity, body, t)

    def orientation(self, body, t):
        """The unit quaternion (w, x, y, z) that turns body coordinates into the world's.  # (4,), or t.shape + (4,)"""
        return _at(self._core.orientation, body, t)

    def angular_velocity(self, body, t):
        """In the world's frame, rad/s; 0 of what does not turn.  # (3,), or t.shape + (3,)"""
        return _at(self._core.angular_velocity, body, t)

    def value(self, state, t):
        """An extra state, in its unit.  # a number, or t.shape"""
        return _at(self._core.value, state, t)

    def report(self):
        """The JSON report as a dict: docs/formats/report.md."""
        return json.loads(self._core.report())

    def __repr__(self):
        return self._core.text().rstrip()


def _bodies(columns):
    columns["rotation_matrix"] = columns["rotation_matrix"].reshape(-1, 3, 3)
    return table(columns)


def _at(question, name, t):
    times = np.asarray(t, dtype=float)
    answer = question(name, times.reshape(-1))
    answer = answer.reshape(times.shape + answer.shape[1:])
    return answer if answer.ndim else answer[()]


def run(scene, set=None, *, method=None, step=None, rtol=None, atol=None, end=None, orientation=None):
    """Computes the motion of a scene.

    scene: the path of a scene file, the text of one, or a dict with its keys.
    set: replaces parameters and keys, {"theta": "0.1 deg", "ball.velocity": [1, 0, 0], "ground.restitution": 0.5}.
    method, step, rtol, atol, end, orientation: instead of the scene's, as the options of the program: numbers in SI or texts
    with a unit.

    Raises SceneError where the scene is wrong. Numbers that fail raise nothing: `status` says so, and what was computed
    until then is there. Ctrl-C raises KeyboardInterrupt; other threads run meanwhile.
    """
    source = Source(scene)
    source.change(set, method=method, step=step, rtol=rtol, atol=atol, end=end, orientation=orientation)
    return Motion(source.checked(lambda: _core.compute_motion(source.scene)), source)


def check(scene, set=None, **options):
    """Checks a scene completely without running it; the warnings. Raises SceneError where it is wrong.

    Takes what `run` takes.
    """
    source = Source(scene).change(set, **options)
    return source.checked(lambda: _core.check(source.scene))
