"""The Python code of the pages runs as it stands, and prints what they say."""

import contextlib
import io
import re

from conftest import ROOT

BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.M | re.S)


def outputs(page):
    """What each block of Python prints, beside what the page says; one after the other, as a reader runs them."""
    blocks = BLOCK.findall((ROOT / page).read_text(encoding="utf-8"))
    names = {}
    for (language, text), (next_language, expected) in zip(blocks, blocks[1:] + [("", "")]):
        if language != "python":
            continue
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(compile(text, page, "exec"), names)
        yield text, printed.getvalue(), expected if next_language == "text" else None


def test_the_guide_is_true(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    found = list(outputs("docs/python.md"))
    wrong = [f"{text}\n--- printed\n{printed}" for text, printed, expected in found if printed != (expected or "")]
    assert len(found) >= 8 and not wrong, "\n".join(wrong)


def test_the_readme_runs(monkeypatch):
    monkeypatch.chdir(ROOT)
    ((_, printed, _),) = outputs("README.md")
    assert printed.startswith("[0.97")
