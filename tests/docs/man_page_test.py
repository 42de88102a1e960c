"""The manual page has every command and every option of the program: man_page_test.py SCRIPT PROGRAM REPORT.md"""

import pathlib
import re
import subprocess
import sys
import tempfile

script, program, report = sys.argv[1:]


def help_of(*command):
    return subprocess.run([program, *command, "--help"], stdout=subprocess.PIPE, text=True, check=True).stdout


with tempfile.TemporaryDirectory() as folder:
    file = pathlib.Path(folder) / "trajet.1"
    subprocess.run([sys.executable, script, program, "1.2.3", report, str(file)], check=True)
    page = file.read_text(encoding="utf-8").replace("\\-", "-")

terms = re.findall(r"^\.TP\n\\fB(.*)\\fR\n(.*)$", page, re.MULTILINE)
told = {word for term, _ in terms for word in re.findall(r"--?[a-z][\w-]*", term.split("trajet ")[0])}
missing = [] if '"trajet 1.2.3"' in page else ["the version"]
commands = re.findall(r"^  ([a-z]\w*)  ", help_of().split("ubcommands:")[1], re.MULTILINE)
for command in commands:
    if f"\n.SS trajet {command}\n" not in page:
        missing.append(command)
    options = re.findall(r"(?<![\w'-])--[a-z][\w-]*", re.sub(r"[^\n]*--help[^\n]*", "", help_of(command)))
    missing += [f"{command} {option}" for option in options if option not in told]
codes = {term for term, _ in terms if term.isdigit()}
if codes != {"0", "2", "3", "4", "5", "130"}:
    missing.append(f"exit codes: {sorted(codes)}")
# an option that was swallowed by the meaning of another one
missing += [f"a meaning without an option: {meaning}" for _, meaning in terms if "   " in meaning]
print("\n".join(f"not in the page: {each}" for each in missing) or f"{len(commands)} commands, {len(told)} options")
sys.exit(1 if missing or len(commands) < 7 or len(told) < 20 else 0)
