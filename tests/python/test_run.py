"""Motions: the same as the program's, questions, errors."""

import math
import os
import pickle
import signal
import threading
import time

import numpy as np
import pytest
import trajet

ROUNDING = 1e-14  # some roundings of terms of up to 10


def test_is_bit_for_bit_what_the_program_reports(examples, program):
    for scene in examples:
        ours, theirs = trajet.run(scene).report(), program(scene)
        for report in (ours, theirs):
            del report["statistics"]["wall_seconds"]
        assert ours == theirs, scene


def test_a_dict_is_bit_for_bit_the_file(bounce, program, tmp_path):
    scene = tmp_path / "bounce.toml"
    scene.write_text(
        """[time]
end = 1.9
[parameters]
g = 10
[[body]]
name = "ball"
position = [0, 0, 5]
velocity = [1, 0, 0]
acceleration = [0, 0, "-g"]
[[obstacle]]
name = "ground"
shape = "plane"
point = [0, 0, 0]
normal = [0, 0, 1]
on_hit = "bounce"
restitution = 0.5
"""
    )
    for motion in (trajet.run(bounce), trajet.run(scene.read_text()), trajet.run(str(scene))):
        for key in ("impacts", "final", "events"):
            assert motion.report()[key] == program(scene)[key]


def test_numbers_of_a_dict_keep_all_their_digits(bounce):
    place = [1 / 3, -1e-300, 123456789.12345679]
    bounce["body"][0].update(position=np.array(place))
    assert trajet.run(bounce).position("ball", 0.0).tolist() == place


def test_records_are_those_of_the_report(bounce):
    bounce["event"] = [{"name": "low", "when": "ball.z - 1"}]
    motion = trajet.run(bounce)
    report = motion.report()
    for rows, entries in ((motion.impacts, report["impacts"]), (motion.events, report["events"]),
                          (motion.final, report["final"])):
        assert len(rows) == len(entries) > 0
        for row, entry in zip(rows, entries):
            for key in entry.keys() - {"features", "points", "determinant", "orthogonality_error"}:
                assert np.array_equal(row[key], entry[key]), key
    assert motion.events.dtype.names == ("time", "event", "direction", "law")


def test_no_records_are_empty_tables(bounce):
    motion = trajet.run(bounce, end=0.5)
    assert [len(rows) for rows in (motion.impacts, motion.events, motion.contacts)] == [0, 0, 0]
    assert motion.impacts["point"].shape == (0, 3)


def test_positions_have_the_shape_of_the_times(bounce):
    motion = trajet.run(bounce)
    assert motion.position("ball", 0.5).shape == (3,)
    assert motion.position("ball", [0.5, 0.1]).shape == (2, 3)
    assert motion.position("ball", np.zeros((4, 2))).shape == (4, 2, 3)
    assert motion.position("ball", []).shape == (0, 3)
    assert motion.orientation("ball", [0.1]).tolist() == [[1, 0, 0, 0]]
    assert motion.angular_velocity("ball", 0.1).tolist() == [0, 0, 0]


def test_positions_are_the_closed_form(bounce):
    motion = trajet.run(bounce)
    t = np.random.default_rng(3).uniform(0, 1.9, 1000)
    since = t - 1
    height = np.where(t < 1, 5 - 5 * t**2, 5 * since - 5 * since**2)
    assert np.abs(motion.position("ball", t) - np.stack([t, 0 * t, height], axis=1)).max() < ROUNDING
    speed = np.where(t < 1, -10 * t, 5 - 10 * since)
    assert np.abs(motion.velocity("ball", t)[:, 2] - speed).max() < ROUNDING
    assert motion.position("ball", t[7]).tolist() == motion.position("ball", t)[7].tolist()


def test_behind_a_jump_and_at_the_end(bounce):
    motion = trajet.run(bounce)
    (impact,) = motion.impacts
    assert motion.velocity("ball", impact["time"]).tolist() == impact["velocity_after"].tolist()
    assert motion.position("ball", motion.end_time).tolist() == motion.final["position"][0].tolist()
    assert motion.state(motion.end_time)["velocity"].tolist() == motion.final["velocity"].tolist()


