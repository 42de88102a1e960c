"""solve_ivp: any system of ordinary differential equations, with SciPy's signature and result."""

from __future__ import annotations

import warnings

import numpy as np

from . import _core
from ._events import Event, FunctionWatch, first_end, touch_size, watched_events
from ._formulas import FormulaSolver
from ._ode_result import OdeResult, OdeSolution, Pieces

__all__ = ["Event", "OdeResult", "OdeSolution", "solve_ivp"]

FUNCTION_METHOD = "dop853"  # the most accurate for its cost that needs values alone
FUNCTION_RTOL = FUNCTION_ATOL = 1e-10
MAX_STEPS = 1_000_000
FINISHED = "The solver successfully reached the end of the integration interval."
ENDED = "A termination event occurred."
# SciPy's options of its own methods that have no meaning here
FOREIGN = ("jac", "jac_sparsity", "lband", "uband", "min_step")


def solve_ivp(
    fun,
    t_span,
    y0,
    method=None,
    t_eval=None,
    dense_output=False,
    events=None,
    vectorized=False,
    args=None,
    *,
    rtol=None,
    atol=None,
    first_step=None,
    max_step=np.inf,
    **options,
):
    """Solves dy/dt = fun(t, y), y(t0) = y0, with the signature and result of SciPy's function of that name.

    fun: a function of t and y that gives dy/dt, or formulas: a list of texts over t, y0, y1, …, or a dict with the rate of each
    quantity by its name, {"x": "v", "v": "-x"}. Formulas are fast and have exact derivatives; `args` is then a dict of
    parameters.
    t_span: (t0, t1), also backward. y0: the start; complex for functions.
    method: a name of `trajet methods` or SciPy's; default `taylor` for formulas, `dop853` for functions.
    t_eval: times at which to give the solution; default: the ends of the steps.
    events: functions of t and y, formulas, or Events; a function's attributes `terminal` (True or a number) and `direction` count as in
    SciPy. Two crossings in one step are two, a touch is an event of direction 0, a start on zero is none.
    rtol, atol: default 1e-12 for formulas, 1e-10 for functions. first_step: of fixed-step methods the step.

    Gives an OdeResult. Raises SceneError where a formula is wrong, ValueError for what does not go together; numbers that fail are
    status -1.
    """
    for name in options:
        if name not in FOREIGN:
            raise TypeError(f"solve_ivp() got an unexpected keyword argument '{name}'")
        warnings.warn(f"solve_ivp: `{name}` has no meaning for trajet's methods", stacklevel=2)
    t0, t1 = map(float, t_span)
    method = getattr(method, "__name__", method)  # of SciPy's classes
    settings = {"rtol": rtol, "atol": atol, "first_step": first_step, "max_step": max_step}
    if callable(fun):
        solver = _solve_function(fun, (t0, t1), y0, method, events, vectorized, args, settings)
    else:
        solver = _solve_formulas(fun, (t0, t1), y0, method, events, args, settings)
    return _result(solver, t_eval, dense_output, (t0, t1), events is not None)


class Solution:
    """A solution that is there: what `OdeResult` is made of."""

    def __init__(self, ts, evaluate, watched, nfev, failure):
        self.ts, self.evaluate, self.watched, self.nfev, self.failure = ts, evaluate, watched, nfev, failure


