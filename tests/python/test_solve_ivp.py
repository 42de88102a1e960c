"""solve_ivp: SciPy's examples, where SciPy misses, both kinds of laws against closed forms and each other."""

import numpy as np
import pytest
import trajet
from trajet import solve_ivp

TIGHT = 1e-9  # global errors at the default tolerances, 1e-10 and 1e-12 a step


# --- SciPy's documentation examples, unchanged but for the import


def exponential_decay(t, y):
    return -0.5 * y


def upward_cannon(t, y):
    return [y[1], -0.5]


def hit_ground(t, y):
    return y[0]


hit_ground.terminal = True
hit_ground.direction = -1


def apex(t, y):
    return y[1]


def test_scipy_exponential_decay():
    sol = solve_ivp(exponential_decay, [0, 10], [2, 4, 8])
    assert sol.t[0] == 0 and sol.t[-1] == 10 and sol.y.shape == (3, len(sol.t))
    assert np.abs(sol.y - np.outer([2, 4, 8], np.exp(-0.5 * sol.t))).max() < TIGHT
    assert sol.success and sol.status == 0 and sol.t_events is None and sol.sol is None
    assert sol.message == "The solver successfully reached the end of the integration interval."


def test_scipy_t_eval():
    sol = solve_ivp(exponential_decay, [0, 10], [2, 4, 8], t_eval=[0, 1, 2, 4, 10])
    assert sol.t.tolist() == [0, 1, 2, 4, 10]
    assert np.abs(sol.y - np.outer([2, 4, 8], np.exp(-0.5 * sol.t))).max() < TIGHT


def test_scipy_cannon():
    sol = solve_ivp(upward_cannon, [0, 100], [0, 10], events=hit_ground)
    assert len(sol.t_events) == 1 and sol.t_events[0] == pytest.approx([40], abs=1e-12)
    assert sol.t[-1] == sol.t_events[0][0] and sol.status == 1
    assert sol.message == "A termination event occurred."


def test_scipy_cannon_with_apex():
    sol = solve_ivp(upward_cannon, [0, 100], [0, 10], events=(hit_ground, apex), dense_output=True)
    assert [times.tolist() for times in sol.t_events] == [pytest.approx([40]), pytest.approx([20])]
    assert sol.sol(sol.t_events[1][0]) == pytest.approx([100, 0], abs=1e-11)
    assert sol.y_events[0] == pytest.approx(np.array([[0, -10]]), abs=1e-11)
    assert sol.y_events[1] == pytest.approx(np.array([[100, 0]]), abs=1e-11)


def test_scipy_lotka_volterra():
    def lotkavolterra(t, z, a, b, c, d):
        x, y = z
        return [a * x - b * x * y, -c * y + d * x * y]

    sol = solve_ivp(lotkavolterra, [0, 15], [10, 5], args=(1.5, 1, 3, 1), dense_output=True)
    t = np.linspace(0, 15, 300)
    z = sol.sol(t)
    assert z.shape == (2, 300)
    invariant = z[0] - 3 * np.log(z[0]) + z[1] - 1.5 * np.log(z[1])
    assert np.abs(invariant - invariant[0]).max() < 1e-7  # the error within steps of dop853 is of order 8 only


def test_scipy_complex_matrix():
    A = np.array([[-0.25 + 0.14j, 0, 0.33 + 0.44j], [0.25 + 0.58j, -0.2 + 0.14j, 0], [0, 0.2 + 0.4j, -0.1 + 0.97j]])

    def deriv_vec(t, y):
        return A @ y

    result = solve_ivp(deriv_vec, [0, 25], np.array([10 + 0j, 20 + 0j, 30 + 0j]), t_eval=np.linspace(0, 25, 101))
    assert result.y[:, 0].tolist() == [10, 20, 30]
    values, vectors = np.linalg.eig(A)
    exact = vectors @ np.diag(np.exp(25 * values)) @ np.linalg.solve(vectors, [10, 20, 30])
    assert np.abs(result.y[:, -1] - exact).max() < 1e-7

    def deriv_mat(t, y):
        return (A @ y.reshape(3, 3)).flatten()

    y0 = np.array([[2 + 0j, 3 + 0j, 4 + 0j], [5 + 0j, 6 + 0j, 7 + 0j], [9 + 0j, 34 + 0j, 78 + 0j]])
    result = solve_ivp(deriv_mat, [0, 25], y0.flatten(), t_eval=np.linspace(0, 25, 101))
    assert result.y[:, 0].reshape(3, 3).tolist() == y0.tolist()


