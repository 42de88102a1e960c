"""Scenes from paths, texts and dicts, and what is changed in them."""

from __future__ import annotations

import errno
import os
import re

from . import _core
from ._document import Document, located
from ._errors import SceneError

# what a run may be told beside the scene
OPTIONS = ("method", "step", "rtol", "atol", "end", "orientation")
# how errors of the reader call what Python has as arguments
OPTION = re.compile(r"--(\w+)(?: (.+))?")
KEYS = {name: name for name in (*OPTIONS, "set", "vary", "sample", "correlate", "count", "design", "hit", "at", "body")}
KEYS |= {"with": "conditions", "minimise": "minimise", "report": "report"}


class Source:
    """A scene with its text, as the page shows it."""

    def __init__(self, scene):
        self._document = None
        if isinstance(scene, dict):
            self._document = Document(scene)
            self.text = self._document.text
            self.scene = self.checked(lambda: _core.parse_scene(self.text, ""))
        elif isinstance(scene, str) and ("\n" in scene or "=" in scene):
            self.text = scene
            self.scene = _core.parse_scene(scene, "<scene>")
        elif isinstance(scene, (str, os.PathLike)):
            path = os.fspath(scene)
            if not os.path.exists(path):
                raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), path)
            with open(path, encoding="utf-8", errors="replace") as file:
                self.text = file.read()
            self.scene = _core.read_scene(path)
        else:
            raise TypeError(f"a scene is a path, the text of a scene or a dict, got {type(scene).__name__}")

    def checked(self, do):
        """What `do()` gives; its errors speak of the dict, and of options as Python writes them."""
        try:
            return do()
        except SceneError as error:
            option = OPTION.fullmatch(error.file or "")
            if option and option[1] in KEYS:
                name = f"[{option[2]!r}]" if option[2] else ""
                raise SceneError(error.message, key=KEYS[option[1]] + name) from None
            if self._document is not None:
                raise located(error, self._document) from None
            raise

    def change(self, set=None, **options):
        """Replaces parameters and keys, and options of the run."""
        overrides = _core.Overrides()
        overrides.parameters = [f"{name}={formula(value)}" for name, value in (set or {}).items()]
        for option, value in options.items():
            if option not in OPTIONS:
                known = ", ".join(OPTIONS)
                raise TypeError(f"unknown option '{option}', expected one of: {known}")
            if value is not None:
                setattr(overrides, option, formula(value))
        self.checked(lambda: _core.apply(overrides, self.scene))
        return self


def formula(value):
    """A number, a vector or a text as the command line takes it."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, str):
        return value
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(formula(each) for each in value) + "]"
    return repr(float(value)) if isinstance(value, float) else str(value)
