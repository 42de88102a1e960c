"""Keeps README.md true.

readme.py extract README OUTPUT            writes the C++ example to OUTPUT
readme.py check README EXAMPLE PROGRAM     runs the built example and the shell blocks, and compares their output

A ```text block holds the output of the ```cpp or ```sh block before it. In it, `…` stands for any part of a line.
Shell blocks run in a folder that has a copy of examples/ and PROGRAM as build/release/trajet. A ```sh block without
output may hold `git` lines, and `make` lines whose targets the Makefile has; these are not run.
"""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def blocks(readme):
    return BLOCK.findall(pathlib.Path(readme).read_text(encoding="utf-8"))


def cpp_example(readme):
    (example,) = [text for language, text in blocks(readme) if language == "cpp"]
    return example


def compare(what, expected, actual):
    """Whether the output is as documented; says what differs."""
    pattern = "[^\n]*".join(re.escape(part) for part in expected.rstrip().split("…"))
    if re.fullmatch(pattern, actual.rstrip()):
        print(f"as documented: {what}")
        return True
    print(f"README.md is wrong about the output of\n{what}\n--- documented\n{expected}--- actual\n{actual}")
    return False


def check_setup(makefile, text):
    """Whether a block that is not run names only targets that exist."""
    targets = set(re.findall(r"^([a-z]+):", makefile.read_text(encoding="utf-8"), re.MULTILINE))
    good = True
    for line in text.splitlines():
        words = line.split("#")[0].split()
        if words and words[0] != "git" and (words[0] != "make" or not targets.issuperset(words[1:])):
            print(f"README.md: `{line}` is not run by this test, nor a target of the Makefile")
            good = False
    return good


def check(readme, example, program):
    root = pathlib.Path(readme).resolve().parent
    results = []
    with tempfile.TemporaryDirectory() as folder:
        shutil.copytree(root / "examples", pathlib.Path(folder) / "examples")
        release = pathlib.Path(folder) / "build/release"
        release.mkdir(parents=True)
        (release / "trajet").symlink_to(pathlib.Path(program).resolve())

        def output(command):
            return subprocess.run(command, cwd=folder, stdout=subprocess.PIPE, text=True, timeout=60).stdout

        found = blocks(readme)
        for (language, text), (next_language, expected) in zip(found, found[1:] + [("", "")]):
            documented = next_language == "text"
            if language == "cpp":
                results.append(documented and compare("the C++ example", expected, output([example])))
            elif language == "sh" and documented:
                results.append(compare(text, expected, output(["bash", "-c", text])))
            elif language == "sh":
                results.append(check_setup(root / "Makefile", text))
    return len(results) >= 3 and all(results)


if __name__ == "__main__":
    if sys.argv[1] == "extract":
        pathlib.Path(sys.argv[3]).write_text(cpp_example(sys.argv[2]), encoding="utf-8")
    else:
        sys.exit(0 if check(*sys.argv[2:5]) else 1)
