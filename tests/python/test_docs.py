"""The code of docs/python.md runs as it stands, and prints what the page says."""

import contextlib
import io
import re

from conftest import ROOT

BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.M | re.S)


def test_the_page_is_true(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    blocks = BLOCK.findall((ROOT / "docs/python.md").read_text(encoding="utf-8"))
    names, wrong, count = {}, [], 0
    for (language, text), (next_language, expected) in zip(blocks, blocks[1:] + [("", "")]):
        if language != "python":
            continue
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(compile(text, "docs/python.md", "exec"), names)  # one after the other, as a reader does
        count += 1
        if printed.getvalue() != (expected if next_language == "text" else ""):
            wrong.append(f"{text}\n--- printed\n{printed.getvalue()}")
    assert count >= 8 and not wrong, "\n".join(wrong)
