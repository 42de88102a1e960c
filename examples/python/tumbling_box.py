"""A box tumbles, and a torque that dies away speeds it up about its longest axis."""

import trajet

box = {
    "name": "box",
    "shape": "box",
    "size": [0.1, 0.4, 0.9],
    "mass": 10,
    "angular_velocity": [0.1, 5, 0.1],
    "torque_body": [0, 0, "0.5*exp(-t)"],
}
motion = trajet.run({"time": {"end": 4}, "body": [box]})
times = range(5)
for t, q, w in zip(times, motion.orientation("box", times), motion.angular_velocity("box", times)):
    q, w = (" ".join(f"{each:+.6f}" for each in numbers) for numbers in (q, w))
    print(f"{t} s: q = {q}, w = {w} rad/s")