# --- where SciPy misses; each for a function, and by formulas

LAWS = {
    "function": (lambda t, y: [np.cos(t)], lambda level: lambda t, y: y[0] - level),  # y = sin t
    "formula": (["cos(t)"], lambda level: f"y0 - {level!r}"),
}
both = pytest.mark.parametrize("law, event", LAWS.values(), ids=LAWS)


def with_attributes(event, **attributes):
    if isinstance(event, str):
        return trajet.Event(event, **attributes)
    for name, value in attributes.items():
        setattr(event, name, value)
    return event


@both
def test_two_crossings_in_one_step(law, event):
    level = 1 - 1e-9  # between them are 9e-5 s, a step is a second
    sol = solve_ivp(law, [0, 3], [0], events=event(level))
    exact = np.arcsin(level)
    assert sol.t_events[0] == pytest.approx([exact, np.pi - exact], abs=1e-5)


@both
def test_a_graze(law, event):
    sol = solve_ivp(law, [0, 3], [0], events=[event(1.0), with_attributes(event(1.0), direction=1)])
    assert sol.t_events[0] == pytest.approx([np.pi / 2], abs=1e-4)  # where y is 1 to within its error
    # what touches has crossed in no direction; rounding may make it two crossings, closer together than its error
    assert len(sol.t_events[1]) == 0 or sol.t_events[1] == pytest.approx([np.pi / 2], abs=1e-4)


@both
def test_a_near_miss_is_none(law, event):
    assert len(solve_ivp(law, [0, 3], [0], events=event(1 + 1e-6)).t_events[0]) == 0


@both
def test_a_root_at_the_start_does_not_hide_the_landing(law, event):
    landing = with_attributes(event(0.0), terminal=True, direction=-1)
    sol = solve_ivp(law, [0, 6], [0], events=landing)
    assert sol.t_events[0] == pytest.approx([np.pi], abs=1e-9)
    assert sol.status == 1


@both
def test_a_start_on_zero_is_no_event(law, event):
    sol = solve_ivp(law, [0, 6], [0], events=with_attributes(event(0.0), terminal=True))
    assert sol.t_events[0] == pytest.approx([np.pi], abs=1e-9)


def test_the_landing_within_the_first_step():
    """SciPy finds the root at the start instead: its bracket begins there."""
    sol = solve_ivp(upward_cannon, [0, 100], [0, 1e-3], events=hit_ground, rtol=1e-3, atol=1e-6)
    assert sol.t_events[0] == pytest.approx([4e-3], abs=1e-9)


@both
def test_all_of_many_crossings(law, event):
    sol = solve_ivp(law, [0, 100], [0], events=event(0.5))
    first = np.arcsin(0.5)
    exact = np.sort(np.concatenate([np.arange(0, 100, 2 * np.pi) + first, np.arange(0, 100, 2 * np.pi) + np.pi - first]))
    assert sol.t_events[0] == pytest.approx(exact[exact < 100], abs=1e-8)


@both
@pytest.mark.parametrize("direction, expected", [(1, [1, 13]), (-1, [5]), (0, [1, 5, 13])])
def test_direction(law, event, direction, expected):
    sol = solve_ivp(law, [0, 7], [0], events=with_attributes(event(0.5), direction=direction))
    assert 6 / np.pi * sol.t_events[0] == pytest.approx(expected, abs=1e-8)


@both
def test_terminal_by_number(law, event):
    sol = solve_ivp(law, [0, 30], [0], events=[with_attributes(event(0.5), terminal=3), event(0.0)])
    assert sol.status == 1 and len(sol.t_events[0]) == 3
    assert sol.t[-1] == sol.t_events[0][-1] == pytest.approx(2 * np.pi + np.pi / 6)
    # nothing behind the end
    assert sol.t_events[1] == pytest.approx([np.pi, 2 * np.pi], abs=1e-8)


@both
def test_nothing_behind_the_end(law, event):
    behind = 0.5 + 1e-6  # met in the same step
    sol = solve_ivp(law, [0, 30], [0], t_eval=[0, 0.5, 0.6], events=[with_attributes(event(0.5), terminal=True), event(behind)])
    assert len(sol.t_events[0]) == 1 and len(sol.t_events[1]) == 0
    assert sol.t.tolist() == [0, 0.5] and sol.y.shape == (1, 2)


