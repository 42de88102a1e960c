"""Sweeps and aiming."""

import math
import os
import subprocess

import numpy as np
import pytest

import trajet

SHOT = os.environ["TRAJET_SOURCE_DIR"] + "/examples/notes/rifle_shot.toml"
CANNON = {
    "parameters": {"theta": "40 deg", "v0": "50 m/s"},
    "time": {"end": 20},
    "body": [{"name": "shell", "velocity": "v0*[cos(theta), 0, sin(theta)]", "acceleration": [0, 0, -9.81]}],
    "obstacle": [{"name": "ground", "shape": "plane", "point": [0, 0, -1e-9], "normal": [0, 0, 1]}],
}


def test_a_grid_of_cannons_has_the_ranges_of_the_closed_form():
    result = trajet.sweep(CANNON, {"theta": ("10 deg", "80 deg", 71)}, report=["x", "hit", "max(z)"])
    assert len(result) == 71 and result.quantities == ["theta"] and result.columns == ["theta", "x", "hit", "max(z)"]
    theta = result["theta"]
    np.testing.assert_allclose(theta, np.radians(np.linspace(10, 80, 71)), rtol=1e-15)
    np.testing.assert_allclose(result["x"], 2500 * np.sin(2 * theta) / 9.81, rtol=1e-9)  # falls 1e-9 m further
    np.testing.assert_allclose(result["max(z)"], (50 * np.sin(theta)) ** 2 / (2 * 9.81), rtol=1e-14)
    assert (result["hit"] == "ground").all()
    assert result.rows["x"][3] == result["x"][3] and result.rows.dtype.names == tuple(result.columns)
    assert result.failures == {}


def test_samples_are_those_of_the_program():
    program = os.environ["TRAJET_PROGRAM"]
    if not program:
        pytest.skip("there is no program")
    table = subprocess.run(
        [program, "sweep", SHOT, "--sample", "theta=normal(0.05deg,0.03deg)", "--sample", "v0=uniform(480 m/s,500 m/s)"]
        + ["--correlate", "theta,v0=0.5", "--count", "100", "--seed", "9", "--report", "t,hit", "--out", "-"],
        capture_output=True, text=True, check=True,
    ).stdout.splitlines()
    for threads in (1, 3):
        result = trajet.sweep(
            SHOT, sample={"theta": "normal(0.05deg,0.03deg)", "v0": "uniform(480 m/s,500 m/s)"}, report="t,hit".split(","),
            correlate={("theta", "v0"): 0.5}, count=100, seed=9, threads=threads,
        )
        for i, line in enumerate(table[1:]):
            index, theta, v0, t, hit = line.split(",")
            assert (float(theta), float(v0), float(t)) == (result["theta"][i], result["v0"][i], result["t"][i])
            assert hit == result["hit"][i] and int(index) == i


def test_motions_that_fail_say_why():
    ball = {"parameters": {"a": 1}, "time": {"end": 1}, "body": [{"name": "b", "shape": "sphere", "radius": "a"}]}
    result = trajet.sweep(ball, {"a": (-1, 1, 2)}, report=["t"])
    assert list(result.failures) == [0] and "must be positive" in result.failures[0]
    assert math.isnan(result["t"][0]) and result["t"][1] == 1


def test_wrong_plans_name_the_argument():
    for arguments, key in [
        ({"vary": {"thet": (0, 1, 2)}}, "vary['thet']"),
        ({"sample": {"theta": "norml(0,1)"}}, "sample['theta']"),
        ({"vary": {"theta": (0, 1, 2)}, "report": "xx"}, "report"),
        ({"sample": {"theta": "normal(0,1)"}, "design": "lhc"}, "design"),
    ]:
        with pytest.raises(trajet.SceneError) as error:
            trajet.sweep(CANNON, **arguments)
        assert error.value.key == key, error.value


def test_both_arcs_of_a_cannon():
    result = trajet.aim(CANNON, {"theta": ("1 deg", "89 deg")}, at=(200, 0, 10))
    assert result.ok
    # tan of the elevation: x t - g x² (1 + t²) / (2 v²) = z
    k = 9.81 * 200**2 / (2 * 50**2)
    roots = sorted(np.roots([-k, 200, -k - 10]))
    found = [math.tan(each["parameters"]["theta"]) for each in result.solutions]
    np.testing.assert_allclose(found, roots, rtol=1e-12)


def test_a_target_out_of_reach():
    result = trajet.aim(CANNON, {"theta": ("1 deg", "89 deg")}, at=(400, 0, 0))
    assert result.status == "unreachable" and not result.ok and result.solutions == []
    assert result.closest["miss"] > 100
    with pytest.raises(trajet.SceneError) as error:
        trajet.aim(CANNON, {"theta": ("1 deg", "89 deg")}, "goal")
    assert error.value.key == "hit", error.value
    with pytest.raises(TypeError):
        trajet.aim(CANNON, {"theta": ("1 deg", "89 deg")})
