"""What the tests of the package share."""

import json
import os
import pathlib
import subprocess

import pytest

ROOT = pathlib.Path(os.environ["TRAJET_SOURCE_DIR"])


@pytest.fixture
def examples():
    return sorted((ROOT / "examples").rglob("*.toml"))


@pytest.fixture
def program():
    """Runs the program; its report."""

    def report(*words):
        run = subprocess.run([os.environ["TRAJET_PROGRAM"], "run", *map(str, words), "--json", "-"], stdout=subprocess.PIPE,
                             check=False)
        return json.loads(run.stdout)

    return report


BOUNCE = {
    "time": {"end": 1.9},
    "parameters": {"g": 10},
    "body": [{"name": "ball", "position": [0, 0, 5], "velocity": [1, 0, 0], "acceleration": [0, 0, "-g"]}],
    "obstacle": [
        {
            "name": "ground",
            "shape": "plane",
            "point": [0, 0, 0],
            "normal": [0, 0, 1],
            "on_hit": "bounce",
            "restitution": 0.5,
        }
    ],
}


@pytest.fixture
def bounce():
    """A ball that lands after 1 s with 10 m/s."""
    return json.loads(json.dumps(BOUNCE))