def test_a_terminal_event_ends_the_work():
    sol = solve_ivp(["y1", "-y0"], [0, 1e5], [0, 1], events=trajet.Event("y1", terminal=True))
    assert sol.t[-1] == pytest.approx(np.pi / 2) and sol.nfev < 50


@pytest.mark.parametrize("direction, expected", [(0, [1]), (1, []), (-1, [])])
def test_an_exact_touch_has_no_direction(direction, expected):
    sol = solve_ivp(["2*(t - 1)"], [0, 3], [1], events=trajet.Event("y0", direction=direction))  # y = (t - 1)^2
    assert sol.t_events[0].tolist() == pytest.approx(expected)


def test_an_event_that_changes_faster_than_the_steps():
    sol = solve_ivp(lambda t, y: [0.0], [0, 10], [0.0], events=lambda t, y: np.sin(40 * t + 0.1))
    exact = (np.pi * np.arange(1, 200) - 0.1) / 40
    assert sol.t_events[0] == pytest.approx(exact[exact < 10], abs=1e-12)


@both
def test_backward(law, event):
    sol = solve_ivp(law, [6, 0], [np.sin(6)], events=with_attributes(event(0.5), terminal=2), dense_output=True)
    assert sol.t_events[0] == pytest.approx([5 * np.pi / 6, np.pi / 6], abs=1e-8)
    assert sol.t[0] == 6 and np.all(np.diff(sol.t) < 0)
    t = np.linspace(sol.t[-1], 6, 40)
    assert np.abs(sol.sol(t)[0] - np.sin(t)).max() < 1e-8


@pytest.mark.parametrize("events", [lambda t, y: y[0] - 0.5, "y0 - 0.5"])
def test_events_of_formulas_may_be_functions(events):
    sol = solve_ivp(["y1", "-y0"], [0, 10], [0, 1], events=events)
    assert sol.t_events[0] == pytest.approx([np.pi / 6, 5 * np.pi / 6, 13 * np.pi / 6, 17 * np.pi / 6], abs=1e-10)


# --- the rest of the interface


def test_formulas_by_name_with_parameters():
    names = solve_ivp({"x": "v", "v": "-w^2*x"}, [0, 5], {"x": 1, "v": 0}, args={"w": 2}, dense_output=True)
    t = np.linspace(0, 5, 100)
    assert np.abs(names.sol(t) - [np.cos(2 * t), -2 * np.sin(2 * t)]).max() < TIGHT
    numbers = solve_ivp(["y1", "-4*y0"], [0, 5], [1, 0], t_eval=t)
    assert np.abs(numbers.y - names.sol(t)).max() < TIGHT


def test_formulas_and_functions_agree_by_every_method_that_takes_both():
    for method in ("dopri5", "dop853", "bs32", "adams", "RK45", "DOP853", "rk4", "heun"):
        step = 0.01 if method in ("rk4", "heun") else None
        options = {"method": method, "rtol": 1e-8, "atol": 1e-8, "first_step": step}
        one = solve_ivp(lambda t, y: [y[1], -np.sin(y[0])], [0, 5], [1, 0], **options)
        other = solve_ivp(["y1", "-sin(y0)"], [0, 5], [1, 0], **options)
        assert abs(len(one.t) - len(other.t)) <= 1, method
        assert np.abs(one.y[:, -1] - other.y[:, -1]).max() < 1e-7, method


def test_several_independent_formulas_have_steps_of_their_own():
    sol = solve_ivp(["-y0", "-100*y1"], [0, 2], [1, 1], t_eval=[0, 0.01, 2])
    assert np.abs(sol.y - np.exp(np.outer([-1, -100], sol.t))).max() < TIGHT


@pytest.mark.parametrize("method", ["taylor", "rodas5p", "bdf", "gauss6", "series", "tr-bdf2"])
def test_methods_that_need_derivatives_say_so(method):
    with pytest.raises(ValueError, match="needs derivatives of `fun`"):
        solve_ivp(exponential_decay, [0, 1], [1.0], method=method, first_step=0.1)


def test_foreign_and_unknown_methods_say_what_is_near():
    with pytest.raises(ValueError, match="the nearest one is 'rodas5p'"):
        solve_ivp(exponential_decay, [0, 1], [1.0], method="Radau")
    with pytest.raises(ValueError, match="`first_step` is missing"):
        solve_ivp(exponential_decay, [0, 1], [1.0], method="rk4")


