"""Imports scenes as .glb into Blender and compares every impact and the end with the report, pose by pose.

blender --background --factory-startup --python-exit-code 1 --python blender.py -- PROGRAM FOLDER SCENE...

glTF is y up; Blender's importer turns it back to z up, so that world positions are those of the scene.
"""

import json
import pathlib
import subprocess
import sys

import bpy

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


def position_at(scene, body, time):
    frame = time * scene.render.fps
    scene.frame_set(int(frame), subframe=frame - int(frame))
    return bpy.data.objects[body].matrix_world.to_translation()


def largest_difference(file, report):
    """Over all poses, relative to the coordinates (at least 1 m), and how many there were."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.fps = FPS
    bpy.ops.import_scene.gltf(filepath=str(file))
    # the time of a rest is behind its position, which is that of the last bounce
    poses = [(each["time"], each["body"], each["position"]) for each in report["impacts"] if each["kind"] != "rest"]
    poses += [(report["end_time"], each["body"], each["position"]) for each in report["final"]]
    largest = 0.0
    for time, body, expected in poses:
        found = position_at(scene, body, time - report["start_time"])
        size = max(1.0, *map(abs, expected))
        largest = max(largest, *(abs(a - b) / size for a, b in zip(found, expected)))
    return largest, len(poses)


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
