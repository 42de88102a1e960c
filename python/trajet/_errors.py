"""What is wrong with a scene."""

from __future__ import annotations


class SceneError(ValueError):
    """A scene, a formula or an option is wrong: what was expected, and where.

    file, line, column: the place, counted from 1 (columns count bytes); None where there is none.
    key: of a scene that is a dict or of an option the path of the value: `body[0].velocity[2]`, `set['theta']`.
    message: what is wrong, without the place.
    """

    def __init__(self, message, file=None, line=None, column=None, key=None):
        self.message = message
        self.file = file or None
        self.line = line or None
        self.column = column or None
        self.key = key
        place = key or ":".join(str(part) for part in (self.file, self.line, self.column) if part is not None)
        super().__init__(f"{place}: {message}" if place else message)

    def __reduce__(self):
        return type(self), (self.message, self.file, self.line, self.column, self.key)