def _solve_function(fun, t_span, y0, method, events, vectorized, args, settings):
    t0, t1 = t_span
    start = np.atleast_1d(np.asarray(y0))
    if start.ndim != 1:
        raise ValueError("`y0` must be 1-dimensional.")
    if args is not None and not isinstance(args, (tuple, list)):
        raise TypeError("`args` is a tuple of further arguments of `fun`; for one, write args=(value,)")
    args = tuple(args or ())
    law = (lambda t, y: fun(t, y, *args)) if args else fun
    if vectorized:
        single = law
        law = lambda t, y: np.ravel(single(t, y[:, None]))
    watched = watched_events(events, args)
    for each in watched:
        if each.is_formula:
            raise TypeError("an event of a function is a function of t and y, not a formula")
    is_complex = np.iscomplexobj(start)
    if is_complex:
        real_law = law
        law = lambda t, y: _reals(np.asarray(real_law(t, _complex(y)), dtype=complex))
        for each in watched:
            each.when = lambda t, y, when=each.when: np.real(when(t, _complex(y)))
        start = _reals(start)
    start = start.astype(float)
    rtol = FUNCTION_RTOL if settings["rtol"] is None else settings["rtol"]
    atol = np.atleast_1d(np.asarray(FUNCTION_ATOL if settings["atol"] is None else settings["atol"], dtype=float))
    if atol.size > 1 and is_complex:
        atol = np.concatenate([atol, atol])
    if atol.size not in (1, start.size):
        raise ValueError("`atol` has wrong shape.")
    integrator = _core.Integrator(
        law, start.tolist(), t0, method or FUNCTION_METHOD, float(rtol), atol.tolist(), settings["first_step"],
        float(settings["max_step"]),
    )
    pieces = Pieces(t0)
    watch = FunctionWatch(watched, touch_size(rtol, atol))
    failure = ""
    for _ in range(MAX_STEPS):
        if integrator.t == t1 or first_end(watched, t1 >= t0) is not None:
            break
        failure = integrator.advance(t1)
        if failure:
            break
        pieces.append(integrator.t, *integrator.segment())
        watch.search(pieces.ends[-2], pieces.ends[-1], pieces.last)
    else:
        failure = f"{MAX_STEPS} steps were not enough."
    if integrator.t == t1:
        watch.end()
    evaluate = pieces if len(pieces.ends) > 1 else lambda times: np.repeat(start[:, None], len(times), axis=1)
    if is_complex:
        reals = evaluate
        evaluate = lambda times: _complex(reals(times))
    return Solution(pieces.ends, evaluate, watched, integrator.nfev, failure)


def _solve_formulas(fun, t_span, y0, method, events, args, settings):
    watched = watched_events(events, ())
    solver = FormulaSolver(fun, t_span, y0, method, watched, args, settings)
    touch = touch_size(*(settings[key] if settings[key] is not None else 1e-12 for key in ("rtol", "atol")))
    solver.find_touches(touch)
    watch = FunctionWatch(watched, touch)
    for a, b in zip(solver.ts, solver.ts[1:]):
        watch.search(a, b, solver.evaluate)
        if first_end([each for each in watched if not each.is_formula], t_span[1] >= t_span[0]) is not None:
            break
    else:
        if solver.ts[-1] == t_span[1]:
            watch.end()
    return Solution(solver.ts, solver.evaluate, watched, solver.nfev, solver.failure)


def _result(solution, t_eval, dense_output, t_span, has_events):
    forward = t_span[1] >= t_span[0]
    order = 1.0 if forward else -1.0
    end = first_end(solution.watched, forward)
    ts = np.asarray(solution.ts)
    if end is not None:
        ts = np.append(ts[order * ts < order * end], end)
        for each in solution.watched:
            each.times = [t for t in each.times if order * t <= order * end]
    for each in solution.watched:
        each.times.sort(key=lambda t: order * t)
    times = ts
    if t_eval is not None:
        times = np.asarray(t_eval, dtype=float)
        if times.ndim != 1:
            raise ValueError("`t_eval` must be 1-dimensional.")
        if np.any(times < min(t_span)) or np.any(times > max(t_span)):
            raise ValueError("Values in `t_eval` are not within `t_span`.")
        if np.any(order * np.diff(times) <= 0):
            raise ValueError("Values in `t_eval` are not properly sorted.")
        times = times[order * times <= order * ts[-1]]
    status = 1 if end is not None else -1 if solution.failure else 0
    dimension = solution.evaluate(np.array([ts[0]]))
    at = lambda t: solution.evaluate(np.asarray(t, dtype=float)) if len(t) else dimension[:, :0]
    return OdeResult(
        t=times,
        y=at(times),
        sol=OdeSolution(ts, solution.evaluate) if dense_output else None,
        t_events=[np.array(each.times) for each in solution.watched] if has_events else None,
        y_events=[at(each.times).T for each in solution.watched] if has_events else None,
        nfev=solution.nfev,
        njev=0,
        nlu=0,
        status=status,
        message=(FINISHED, ENDED, solution.failure)[status],
        success=status >= 0,
    )


def _reals(y):
    return np.concatenate([y.real, y.imag])


def _complex(y):
    half = len(y) // 2
    return y[:half] + 1j * y[half:]
