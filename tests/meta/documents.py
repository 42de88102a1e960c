"""Checks what documents and comments point to: documents.py ROOT

- A path in README.md or docs/**/*.md, in backticks or a link, that starts with a folder of the project exists.
- A citation [Key1999] in a document or a source file is an entry of docs/references.bib, and every entry is cited.
- Every page of docs/ is linked from its index, docs/README.md.
- No file names a path of somebody's machine.
- The numbering of the notes that trajet started from, F12 or erratum A1, stands in docs/notes/ and in tests only.
Prints each violation as FILE:LINE and exits 1 if there is one.
"""

import pathlib
import re
import sys

SPAN = re.compile(r"`([^`]+)`")
LINK = re.compile(r"\]\(([^)\s]+)\)")
CITATION = re.compile(r"\[([A-Z][A-Za-z]+\d{4}[a-z]?)(?:[,;][^\]]*)?\]")
ENTRY = re.compile(r"^@\w+\{\s*([^,\s]+)", re.MULTILINE)
MACHINE_PATH = re.compile(r"(?<![\w.])/(?:home|root|work|tmp|Users)/")
NOTES_NUMBER = re.compile(r"\bF\d{1,3}\b|\b[Ee]rratum [A-G]\d+")
NUMBERED_FOLDERS = {("docs", "notes"), ("tests",)}
SKIPPED_FOLDERS = {".git", "build", "__pycache__", "node_modules"}
TEXT_SUFFIXES = {".md", ".hpp", ".cpp", ".py", ".toml", ".txt", ".cmake", ".in", ".json", ".bib", ""}


def files(root):
    for path in sorted(root.rglob("*")):
        relative = path.relative_to(root)
        if path.is_file() and path.suffix in TEXT_SUFFIXES and not SKIPPED_FOLDERS & set(relative.parts):
            yield relative


def exists(root, name):
    """Whether a path is there; `<name>` stands for any word and `*` for any part of one."""
    pattern = re.sub(r"<[^>]+>", "*", name).rstrip("/")
    return (root / pattern).exists() if "*" not in pattern else any(root.glob(pattern))


def paths_of_line(root, line):
    """The project paths that a line of a document names."""
    folders = {p.name for p in root.iterdir() if p.is_dir()} - SKIPPED_FOLDERS
    for span in SPAN.findall(line):
        for word in span.split():
            word = word.strip("\"'<>(),;").removesuffix(".")
            if word.startswith("trajet/") and word.endswith(".hpp"):
                word = "include/" + word
            if "/" in word and word.split("/")[0] in folders:
                yield word


def check_document(root, document):
    lines = (root / document).read_text(encoding="utf-8").splitlines()
    for number, line in enumerate(lines, 1):
        for name in paths_of_line(root, line):
            if not exists(root, name) and name != "include/trajet/version.hpp":
                yield f"{document}:{number}: {name} does not exist"
        for target in LINK.findall(line):
            target = target.split("#")[0]
            if target and "://" not in target and not exists(root, str(document.parent / target)):
                yield f"{document}:{number}: the link {target} leads nowhere"


def missing_in_index(root):
    """The pages that docs/README.md does not link, if there is one."""
    index = root / "docs/README.md"
    if not index.is_file():
        return
    linked = {(index.parent / target.split("#")[0]).resolve() for target in LINK.findall(index.read_text(encoding="utf-8"))}
    for page in sorted((root / "docs").rglob("*.md")):
        if page != index and page.resolve() not in linked:
            yield f"docs/README.md: {page.relative_to(root)} is not in the index"


def has_notes_numbers(file):
    """Whether the file may use the numbering of the notes; of other kinds than text for people and code none is looked at."""
    folders = file.parts
    return file.suffix not in (".md", ".hpp", ".cpp", ".toml") or any(
        folders[: len(each)] == each for each in NUMBERED_FOLDERS
    )


def violations(root):
    """Every violation as text, and the number of documents read."""
    root = pathlib.Path(root).resolve()
    found, cited, documents = [], set(), 0
    bibliography = root / "docs/references.bib"
    entries = set(ENTRY.findall(bibliography.read_text(encoding="utf-8"))) if bibliography.is_file() else set()
    for file in files(root):
        if file.suffix == ".md":
            documents += 1
            found += check_document(root, file)
        text = (root / file).read_text(encoding="utf-8", errors="replace")
        for number, line in enumerate(text.splitlines(), 1):
            if MACHINE_PATH.search(line):
                found.append(f"{file}:{number}: a path of one machine")
            if not has_notes_numbers(file) and NOTES_NUMBER.search(line):
                found.append(f"{file}:{number}: a number of the notes outside docs/notes/")
            if file.suffix not in (".md", ".hpp", ".cpp"):
                continue
            for key in CITATION.findall(line):
                cited.add(key)
                if key not in entries:
                    found.append(f"{file}:{number}: [{key}] is not in docs/references.bib")
    found += missing_in_index(root)
    found += [f"docs/references.bib: {key} is cited nowhere" for key in sorted(entries - cited)]
    return found, documents


if __name__ == "__main__":
    problems, count = violations(sys.argv[1])
    print("\n".join(problems) if problems else f"{count} documents point to what exists")
    sys.exit(1 if problems or count == 0 else 0)