def test_extra_states(bounce):
    bounce["state"] = [{"name": "s", "value": 1, "rate": "-s"}]
    motion = trajet.run(bounce)
    t = np.linspace(0, 1.9, 50)
    assert np.abs(motion.value("s", t) - np.exp(-t)).max() < 1e-11
    assert isinstance(motion.value("s", 1.0), float)
    assert motion.states["s"] == motion.value("s", motion.end_time)


@pytest.mark.parametrize("t", [-0.1, 2.0, float("nan"), [0.5, 7.0]])
def test_outside_is_an_error(bounce, t):
    with pytest.raises(ValueError, match="lies outside the motion"):
        trajet.run(bounce).position("ball", t)


def test_an_unknown_name_is_an_error(bounce):
    with pytest.raises(ValueError, match="no body 'bal'; did you mean 'ball'"):
        trajet.run(bounce).position("bal", 0)


def test_set_and_options(bounce):
    motion = trajet.run(bounce, set={"g": 5.0, "ball.velocity": [2, 0, 0], "ground.restitution": "0.25"}, end="1 s",
                        method="rk4", step=0.01)
    assert motion.parameters["g"] == 5 and motion.end_time == 1 and motion.method == "rk4"
    assert motion.final["velocity"][0] == pytest.approx([2, 0, -5], abs=1e-12)


@pytest.mark.parametrize(
    "change, key, message",
    [
        (lambda s: s["body"][0].update(acceleration=[0, 0, "-gg"]), "body[0].acceleration[2]", "unknown name 'gg'"),
        (lambda s: s["body"][0].update(velocity=[0, "3 kg", 0]), "body[0].velocity[1]", "got mass"),
        (lambda s: s["body"][0].update(orientation={"axis": [0, 0, 1], "angel": 1}), "body[0].orientation.angel", "angel"),
        (lambda s: s.update(bodi=[]), "bodi", "did you mean 'body'"),
        (lambda s: s.pop("time"), "the scene", "lacks the table"),
        (lambda s: s["time"].update(end=float("inf")), "time.end", "finite"),
        (lambda s: s["obstacle"][0].pop("point"), "obstacle[0]", "lacks the key 'point'"),
        (lambda s: s["body"][0].update(name="ballé €𝄞"), "body[0].name", "name"),
    ],
)
def test_errors_of_a_dict_name_the_key(bounce, change, key, message):
    change(bounce)
    with pytest.raises(trajet.SceneError, match=message) as caught:
        trajet.run(bounce)
    assert caught.value.key == key and caught.value.line is None
    assert str(caught.value).startswith(key)


def test_errors_of_a_file_have_a_place(tmp_path):
    scene = tmp_path / "wrong.toml"
    scene.write_text('[time]\nend = 1\n[[body]]\nname = "a"\nvelocity = [0, "2*v", 0]\n')
    with pytest.raises(trajet.SceneError) as caught:
        trajet.check(scene)
    error = caught.value
    assert (error.file, error.line, error.column) == (str(scene), 5, 19)
    assert str(error) == f"{scene}:5:19: unknown name 'v'"
    copy = pickle.loads(pickle.dumps(error))
    assert str(copy) == str(error) and copy.line == 5


@pytest.mark.parametrize(
    "options, key",
    [({"set": {"h": 1}}, "set['h']"), ({"method": "eulr"}, "method"), ({"step": "1 kg"}, "step"),
     ({"rtol": "x"}, "rtol"), ({"orientation": "x"}, "orientation")],
)
def test_errors_of_options_name_them(bounce, options, key):
    with pytest.raises(trajet.SceneError) as caught:
        trajet.run(bounce, **options)
    assert caught.value.key == key


def test_what_is_no_scene_is_an_error(bounce):
    with pytest.raises(FileNotFoundError):
        trajet.run("no_such_scene.toml")
    with pytest.raises(TypeError):
        trajet.run(7)
    with pytest.raises(TypeError, match=r"body\[0\].mass"):
        bounce["body"][0]["mass"] = object()
        trajet.run(bounce)


