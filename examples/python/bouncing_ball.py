"""A ball with air drag bounces three times."""

import trajet

motion = trajet.run(
    {
        "time": {"end": 3.2},
        "body": [
            {
                "name": "ball",
                "shape": "sphere",
                "radius": 0.11,
                "position": [0, 0, 1],
                "velocity": [12, 0, 6],
                "acceleration": "[0, 0, -9.81] - 0.01*norm(v)*v",
            }
        ],
        "obstacle": [
            {"name": "ground", "shape": "plane", "point": [0, 0, 0], "normal": [0, 0, 1], "on_hit": "bounce", "restitution": 0.7}
        ],
    }
)
for impact in motion.impacts:
    print(f"{impact['time']:.9f} s: at x = {impact['point'][0]:.6f} m with {-impact['velocity_before'][2]:.6f} m/s")
