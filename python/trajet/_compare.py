"""Methods compared."""

from __future__ import annotations

import functools
import json

import numpy as np

from . import _core
from ._scene import Source
from ._tables import table


class Comparison:
    """How far methods are from a reference, and what they cost."""

    def __init__(self, report):
        self._report = report

    def report(self):
        """The JSON report as a dict: docs/formats/compare.md."""
        return self._report

    @property
    def reference(self):
        """What the rows are compared with: `name`, `rtol`, `atol`, `step`."""
        return self._report["reference"]

    @property
    def warnings(self):
        """Sentences on what a user should know."""
        return self._report["warnings"]

    @functools.cached_property
    def rows(self):
        """One record for each method with each step or tolerance, the keys of the JSON report as fields.

        What is not known is not-a-number, or an empty text.
        """
        rows = self._report["rows"]
        columns = {}
        for key in rows[0] if rows else ():
            values = [row[key] for row in rows]
            if any(isinstance(value, str) for value in values) or key in ("failure", "orientation"):
                columns[key] = [value or "" for value in values]
            else:
                columns[key] = np.array([np.nan if value is None else value for value in values])
        return table(columns)


def compare(scene, methods=(), *, steps=(), rtols=(), orientations=(), reference="", set=None, **options):
    """Runs a scene by several methods and measures each against a reference.

    methods: names, or one; default: all. steps: numbers of steps over the run, for methods of given step.
    rtols: for error-controlled methods. orientations: ways of carrying them, each with every method.
    reference: `exact` (the scene's closed forms) or a method. set and further options: as of `run`.

    Raises SceneError where the scene or the plan is wrong. What fails for one method alone is told in its row.
    """
    source = Source(scene).change(set, **options)
    several = lambda names: [names] if isinstance(names, str) else list(names)
    plan = (several(methods), list(steps), list(rtols), several(orientations), reference)
    return Comparison(json.loads(source.checked(lambda: _core.compare(source.scene, *plan))))
