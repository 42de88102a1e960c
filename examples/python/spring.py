"""Two bodies with a spring between them: they swing about their centre of mass, which moves on."""

import numpy as np
import trajet

motion = trajet.run(
    {
        "parameters": {"k": 20},
        "time": {"end": 2},
        "body": [
            {"name": "left", "mass": 1, "force": "k*(norm(right.r - r) - 1)*unit(right.r - r)"},
            {
                "name": "right",
                "mass": 3,
                "position": [1.5, 0, 0],
                "velocity": [0, 0.4, 0],
                "force": "k*(norm(left.r - r) - 1)*unit(left.r - r)",
            },
        ],
    }
)
times = np.linspace(0, 2, 5)
left, right = motion.position("left", times), motion.position("right", times)
for t, a, b in zip(times, left, right):
    print(f"{t:.1f} s: length {np.linalg.norm(b - a):.9f} m, centre at y = {(a + 3 * b)[1] / 4:.9f} m")
