"""Small mistakes, one at a time: does a test notice each? mutants.py ROOT [--check] [--only TEXT] [--jobs N]

Reads tests/mutants/mutations.toml. Works on a copy of the tree in build/mutants/ and builds only the rooms that need no
other library and the tests that the list names. Each mutation is written into the copy, the test that is to notice it
is built and run, and must fail. Prints a line for each; exits 1 if a mutation survives, does not compile, or is stale:
its text does not occur exactly once in its file.

--check only looks whether a mutation is stale or names a test that is not there; it builds nothing.
"""

import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tomllib

LIST = "tests/mutants/mutations.toml"
COPIED = ("cmake", "include", "src", "tests", "problems")
KEYS = {"file", "replace", "by", "test", "filter"}
TEST_SECONDS = 300


def read(root):
    with open(root / LIST, "rb") as file:
        return tomllib.load(file)["mutation"]


def summary(mutation):
    """One line that tells mutations apart."""
    texts = (" ".join(mutation[key].split()) for key in ("replace", "by"))
    return f"{mutation['file']}: {' -> '.join(texts)}"


def suites(source):
    """The names of the tests of a file: suite.name."""
    return [".".join(names) for names in re.findall(r"^(?:TEST|TEST_F)\((\w+), (\w+)\)", source, re.MULTILINE)]


def matches(pattern, name):
    """Whether googletest's filter without negative part takes a test."""
    expressions = (re.escape(part).replace(r"\*", ".*").replace(r"\?", ".") for part in pattern.split(":"))
    return any(re.fullmatch(expression, name) for expression in expressions)


def problems(root, mutation):
    """What makes a mutation useless before anything is built."""
    if set(mutation) != KEYS:
        return [f"has the keys {', '.join(sorted(mutation))}, not {', '.join(sorted(KEYS))}"]
    found = []
    path, test = root / mutation["file"], root / "tests" / f"{mutation['test']}.cpp"
    if not path.is_file():
        found.append(f"stale: {mutation['file']} does not exist")
    else:
        count = path.read_text(encoding="utf-8").count(mutation["replace"])
        if count != 1:
            found.append(f"stale: the text to replace occurs {count} times in {mutation['file']}")
    if mutation["replace"] == mutation["by"]:
        found.append("changes nothing")
    if not test.is_file():
        found.append(f"stale: tests/{mutation['test']}.cpp does not exist")
    elif not any(matches(mutation["filter"], name) for name in suites(test.read_text(encoding="utf-8"))):
        found.append(f"stale: no test of tests/{mutation['test']}.cpp is called {mutation['filter']}")
    return found


def check(root, mutations):
    """Prints what is wrong with the list; the number of useless mutations."""
    count = 0
    for mutation in mutations:
        found = problems(root, mutation)
        count += bool(found)
        for problem in found:
            print(f"{LIST}: {summary(mutation) if set(mutation) >= {'file', 'replace', 'by'} else mutation}: {problem}")
    return count


def copy_changed(source, target):
    """Makes target what source is; files that are the same keep their time, so that they are not built again."""
    names = {path.relative_to(source) for path in source.rglob("*") if path.is_file() and "__pycache__" not in path.parts}
    for path in [p for p in target.rglob("*") if p.is_file()]:
        if path.relative_to(target) not in names:
            path.unlink()
    for name in names:
        new, old = (source / name).read_bytes(), target / name
        if not old.is_file() or old.read_bytes() != new:
            old.parent.mkdir(parents=True, exist_ok=True)
            old.write_bytes(new)


class Workshop:
    """The copy of the tree and its build."""

    def __init__(self, root, tests, jobs):
        self.tree, self.build, self.jobs = root / "build/mutants/tree", root / "build/mutants/build", jobs
        for folder in COPIED:
            copy_changed(root / folder, self.tree / folder)
        options = [f"-DTESTS={';'.join(tests)}", "-DCMAKE_BUILD_TYPE=None", "-G", "Ninja"]
        if shutil.which("ccache"):
            options.append("-DCMAKE_CXX_COMPILER_LAUNCHER=ccache")
        self.run(["cmake", "-S", self.tree / "tests/mutants", "-B", self.build, *options]).check_returncode()

    def run(self, command, seconds=None):
        return subprocess.run(command, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=seconds)

    def compile(self, test):
        """What the compiler complains about, or nothing."""
        done = self.run(["cmake", "--build", self.build, "--parallel", str(self.jobs), "--target", test.replace("/", "_")])
        return done.stdout if done.returncode != 0 else ""

    def passes(self, test, pattern):
        """Whether the tests pass, and what they print."""
        command = [self.build / test.replace("/", "_"), f"--gtest_filter={pattern}", "--gtest_brief=1", "--gtest_fail_fast"]
        try:
            done = self.run(command, TEST_SECONDS)
        except subprocess.TimeoutExpired:
            return False, "takes too long"
        if done.returncode == 0 and " 0 tests" in done.stdout:
            raise SystemExit(f"{test}: no test is called {pattern}")
        return done.returncode == 0, done.stdout

    def fate(self, mutation):
        """noticed, survived, or does not compile."""
        path = self.tree / mutation["file"]
        original = path.read_text(encoding="utf-8")
        path.write_text(original.replace(mutation["replace"], mutation["by"]), encoding="utf-8")
        try:
            if self.compile(mutation["test"]):
                return "does not compile"
            passes, _ = self.passes(mutation["test"], mutation["filter"])
            return "survived" if passes else "noticed"
        finally:
            path.write_text(original, encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("root", type=pathlib.Path)
    parser.add_argument("--check", action="store_true", help="build nothing")
    parser.add_argument("--only", default="", help="only mutations whose line contains this")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    arguments = parser.parse_args()
    root = arguments.root.resolve()
    mutations = read(root)
    useless = check(root, mutations)
    if arguments.check:
        print(f"{len(mutations)} mutations, {useless} useless")
        return 1 if useless else 0
    usable = [m for m in mutations if not problems(root, m) and arguments.only in summary(m)]

    workshop = Workshop(root, sorted({m["test"] for m in usable}), arguments.jobs)
    for test, pattern in sorted({(m["test"], m["filter"]) for m in usable}):
        complaint = workshop.compile(test)
        passes, output = (False, complaint) if complaint else workshop.passes(test, pattern)
        if not passes:
            print(f"{test} {pattern} fails without any mutation:\n{output}")
            return 1
    fates = []
    for mutation in usable:
        fates.append(workshop.fate(mutation))
        print(f"{fates[-1]:16}  {summary(mutation)}  [{mutation['test']} {mutation['filter']}]", flush=True)
    noticed = fates.count("noticed")
    print(f"{noticed} noticed, {fates.count('survived')} survived, {fates.count('does not compile')} do not compile, {useless} stale")
    return 0 if noticed == len(fates) and not useless else 1


if __name__ == "__main__":
    sys.exit(main())
