"""Keeps README.md and the pages of docs/ true.

readme.py extract DOCUMENT NUMBER OUTPUT        writes the C++ example of that number, from 0, to OUTPUT
readme.py page DOCUMENT PROGRAM [EXAMPLE...]    runs every block that can run, and compares its output; EXAMPLE: the C++
                                                examples as programs, in order
readme.py features FIRST LAST DOCUMENT...       looks for each feature, F8, F9 or F8–F11, in the text below headings
readme.py refresh DOCUMENT PROGRAM              writes the outputs as they are now into the document, and the figures beside it

A ```text block holds the output of the ```cpp or ```sh block before it. In it, `…` stands for any part of a line.
A ```toml block that begins with a line `# NAME.toml` is the file of that name.
Shell blocks run one after the other in a folder that has these files, a copy of examples/, and PROGRAM as
build/release/trajet and on the PATH. A ```sh block without output succeeds; if it consists of `git`, `make` and `cmake`
lines it is not run, but the targets of `make` are in the Makefile. Lines of a ```cmake block stand in the project with
which the installed library is tested.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

FEATURE = re.compile(r"\bF(\d+)(?:–F(\d+))?")
FIGURE = re.compile(r"--plot (\S+)")
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
FILE_NAME = re.compile(r"# ([\w-]+\.toml)\n")
SETUP_COMMANDS = ("git", "make", "cmake")


def blocks(document):
    return BLOCK.findall(pathlib.Path(document).read_text(encoding="utf-8"))


def cpp_examples(document):
    return [text for language, text in blocks(document) if language == "cpp"]


def compare(what, expected, actual):
    """Whether the output is as documented; says what differs."""
    pattern = "[^\n]*".join(re.escape(part) for part in expected.rstrip().split("…"))
    if re.fullmatch(pattern, actual.rstrip()):
        print(f"as documented: {what}")
        return True
    print(f"the page is wrong about the output of\n{what}\n--- documented\n{expected}--- actual\n{actual}")
    return False


def is_setup(text):
    """Whether a block prepares the project: such blocks are not run."""
    commands = [line.split()[0] for line in text.splitlines() if line.strip() and not line.startswith("#")]
    return all(command in SETUP_COMMANDS for command in commands)


def check_setup(makefile, text):
    """Whether a block that is not run names only targets that exist."""
    targets = set(re.findall(r"^([a-z]+):", makefile.read_text(encoding="utf-8"), re.MULTILINE))
    good = True
    for line in text.splitlines():
        words = line.split("#")[0].split()
        if words[:1] == ["make"] and not targets.issuperset(words[1:]):
            print(f"`{line}` is not a target of the Makefile")
            good = False
    return good


def check_project(project, text):
    """Whether the lines of a block of CMake stand in the project that is built against the installed library."""
    known = {line.strip() for line in project.read_text(encoding="utf-8").splitlines()}
    unknown = [line for line in text.splitlines() if line.strip() not in known]
    for line in unknown:
        print(f"{project} does not have the line `{line}`")
    return not unknown


class Workplace:
    """A folder with a copy of examples/ and the program as build/release/trajet, to run commands in."""

    def __init__(self, root, program):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.temporary.name)
        shutil.copytree(root / "examples", self.folder / "examples")
        release = self.folder / "build/release"
        release.mkdir(parents=True)
        (release / "trajet").symlink_to(pathlib.Path(program).resolve())
        # instead of a browser
        browser = self.folder / "bin/xdg-open"
        browser.parent.mkdir()
        browser.write_text("#!/bin/sh\n", encoding="utf-8")
        browser.chmod(0o755)
        path = os.pathsep.join([str(release), str(browser.parent), os.environ["PATH"]])
        self.environment = {**os.environ, "PATH": path, "TMPDIR": str(self.folder)}

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.temporary.cleanup()

    def run(self, command):
        return subprocess.run(
            command, cwd=self.folder, env=self.environment, stdout=subprocess.PIPE, text=True, timeout=60
        )

    def shell(self, text):
        return self.run(["bash", "-c", text])

    def write_file(self, text):
        """Writes a block that names its file."""
        name = FILE_NAME.match(text)
        if name:
            (self.folder / name[1]).write_text(text, encoding="utf-8")


def root_of(document):
    """The project's folder: the one above the document that has examples/."""
    return next(folder for folder in pathlib.Path(document).resolve().parents if (folder / "examples").is_dir())


def check_shell(place, document, text, expected):
    """Whether a block prints what the page says, if it says so, else succeeds; and draws its figures."""
    result = place.shell(text)
    good = compare(text, expected, result.stdout) if expected is not None else result.returncode == 0
    if not good and expected is None:
        print(f"{document}: exit code {result.returncode} of\n{text}")
    for figure in FIGURE.findall(text):
        if not (place.folder / figure).is_file():
            print(f"{document}: {figure} is not drawn")
            good = False
    return good


def page(document, program, *examples):
    root = root_of(document)
    examples = list(examples)
    results = []
    with Workplace(root, program) as place:
        found = blocks(document)
        for (language, text), (next_language, output) in zip(found, found[1:] + [("", "")]):
            expected = output if next_language == "text" else None
            if language == "toml":
                place.write_file(text)
            elif language == "cmake":
                results.append(check_project(root / "tests/install/consumer/CMakeLists.txt", text))
            elif language == "cpp":
                actual = place.run([examples.pop(0)]).stdout if examples else "not built"
                results.append(compare("a C++ example", expected or "", actual))
            elif language == "sh" and expected is None and is_setup(text):
                results.append(check_setup(root / "Makefile", text))
            elif language == "sh":
                results.append(check_shell(place, document, text, expected))
    return len(results) > 0 and all(results) and not examples


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


def without_noise(output):
    """With `…` for what differs from run to run or from machine to machine: times, step counts, rounding."""
    output = re.sub(r"^steps: .*$", "steps: …", output, flags=re.M)
    return re.sub(r"-?\d(\.\d+)?e-1[2-9]\b", "…", output)


def refresh(document, program):
    path = pathlib.Path(document)
    whole = path.read_text(encoding="utf-8")
    with Workplace(root_of(document), program) as place:

        def renewed(match):
            language, text, between, expected = match.groups()
            if language == "toml":
                place.write_file(text)
            if language == "toml" or (expected is None and is_setup(text)):
                return match[0]
            actual = place.shell(text).stdout
            for figure in FIGURE.findall(text):
                if f"]({figure})" in whole:
                    shutil.copy(place.folder / figure, path.parent / figure)
            if expected is None:
                return match[0]
            kept = "…" in expected and compare(text, expected, actual)
            return f"```sh\n{text}```{between}```text\n{expected if kept else without_noise(actual)}```"

        text = re.sub(
            r"^```(toml|sh)\n(.*?)^```(?:(\s+)```text\n(.*?)^```)?",
            renewed,
            whole,
            flags=re.M | re.S,
        )
    path.write_text(text, encoding="utf-8")
    return True


MODES = {"page": page, "features": features, "refresh": refresh}

if __name__ == "__main__":
    if sys.argv[1] == "extract":
        example = cpp_examples(sys.argv[2])[int(sys.argv[3])]
        pathlib.Path(sys.argv[4]).write_text(example, encoding="utf-8")
    else:
        sys.exit(0 if MODES[sys.argv[1]](*sys.argv[2:]) else 1)
