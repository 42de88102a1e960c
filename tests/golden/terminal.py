"""What the program writes to a terminal, and what it does not write elsewhere: terminal.py PROGRAM SCENE

SCENE is one of the examples whose run stops at an impact.
"""

import fcntl
import os
import pty
import re
import struct
import subprocess
import sys
import tempfile
import termios
import unittest

PROGRAM, SCENE = sys.argv[1:3]

# Euler's method needs seconds for this.
LONG_SCENE = """
[time]
end = 1e5
sample = 1000
[method]
name = "euler"
step = 1e-3
max_steps = 1000000000
[[body]]
name = "p"
position = [1, 0, 0]
velocity = [0, 1, 0]
acceleration = "[-x, -y, 0]"
"""
PROGRESS = re.compile(r"\d+ %, t = \S+ of 100000 s, \S+ steps/s, \d+ (s|min) left")


def on_terminal(arguments, columns=100, seconds=None, **environment):
    """What a terminal of that width receives; ended by Ctrl-C after so many seconds."""
    master, slave = pty.openpty()
    fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
    cleared = {name: value for name, value in os.environ.items() if name != "NO_COLOR"}
    process = subprocess.Popen(
        [PROGRAM, *arguments], stdin=slave, stdout=slave, stderr=slave, env={**cleared, **environment}
    )
    os.close(slave)
    if seconds is not None:
        try:
            process.wait(seconds)
        except subprocess.TimeoutExpired:
            process.send_signal(2)
    received = b""
    while True:
        try:
            part = os.read(master, 65536)
        except OSError:  # the other side is closed
            break
        if not part:
            break
        received += part
    os.close(master)
    return received.decode(), process.wait()


class Terminal(unittest.TestCase):
    def test_colours_only_there_and_only_if_they_are_welcome(self):
        coloured, _ = on_terminal(["run", SCENE])
        self.assertIn("\033[32mstopped\033[0m", coloured)
        plain, _ = on_terminal(["run", SCENE], NO_COLOR="1")
        self.assertIn("stopped at t = ", plain)
        self.assertNotIn("\033", plain)
        piped = subprocess.run([PROGRAM, "run", SCENE], capture_output=True, text=True, check=True)
        self.assertIn("stopped at t = ", piped.stdout)
        self.assertNotIn("\033", piped.stdout + piped.stderr)

    def test_progress_with_rate_and_time_left_on_one_line(self):
        with tempfile.NamedTemporaryFile("w", suffix=".toml") as scene:
            scene.write(LONG_SCENE)
            scene.flush()
            text, code = on_terminal(["run", scene.name, "--quiet"], seconds=1.5)
            self.assertEqual(code, 130)
            self.assertRegex(text, PROGRESS)
            self.assertTrue(text.endswith("\r\033[K"), "the line is taken back")
            narrow, _ = on_terminal(["run", scene.name, "--quiet"], columns=30, seconds=1.5)
            shown = [part.removesuffix("\033[K") for part in narrow.split("\r")]
            self.assertEqual(max(map(len, shown)), 29)


unittest.main(argv=sys.argv[:1])
