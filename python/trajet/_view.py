"""The page that plays a motion."""

from __future__ import annotations

import html

from . import _core
from ._motion import Motion, run


class Page:
    """A self-contained HTML page: a 3-D animation and plots. A notebook shows it; `save` writes it to a file."""

    def __init__(self, text):
        self.html = text

    def save(self, path):
        """Writes the page to a file, for any browser."""
        with open(path, "w", encoding="utf-8") as file:
            file.write(self.html)

    def _repr_html_(self):
        # a frame of its own: the page is a whole document
        return f'<iframe srcdoc="{html.escape(self.html)}" width="100%" height="600" style="border: 0"></iframe>'

    def __repr__(self):
        return f"<trajet.Page of {len(self.html)} characters>"


def view(scene, *others, **options):
    """The page of a motion: of one that `run` gave, or of a scene, which is run with the options of `run`.

    others: further motions, shown beside the first as ghosts. OSError where trajet was built without the page.
    """
    motion = scene if isinstance(scene, Motion) else run(scene, **options)
    if motion is scene and options:
        raise TypeError("options are for scenes that are going to run, and the motion is there already")
    return Page(_core.page([each._core for each in (motion, *others)], motion._source.text))
