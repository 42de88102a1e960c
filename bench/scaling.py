"""How the costs of the program grow: tables of measurements beside the goals, with growth exponents.

    python3 scaling.py PROGRAM [TABLE...]

Times are user times of whole runs of the program, reading included, the least of a few runs; memory is the largest
resident set. The exponent is the slope of log(time) over log(N) by least squares. `bench/README.md` describes the
tables.
"""

import math
import os
import pathlib
import random
import struct
import sys
import tempfile

REPEATS = 2


class Cost:
    """Of one run of a program: user and system time in s, the largest resident set in MB."""

    def __init__(self, command, repeats=REPEATS):
        runs = [self.measure(command) for _ in range(repeats)]
        self.user = min(usage.ru_utime for usage in runs)
        self.cpu = min(usage.ru_utime + usage.ru_stime for usage in runs)
        self.megabytes = max(usage.ru_maxrss for usage in runs) / 1000

    @staticmethod
    def measure(command):
        null = os.open(os.devnull, os.O_RDWR)
        actions = [(os.POSIX_SPAWN_DUP2, null, 1), (os.POSIX_SPAWN_DUP2, null, 2)]
        child = os.posix_spawn(command[0], command, os.environ, file_actions=actions)
        os.close(null)
        _, status, usage = os.wait4(child, 0)
        if os.waitstatus_to_exitcode(status) != 0:
            sys.exit(f"failed: {' '.join(command)}")
        return usage


class Bench:
    def __init__(self, program, folder):
        self.program = str(pathlib.Path(program).resolve())
        self.folder = pathlib.Path(folder)

    def scene(self, text):
        path = self.folder / "scene.toml"
        path.write_text(text)
        return str(path)

    def run(self, text, *options, repeats=REPEATS):
        return Cost([self.program, "run", self.scene(text), "--quiet", *options], repeats)


def slope(points):
    """The exponent of the growth through points (n, cost)."""
    logs = [(math.log(n), math.log(max(cost, 1e-9))) for n, cost in points]
    mean_x = sum(x for x, _ in logs) / len(logs)
    mean_y = sum(y for _, y in logs) / len(logs)
    return sum((x - mean_x) * (y - mean_y) for x, y in logs) / sum((x - mean_x) ** 2 for x, _ in logs)


def table(title, goal, points, unit):
    print(f"\n{title}\n  goal: {goal}")
    for n, cost in points:
        print(f"  {n:>9,}  {cost:10.3f} {unit}")
    print(f"  exponent {slope(points):.2f}", flush=True)


def head(end):
    return f"[time]\nend = {end}\n"


def ball(name, position, velocity=(0, 0, 0), acceleration="[0, 0, -9.81]"):
    return (
        f'[[body]]\nname = "{name}"\nshape = "sphere"\nradius = 0.1\nposition = {list(position)}\n'
        f"velocity = {list(velocity)}\nacceleration = {acceleration}\n"
    )


def plane(name, point, normal, restitution=0.9):
    return (
        f'[[obstacle]]\nname = "{name}"\nshape = "plane"\npoint = {list(point)}\nnormal = {list(normal)}\n'
        f'on_hit = "bounce"\nrestitution = {restitution}\n'
    )


