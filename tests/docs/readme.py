"""Keeps README.md and the pages of docs/notes/ true.

readme.py extract README OUTPUT            writes the C++ example to OUTPUT
readme.py check README EXAMPLE PROGRAM     runs the built example and the shell blocks, and compares their output
readme.py page DOCUMENT PROGRAM            runs the shell blocks, compares their output, and looks for their figures
readme.py features FIRST LAST DOCUMENT...  looks for each feature, F8, F9 or F8–F11, in the text below headings
readme.py refresh DOCUMENT PROGRAM         writes the outputs as they are now into the document, and the figures beside it

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

FEATURE = re.compile(r"\bF(\d+)(?:–F(\d+))?")
FIGURE = re.compile(r"--plot (\S+)")
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
    print(f"the page is wrong about the output of\n{what}\n--- documented\n{expected}--- actual\n{actual}")
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


class Workplace:
    """A folder with a copy of examples/ and the program as build/release/trajet, to run commands in."""

    def __init__(self, root, program):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.temporary.name)
        shutil.copytree(root / "examples", self.folder / "examples")
        release = self.folder / "build/release"
        release.mkdir(parents=True)
        (release / "trajet").symlink_to(pathlib.Path(program).resolve())

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.temporary.cleanup()

    def output(self, command):
        return subprocess.run(command, cwd=self.folder, stdout=subprocess.PIPE, text=True, timeout=60).stdout

    def shell(self, text):
        return self.output(["bash", "-c", text])


def root_of(document):
    """The project's folder: the one above the document that has examples/."""
    return next(folder for folder in pathlib.Path(document).resolve().parents if (folder / "examples").is_dir())


def check(readme, example, program):
    root = root_of(readme)
    results = []
    with Workplace(root, program) as place:
        found = blocks(readme)
        for (language, text), (next_language, expected) in zip(found, found[1:] + [("", "")]):
            documented = next_language == "text"
            if language == "cpp":
                results.append(documented and compare("the C++ example", expected, place.output([example])))
            elif language == "sh" and documented:
                results.append(compare(text, expected, place.shell(text)))
            elif language == "sh":
                results.append(check_setup(root / "Makefile", text))
    return len(results) >= 3 and all(results)


def page(document, program):
    """Whether each command prints what the page says, and draws the figures that the page shows."""
    folder = pathlib.Path(document).parent
    results = []
    with Workplace(root_of(document), program) as place:
        found = blocks(document)
        for (language, text), (next_language, expected) in zip(found, found[1:] + [("", "")]):
            if language != "sh":
                continue
            actual = place.shell(text)
            results.append(next_language != "text" or compare(text, expected, actual))
            for figure in FIGURE.findall(text):
                if not (place.folder / figure).is_file() or not (folder / figure).is_file():
                    print(f"{document}: {figure} is not drawn, or not there")
                    results.append(False)
    return len(results) > 0 and all(results)


def features(first, last, *documents):
    """Whether the documents tell of every feature from the first to the last."""
    told = set()
    for document in documents:
        text = re.sub(r"^#.*$", "", pathlib.Path(document).read_text(encoding="utf-8"), flags=re.M)
        for begin, end in FEATURE.findall(text):
            told.update(range(int(begin), int(end or begin) + 1))
    missing = sorted(set(range(int(first), int(last) + 1)) - told)
    print("not told: " + ", ".join(f"F{number}" for number in missing) if missing else "all are told")
    return not missing


def refresh(document, program):
    path = pathlib.Path(document)
    with Workplace(root_of(document), program) as place:

        def renewed(match):
            command, between, expected = match.groups()
            actual = place.shell(command)
            for figure in FIGURE.findall(command):
                shutil.copy(place.folder / figure, path.parent / figure)
            if expected is None:
                return match[0]
            kept = "…" in expected and compare(command, expected, actual)
            return f"```sh\n{command}```{between}```text\n{expected if kept else actual}```"

        text = re.sub(
            r"^```sh\n(.*?)^```(?:(\s+)```text\n(.*?)^```)?", renewed, path.read_text(encoding="utf-8"), flags=re.M | re.S
        )
    path.write_text(text, encoding="utf-8")
    return True


MODES = {"check": check, "page": page, "features": features, "refresh": refresh}

if __name__ == "__main__":
    if sys.argv[1] == "extract":
        pathlib.Path(sys.argv[3]).write_text(cpp_example(sys.argv[2]), encoding="utf-8")
    else:
        sys.exit(0 if MODES[sys.argv[1]](*sys.argv[2:]) else 1)
