"""The methods of integration."""

from __future__ import annotations

import typing

from . import _core


class Method(typing.NamedTuple):
    """One method of integration."""

    name: str
    aliases: typing.Tuple[str, ...]
    order: int  #: of the global error; 0: chosen from the tolerance
    dense_order: int  #: the error within a step is O(h^(dense_order + 1)); 0: chosen from the tolerance
    control: str  #: `fixed`: needs a step; `adaptive`: meets rtol and atol; `subdivided`: needs a step, and halves it
    known_as: str  #: what others call it
    summary: str


def methods():
    """All methods, in the order of `trajet methods`."""
    return [Method(*each) for each in _core.methods()]