def test_failing_numbers_raise_nothing():
    motion = trajet.run({"time": {"end": 2}, "state": [{"name": "s", "value": 1, "rate": "s^2"}]})
    assert motion.status == "failed" and not motion.ok and motion.failure
    assert motion.value("s", 0.5) == pytest.approx(2, abs=1e-9)


def test_check_gives_warnings(bounce):
    assert trajet.check(bounce) == []
    bounce["event"] = [{"name": "never", "when": "ball.x^2 + 1"}]
    assert any("never" in warning for warning in trajet.check(bounce))


LONG = {
    "time": {"end": 1e7},
    "method": {"name": "rk4", "step": 1e-3, "max_steps": 10**10},
    "state": [{"name": "s", "value": 1, "rate": "-s*sin(t)"}],
}


def test_ctrl_c_ends_a_run():
    threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    began = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        trajet.run(LONG)
    assert time.monotonic() - began < 5


def test_other_threads_go_on_during_a_run():
    counted = 0
    over = threading.Event()

    def compute():
        trajet.run(LONG, set={"time.end": 300.0})
        over.set()

    thread = threading.Thread(target=compute)
    thread.start()
    while not over.wait(0.001):
        counted += 1
    thread.join()
    assert counted > 5


def test_columns_are_of_one_dimension(bounce):
    columns = trajet.columns(trajet.run(bounce).impacts)
    assert all(column.ndim == 1 for column in columns.values())
    assert columns["velocity_after_z"].tolist() == [5.0]
    final = trajet.columns(trajet.run(bounce).final)
    assert final["orientation_w"].tolist() == [1.0] and final["rotation_matrix_33"].tolist() == [1.0]
    pandas = pytest.importorskip("pandas")
    assert list(pandas.DataFrame(columns).columns) == list(columns)


def test_compare(bounce):
    del bounce["obstacle"]
    rows = trajet.compare(bounce, ["euler", "rk4"], steps=[10, 20]).rows
    assert rows["method"].tolist() == ["euler", "euler", "rk4", "rk4"]
    # Euler's error at the end of constant acceleration: g T h / 2
    assert rows["error_at_end"][0] == pytest.approx(10 * 1.9 * 0.19 / 2)
    assert rows["error_at_end"][2] < 1e-12
    with pytest.raises(trajet.SceneError):
        trajet.compare(bounce, ["no method"])


def test_view(bounce, tmp_path):
    try:
        page = trajet.view(bounce)
    except OSError as error:
        pytest.skip(str(error))
    assert page.html.startswith("<!") and "<iframe" in page._repr_html_()
    page.save(tmp_path / "page.html")
    assert (tmp_path / "page.html").read_text(encoding="utf-8") == page.html
    motion = trajet.run(bounce)
    assert trajet.view(motion, trajet.run(bounce, method="rk4", step=0.1)).html
    with pytest.raises(TypeError):
        trajet.view(motion, method="rk4")


def test_methods_are_those_of_the_program():
    names = [method.name for method in trajet.methods()]
    assert names[0] == "euler" and "taylor" in names
    assert next(m for m in trajet.methods() if m.name == "dopri5").aliases == ("ode45", "RK45")


def test_impacts_resolved_together_have_one_number():
    ball = {"shape": "sphere", "radius": 0.5, "mass": 1}
    balls = [{"name": name, "position": [x, 0, 0], **ball} for name, x in zip("abc", (-2, 0, 1))]
    balls[0]["velocity"] = [1, 0, 0]
    motion = trajet.run({"time": {"end": 2}, "body": balls})
    assert motion.impacts["group"].tolist() == [1, 1]
    assert motion.velocity("c", 2.0).tolist() == [1, 0, 0]
    alone = trajet.run({"time": {"end": 2}, "body": balls[:2]})
    assert len(alone.impacts) == 1 and math.isnan(alone.impacts["group"][0])
