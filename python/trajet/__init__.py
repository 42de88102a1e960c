"""trajet: the motion of particles and rigid solids, with the exact time and place of every impact.

`run` computes the motion of a scene, `sweep` many, `aim` finds what hits a target, `solve_ivp` solves any system of ordinary differential equations. docs/python.md
"""

from ._aim import Aim, aim
from ._compare import Comparison, compare
from ._core import version as __version__
from ._errors import SceneError
from ._methods import Method, methods
from ._motion import Motion, check, run
from ._solve_ivp import Event, OdeResult, OdeSolution, solve_ivp
from ._sweep import Sweep, sweep
from ._tables import columns
from ._view import Page, view

__all__ = [
    "Aim",
    "Comparison",
    "Event",
    "Method",
    "Motion",
    "OdeResult",
    "OdeSolution",
    "Page",
    "SceneError",
    "Sweep",
    "aim",
    "check",
    "columns",
    "compare",
    "methods",
    "run",
    "solve_ivp",
    "sweep",
    "view",
]
