"""A program prints what a file has, and succeeds: prints.py FILE COMMAND..."""

import difflib
import pathlib
import subprocess
import sys

expected = pathlib.Path(sys.argv[1]).read_text(encoding="utf-8").splitlines()
run = subprocess.run(sys.argv[2:], stdout=subprocess.PIPE, text=True, check=False)
difference = list(difflib.unified_diff(expected, run.stdout.splitlines(), "expected", "printed", lineterm=""))
print("\n".join(difference) or f"{len(expected)} lines as expected")
sys.exit(1 if difference or run.returncode != 0 else 0)
