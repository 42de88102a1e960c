"""Scenes that are dicts, as the text that the reader of scene files reads."""

from __future__ import annotations

import bisect
import json
import math
import numbers
import os
import re

from ._errors import SceneError

BARE_KEY = re.compile(r"[A-Za-z0-9_-]+")
LARGEST_INTEGER = 2**63


class Document:
    """The text of a dict, a line for each of its keys, and what stands where."""

    def __init__(self, scene):
        self._lines = ["", ""]  # the first line is the place of what concerns the whole scene
        self._places = []  # (line, column) in the text, from 1, of each value and key, in order
        self._paths = []
        self._table(scene)
        self.text = "\n".join(self._lines) + "\n"

    def path(self, line, column):
        """The path of the value that stands there: `body[0].velocity[2]`."""
        at = bisect.bisect_right(self._places, (line, column)) - 1
        return self._paths[at] if at >= 0 else ""

    def _write(self, text):
        self._lines[-1] += text

    def _mark(self, path):
        self._places.append((len(self._lines), len(self._lines[-1]) + 1))
        self._paths.append(path)

    def _table(self, table):
        """The root: a line for each key."""
        for key, value in table.items():
            path = self._key(key, "")
            self._value(value, path)
            self._lines.append("")

    def _key(self, key, parent):
        if not isinstance(key, str):
            raise TypeError(f"{parent or 'the scene'}: keys are strings, got {key!r}")
        path = f"{parent}.{key}" if parent else key
        self._mark(path)
        self._write((key if BARE_KEY.fullmatch(key) else _string(key)) + " = ")
        return path

    def _value(self, value, path):
        self._mark(path)
        if hasattr(value, "tolist"):  # of NumPy
            value = value.tolist()
        if isinstance(value, bool):
            self._write("true" if value else "false")
        elif isinstance(value, str):
            self._write(_string(value))
        elif isinstance(value, os.PathLike):
            self._write(_string(os.fspath(value)))
        elif isinstance(value, numbers.Integral) and abs(int(value)) < LARGEST_INTEGER:
            self._write(str(int(value)))
        elif isinstance(value, numbers.Real):
            self._write(_number(float(value)))
        elif isinstance(value, dict):
            self._write("{")
            for i, (key, each) in enumerate(value.items()):
                self._write(", " if i else "")
                self._value(each, self._key(key, path))
            self._write("}")
        elif isinstance(value, (list, tuple)):
            self._write("[")
            for i, each in enumerate(value):
                self._write(", " if i else "")
                self._value(each, f"{path}[{i}]")
            self._write("]")
        else:
            raise TypeError(f"{path}: a number, a text, a list or a dict expected, got {value!r}")


def _string(text):
    """As a TOML string; what is not ASCII escaped, so that columns count the same everywhere."""
    escaped = json.dumps(text)  # JSON writes pairs of surrogates where TOML has one code
    pairs = re.compile(r"\\ud[89ab][0-9a-f]{2}\\ud[c-f][0-9a-f]{2}")
    escaped = pairs.sub(lambda pair: f"\\U{ord(json.loads(chr(34) + pair[0] + chr(34))):08x}", escaped)
    return escaped.replace("\x7f", "\\u007f")


def _number(value):
    if math.isnan(value):
        return "nan"
    if math.isinf(value):
        return "inf" if value > 0 else "-inf"
    text = repr(value)
    return text if re.search(r"[.e]", text) else text + ".0"


def located(error, document):
    """The error of a document's text as one of the dict, by the path of what is wrong."""
    if error.line is None:
        return error
    return SceneError(error.message, key=document.path(error.line, error.column) or "the scene")