def grid(count):
    """Balls on a square grid at heights of their own, which do not meet where they fall straight."""
    source = random.Random(1)
    side = math.isqrt(count - 1) + 1
    return "".join(
        ball(f"b{i}", (i % side, i // side, source.uniform(0.5, 2))) for i in range(count)
    )


def balls_on_plane(bench):
    text = lambda n: head(2) + plane("ground", (0, 0, 0), (0, 0, 1)) + grid(n)
    points = [(n, bench.run(text(n)).user) for n in (300, 1000, 3000, 10000)]
    table("N balls that bounce on a plane for 2 s", "exponent at most 1.1; 10,000 within 1 s", points, "s")


def points_in_room(bench):
    def text(n):
        side = 10
        walls = [
            plane(f"wall{axis}{end}", [end * side * part for part in unit], [(1 - 2 * end) * part for part in unit])
            for axis, unit in enumerate(([1, 0, 0], [0, 1, 0], [0, 0, 1]))
            for end in (0, 1)
        ]
        source = random.Random(3)
        vector = lambda low, high: [source.uniform(low, high) for _ in range(3)]
        bodies = "".join(
            f'[[body]]\nname = "p{i}"\nposition = {vector(1, 9)}\nvelocity = {vector(-10, 10)}\n'
            "acceleration = [0, 0, -9.81]\n"
            for i in range(n)
        )
        return head(2) + "".join(walls) + bodies

    points = [(n, bench.run(text(n)).user) for n in (300, 1000, 3000, 10000)]
    table("N points that bounce between six walls for 2 s", "exponent at most 1.1", points, "s")


def road(bench):
    def text(n):
        boxes = "".join(
            f'[[obstacle]]\nname = "box{i}"\nshape = "box"\ncenter = [{i}, 0, -0.5]\nsize = [1, 1, 1]\n'
            f'on_hit = "bounce"\nrestitution = 1\n'
            for i in range(n)
        )
        # one bounce on the middle of each box
        fall = 9.81 / 8
        start = ball("b", (0, 0, 0.1 + fall), (1, 0, 0))
        return head(n - 1) + boxes + start

    points = [(n, bench.run(text(n)).user) for n in (300, 1000, 3000)]
    table("one ball that bounces along a road of N boxes", "exponent at most 1.1", points, "s")


def triangles(n, distance, side=0.1):
    """Small triangles, scattered around a point so far away."""
    source = random.Random(2)
    rows = []
    for i in range(n):
        x, y, z = (source.uniform(-100, 100) for _ in range(3))
        x += distance
        rows.append(
            f'[[obstacle]]\nname = "t{i}"\nshape = "triangle"\n'
            f"points = [[{x}, {y}, {z}], [{x + side}, {y}, {z}], [{x}, {y + side}, {z}]]\n"
        )
    return "".join(rows)


def far_triangles(bench):
    steps = 20_000

    def cost_per_step(n):
        method = '[method]\nname = "rk4"\nstep = 0.01\n'
        body = ball("b", (0, 0, 0), (3, 0, 0), '"[0, 0, -9.81] - 0.1 * v"')
        text = lambda end: method + head(end) + body + triangles(n, 1e6)
        return (bench.run(text(steps * 0.01)).user - bench.run(text(0.01)).user) / steps * 1e6

    points = [(n, cost_per_step(n)) for n in (100, 1000, 10000)]
    table("one step beside N triangles far away", "the logarithm of N: exponent near 0", points, "us")


def outputs(bench):
    print("\nmemory of outputs, one ball between two walls\n  goal: constant")
    walls = plane("left", (0, 0, 0), (1, 0, 0), 1) + plane("right", (1, 0, 0), (-1, 0, 0), 1)
    for option in ((), ("--json", "out.json"), ("--html", "out.html"), ("--csv", "out.csv")):
        row = []
        for impacts in (10_000, 100_000):
            text = head(impacts * 0.8) + ball("b", (0.5, 0, 0), (1, 0, 0), "[0, 0, 0]") + walls
            files = [str(bench.folder / name) for name in option[1:]]
            row.append(bench.run(text, *option[:1], *files, repeats=1).megabytes)
        print(f"  {option[0] if option else 'none':8} {row[0]:8.1f} MB at 10,000 impacts {row[1]:8.1f} MB at 100,000")


def start(bench):
    scene = pathlib.Path(__file__).resolve().parent.parent / "examples/notes/rifle_shot.toml"
    count = 200
    total = sum(Cost([bench.program, "run", str(scene)], 1).cpu for _ in range(count))
    print(f"\nstart of the program: a run of the rifle shot\n  goal: 3 ms of CPU\n  {total / count * 1e3:.2f} ms")


def large_scenes(bench):
    body = ball("b", (0, 0, 0))
    cost = bench.run(head(0.1) + body + triangles(100_000, 1000), repeats=1)
    print("\n100,000 triangles in a scene\n  goal: 100 MB, 1 s")
    print(f"  {cost.megabytes:.0f} MB {cost.user:.2f} s user {cost.cpu:.2f} s CPU")
    side = 708  # squares of two triangles
    with open(bench.folder / "ground.stl", "wb") as file:
        file.write(bytes(80) + struct.pack("<I", 2 * side * side))
        for i in range(side):
            for j in range(side):
                height = lambda a, b: math.sin(0.05 * a) * math.cos(0.03 * b) - 10
                p, q, r, s = ((a, b, height(a, b)) for a, b in ((i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1)))
                file.write(struct.pack("<12fH", 0, 0, 0, *p, *q, *r, 0) + struct.pack("<12fH", 0, 0, 0, *q, *s, *r, 0))
    mesh = '[[obstacle]]\nname = "ground"\nshape = "mesh"\nfile = "ground.stl"\n'
    cost = bench.run(head(0.1) + body + mesh, repeats=1)
    print("\na mesh file of a million triangles\n  goal: 300 MB, 1 s")
    print(f"  {cost.megabytes:.0f} MB {cost.user:.2f} s user {cost.cpu:.2f} s CPU", flush=True)


TABLES = {
    "plane": balls_on_plane,
    "room": points_in_room,
    "road": road,
    "triangles": far_triangles,
    "outputs": outputs,
    "start": start,
    "large": large_scenes,
}


def main():
    if len(sys.argv) < 2 or any(name not in TABLES for name in sys.argv[2:]):
        sys.exit(f"usage: scaling.py PROGRAM [{'|'.join(TABLES)}]...")
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(sys.argv[1], folder)
        for name in sys.argv[2:] or TABLES:
            TABLES[name](bench)


main()
