"""A rocket burns its fuel in 4 s and flies on to its apex, where the run stops."""

import trajet

motion = trajet.run(
    {
        "parameters": {"burning": 4, "thrust": 600},
        "time": {"end": 100},
        "body": [
            {
                "name": "rocket",
                "mass": "m",
                "force": "[0, 0, where(t < burning, thrust, 0) - m*9.81] - 0.002*norm(v)*v",
            }
        ],
        "state": [{"name": "m", "value": 20, "rate": "where(t < burning, -2, 0)"}],
        "event": [{"name": "apex", "when": "rocket.vz", "direction": "falling", "action": "stop"}],
    }
)
end = motion.end_time
burnt_out, apex = motion.position("rocket", [4, end])[:, 2]
print(f"burnt out at {burnt_out:.6f} m with {motion.velocity('rocket', 4)[2]:.6f} m/s")
print(f"apex after {end:.9f} s at {apex:.6f} m, mass {motion.value('m', end):.6f} kg")
