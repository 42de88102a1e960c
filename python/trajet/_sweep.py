"""Many motions of one scene."""

from __future__ import annotations

import functools

import numpy as np

from . import _core
from ._scene import Source, formula
from ._tables import table


class Sweep:
    """The rows of a sweep, in the order of the plan."""

    def __init__(self, result, names):
        self._columns = result["columns"]
        self._failures = result["failures"]
        self._names = names
        self.warnings = result["warnings"]

    def __len__(self):
        return len(self._failures)

    def __getitem__(self, name):
        """A column: a varied quantity or a reported expression, as it was written. Numbers are SI, not-a-number where
        the motion has none; words are texts, empty where it has none."""
        values = self._columns[name]
        return np.array(values, dtype=str) if isinstance(values, list) else values

    @property
    def quantities(self):
        """The names of what varies."""
        return list(self._names)

    @property
    def columns(self):
        """The names of all columns, what varies first."""
        return list(self._columns)

    @functools.cached_property
    def rows(self):
        """One record for each motion, the columns as fields."""
        return table(self._columns)

    @property
    def failures(self):
        """By its number, why a motion failed; motions that did not are left out."""
        return {index: failure for index, failure in enumerate(self._failures) if failure}


def ranges(vary):
    """{"theta": ("1 deg", "89 deg", 90)} or "theta=1deg:89deg:90" as the command line takes it."""
    if isinstance(vary, str):
        return [vary]
    if isinstance(vary, dict):
        return [f"{name}=" + ":".join(formula(end) for end in ends) for name, ends in vary.items()]
    return list(vary or [])


def samples(sample):
    """{"v0": "normal(500 m/s, 3 m/s)"} or "v0=normal(…)" likewise."""
    if isinstance(sample, str):
        return [sample]
    if isinstance(sample, dict):
        return [f"{name}={distribution}" for name, distribution in sample.items()]
    return list(sample or [])


def sweep(
    scene,
    vary=None,
    sample=None,
    *,
    report=(),
    count=None,
    seed=0,
    design="random",
    correlate=None,
    threads=0,
    set=None,
    **options,
):
    """Computes a motion for each point of a grid, or for many random ones: docs/formats/sweep.md.

    vary: {name: (low, high, count)}, a grid. sample: {name: "normal(mean, sd)"}, random values, `count` of them
    (default 1000) by `design` (random, lhs, sobol) and `seed`; correlate: {(name, name): coefficient}.
    Numbers are SI; texts are quantities, "3 m/s". report: expressions, "impact(1).t", "max(ball.z)", "hit"; default: the
    end. threads: 0 for as many as the machine has; the rows do not depend on it. set and further options: as of `run`.

    Raises SceneError where scene, plan or report are wrong. A motion that fails has no numbers: see `failures`.
    """
    source = Source(scene).change(set, **options)
    plan = _core.SweepPlan()
    plan.vary = ranges(vary)
    plan.sample = samples(sample)
    plan.correlate = [f"{','.join(pair)}={value!r}" for pair, value in (correlate or {}).items()]
    plan.count = count
    plan.seed = seed
    plan.design = design
    names = [text.split("=")[0].strip() for text in plan.vary + plan.sample]
    columns = [report] if isinstance(report, str) else list(report)
    return Sweep(source.checked(lambda: _core.sweep(source.scene, plan, columns, threads)), names)
