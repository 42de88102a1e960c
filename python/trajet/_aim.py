"""Values of parameters with which a body hits a target."""

from __future__ import annotations

import json

from . import _core
from ._scene import Source, formula
from ._sweep import ranges


class Aim:
    """What aiming has come to: docs/formats/aim.md."""

    def __init__(self, report):
        self._report = report

    def report(self):
        """The JSON report as a dict."""
        return self._report

    @property
    def status(self):
        """`found`, `unreachable` or `not_converged`."""
        return self._report["status"]

    @property
    def ok(self):
        """Whether a solution was found."""
        return self.status == "found"

    @property
    def solutions(self):
        """A dict each: `parameters` (SI, by name), `time`, `point`, `miss`, `bounces`."""
        return self._report["solutions"]

    @property
    def closest(self):
        """The motion that comes nearest to the target: `parameters`, `miss`, `time`; None where none could be computed."""
        return self._report["closest"]


def aim(scene, vary, hit=None, *, at=None, body="", conditions=(), minimise="", set=None, **options):
    """Finds all values in the ranges with which a body hits a target.

    vary: {name: (low, high)}, numbers (SI) or texts. hit: the name of an obstacle, whose centre is meant; or at: a point,
    m. body: which one, where the scene has several. conditions: "speed > 20", judged at the hit. minimise: an
    expression; of all solutions only the one where it is least. set and further options: as of `run`.

    Raises SceneError where the scene or the task is wrong.
    """
    if (hit is None) == (at is None):
        raise TypeError("aim() takes a target: either hit or at")
    source = Source(scene).change(set, **options)
    point = "" if at is None else ",".join(formula(each) for each in at)
    wanted = [conditions] if isinstance(conditions, str) else list(conditions)
    task = (ranges(vary), hit or "", point, body, wanted, minimise)
    return Aim(json.loads(source.checked(lambda: _core.aim(source.scene, *task))))