@pytest.mark.parametrize("method", ["dop853", "adams", "rk4"])
def test_what_the_function_raises_comes_through(method):
    def law(t, y):
        if t > 0.5:
            raise KeyError("mine")
        return -y

    with pytest.raises(KeyError, match="mine"):
        solve_ivp(law, [0, 1], [1.0], method=method, first_step=0.01)
    with pytest.raises(ValueError, match="gives 3 numbers for a state of 2"):
        solve_ivp(lambda t, y: [1, 2, 3], [0, 1], [0, 0])


def test_formulas_that_are_wrong_name_the_argument():
    for arguments, key in (
        ((["y1", "-k*y0"], [0, 1], [0, 1]), "fun[1]"),
        (({"x": "v", "v": "u"}, [0, 1], [0, 1]), "fun['v']"),
        ((["y1", "-y0"], [0, 1], [0, 1], None, None, False, "y7"), "events[0]"),
    ):
        with pytest.raises(trajet.SceneError) as caught:
            solve_ivp(*arguments)
        assert caught.value.key == key
    with pytest.raises(ValueError, match="2 formulas and `y0` 3"):
        solve_ivp(["y1", "y0"], [0, 1], [0, 0, 0])


def test_what_fails_numerically_is_a_status():
    for law in (lambda t, y: y**2, ["y0^2"]):
        sol = solve_ivp(law, [0, 2], [1.0], dense_output=True)
        assert sol.status == -1 and not sol.success and sol.message
        assert sol.t[-1] == pytest.approx(1, abs=1e-6)
        assert sol.sol(0.5) == pytest.approx([2], abs=1e-7)


def test_vectorized_args_max_step_and_components_of_atol():
    def law(t, y, a):
        assert y.shape == (2, 1)
        return a * y

    sol = solve_ivp(law, [0, 1], [1, 2], vectorized=True, args=(-1,), max_step=0.1, atol=[1e-10, 1e-12])
    assert np.diff(sol.t).max() <= 0.1 + 1e-15
    assert sol.y[:, -1] == pytest.approx(np.exp(-1) * np.array([1, 2]), abs=1e-9)
    with pytest.raises(ValueError, match="`atol` has wrong shape"):
        solve_ivp(exponential_decay, [0, 1], [1.0, 2.0], atol=[1, 1, 1])


def test_dense_output_knows_its_bounds():
    sol = solve_ivp(exponential_decay, [0, 1], [1.0], dense_output=True).sol
    assert sol(0.5).shape == (1,) and sol([0.5, 1.0]).shape == (1, 2)
    assert (sol.t_min, sol.t_max) == (0, 1) and sol.ts[0] == 0
    with pytest.raises(ValueError, match="lies outside the solution"):
        sol(1.5)


def test_t_eval_is_checked():
    for wrong in ([0.5, 0.1], [0, 2], [[0, 1]]):
        with pytest.raises(ValueError, match="t_eval"):
            solve_ivp(exponential_decay, [0, 1], [1.0], t_eval=wrong)


def test_options_of_scipys_methods_are_told_and_unknown_ones_refused():
    with pytest.warns(UserWarning, match="`jac` has no meaning"):
        solve_ivp(exponential_decay, [0, 1], [1.0], jac=None)
    with pytest.raises(TypeError, match="unexpected keyword argument 'tol'"):
        solve_ivp(exponential_decay, [0, 1], [1.0], tol=1)


def test_agrees_with_scipy():
    scipy = pytest.importorskip("scipy.integrate")
    law = lambda t, y: [y[1], (1 - y[0] ** 2) * y[1] - y[0]]
    event = lambda t, y: y[0]
    options = dict(events=event, dense_output=True, rtol=1e-10, atol=1e-12)
    ours, theirs = (solve(law, [0, 20], [2, 0], method="DOP853", **options) for solve in (solve_ivp, scipy.solve_ivp))
    assert set(ours) >= set(theirs) - {"jac"}
    assert ours.t_events[0] == pytest.approx(theirs.t_events[0], abs=1e-7)
    t = np.linspace(0, 20, 200)
    assert np.abs(ours.sol(t) - theirs.sol(t)).max() < 1e-6
    assert ours.y_events[0].shape == theirs.y_events[0].shape
