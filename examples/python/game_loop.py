"""A loop of 60 frames a second knows of each impact before it happens, and plays its sound at the exact time."""

import trajet

motion = trajet.run(
    {
        "time": {"end": 2},
        "body": [{"name": "ball", "position": [0, 0, 2], "velocity": [3, 0, 0], "acceleration": [0, 0, -9.81]}],
        "obstacle": [
            {"name": "ground", "shape": "plane", "point": [0, 0, 0], "normal": [0, 0, 1], "on_hit": "bounce", "restitution": 0.8}
        ],
    }
)
impacts = list(motion.impacts["time"])
for frame in range(120):
    now, then = frame / 60, (frame + 1) / 60
    while impacts and impacts[0] < then:
        height = motion.position("ball", now)[2]
        print(f"frame {frame}, height {height:.6f} m: sound in {1e3 * (impacts.pop(0) - now):.6f} ms")
