"""What the program writes to a terminal, and what it does not write elsewhere: terminal.py PROGRAM SCENE

SCENE is one of the examples whose run stops at an impact.
"""

import fcntl
import os
import pty
import re
import select
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


def on_terminal(arguments, columns=100, seconds=None, program=PROGRAM, **environment):
    """What a terminal of that width receives; ended by Ctrl-C after so many seconds."""
    master, slave = pty.openpty()
    fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
    cleared = {name: value for name, value in os.environ.items() if name != "NO_COLOR"}
    process = subprocess.Popen(
        [program, *arguments], stdin=slave, stdout=slave, stderr=slave, env={**cleared, **environment}
    )
    if seconds is not None:
        try:
            process.wait(seconds)
        except subprocess.TimeoutExpired:
            process.send_signal(2)
    # our end of the other side stays open until all has come: where nobody has it, what is on its way can be lost
    received = b""
    while True:
        is_over = process.poll() is not None
        if select.select([master], [], [], 0.05)[0]:
            received += os.read(master, 65536)
        elif is_over:
            break
    os.close(slave)
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

    def test_a_fault_is_shown_in_its_line(self):
        line = 'velocity = [0, "sqrt(ü)\t+ gg", 0]'
        with tempfile.NamedTemporaryFile("w", suffix=".toml") as scene:
            scene.write(f'[parameters]\n"ü" = 4\n[time]\nend = 1\n[[body]]\nname = "b"\n{line}\n')
            scene.flush()
            message = f"{scene.name}:7:28: error: unknown name 'gg'"
            plain, code = on_terminal(["check", scene.name], NO_COLOR="1")
            self.assertEqual(code, 3)
            first, shown, caret = plain.splitlines()
            self.assertEqual(first, message)
            self.assertEqual(shown, "    7 | " + line.replace("\t", " "))
            self.assertEqual(caret.index("^"), shown.index("gg"))
            coloured, _ = on_terminal(["check", scene.name])
            self.assertIn("\033[31merror:\033[0m unknown name", coloured)
            self.assertEqual(re.sub("\033\\[\\d*m", "", coloured), plain)
            narrow, _ = on_terminal(["check", scene.name], columns=20, NO_COLOR="1")
            _, shown, caret = narrow.splitlines()[-3:]
            self.assertLessEqual(len(shown), 20)
            self.assertEqual(shown[caret.index("^") :][:2], "gg")
            piped = subprocess.run([PROGRAM, "check", scene.name], capture_output=True, text=True, check=False)
            self.assertEqual(piped.stderr, message + "\n")

    def test_a_fault_of_standard_input_is_shown_too(self):
        with tempfile.NamedTemporaryFile("w") as scene:
            scene.write('[time]\nend = "1 kg"\n')
            scene.flush()
            command = f"'{PROGRAM}' check - < '{scene.name}'"
            shown, _ = on_terminal(["-c", command], program="/bin/sh", NO_COLOR="1")
            self.assertIn('    2 | end = "1 kg"', shown)

    def test_tables_fit_the_terminal(self):
        for command in (
            ["run", SCENE],
            ["compare", SCENE, "--methods", "rk4,dopri5", "--steps", "100", "--rtols", "1e-6"],
            ["methods"],
            ["examples"],
        ):
            wide, _ = on_terminal(command, columns=400, NO_COLOR="1")
            narrow, _ = on_terminal(command, columns=72, NO_COLOR="1")
            self.assertLessEqual(max(map(len, narrow.splitlines())), 72, command)
            self.assertLess(set(re.findall("[a-z]+", wide)) - set(re.findall("[a-z]+", narrow)), {"-"}, command)
        piped = subprocess.run([PROGRAM, "methods"], capture_output=True, text=True, check=True)
        self.assertEqual(piped.stdout.splitlines(), on_terminal(["methods"], columns=400)[0].splitlines())

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
