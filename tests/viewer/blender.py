"""Imports scenes as .glb into Blender and compares every impact and the end with the report, pose by pose.

blender --background --factory-startup --python-exit-code 1 --python blender.py -- PROGRAM FOLDER SCENE...

glTF is y up; Blender's importer turns it back to z up, so that world positions are those of the scene.
"""

import json
import math
import pathlib
import subprocess
import sys

import bpy
from mathutils import Quaternion

SKIPPED = 77
try:
    import numpy
except ImportError:
    print("Blender's importer of glTF needs NumPy")
    sys.exit(SKIPPED)
if "bool" not in vars(numpy):
    numpy.bool = bool  # the importer of Debian's Blender 3.4 is older than the NumPy beside it

FPS = 60
# Ten times what was measured: single precision in the file and in Blender, of the coordinates.
TOLERANCE = 2e-6
# The importer turns the coordinates of every object, and with them its frame, from y up to z up.
OBJECT_TO_BODY = Quaternion((1, 0, 0), math.radians(90))


def go_to(scene, time):
    frame = time * scene.render.fps
    scene.frame_set(int(frame), subframe=frame - int(frame))


def position_difference(name, expected):
    """Relative to the coordinates (at least 1 m)."""
    found = bpy.data.objects[name].matrix_world.to_translation()
    size = max(1.0, *map(abs, expected))
    return max(abs(a - b) / size for a, b in zip(found, expected))


def rotation_difference(name, expected):
    """Of unit quaternions, either sign of which is the same rotation."""
    found = bpy.data.objects[name].matrix_world.to_quaternion() @ OBJECT_TO_BODY
    expected = Quaternion(expected).normalized()
    sign = 1 if found.dot(expected) > 0 else -1
    return max(abs(sign * a - b) for a, b in zip(found, expected))


def largest_difference(file, report):
    """Over all poses, and how many there were."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.fps = FPS
    bpy.ops.import_scene.gltf(filepath=str(file))
    differences = []
    for each in report["impacts"]:
        if each["kind"] == "rest":
            continue  # its time is behind its position, which is that of the last bounce
        go_to(scene, each["time"] - report["start_time"])
        differences.append(position_difference(each["body"], each["position"]))
    go_to(scene, report["end_time"] - report["start_time"])
    for each in report["final"]:
        differences.append(position_difference(each["body"], each["position"]))
        differences.append(rotation_difference(each["body"], each["orientation"]))
        for point, state in each["points"].items():
            differences.append(position_difference(f"{each['body']}.{point}", state["position"]))
    return max(differences), len(differences)


def main(program, folder, *scenes):
    good = True
    for scene in map(pathlib.Path, scenes):
        file = pathlib.Path(folder) / f"{scene.stem}_blender.glb"
        report = subprocess.run(
            [program, "run", scene, "--glb", file, "--json", "-"], check=True, capture_output=True, text=True
        ).stdout
        difference, count = largest_difference(file, json.loads(report))
        print(f"{scene.name}: {count} poses, largest difference {difference:.2g}")
        good = good and count > 0 and difference <= TOLERANCE
    return 0 if good else 1


arguments = sys.argv[sys.argv.index("--") + 1 :]
sys.exit(main(*arguments))
