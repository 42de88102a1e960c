"""Columns as structured arrays."""

from __future__ import annotations

import numpy as np


def table(columns):
    """One record a row. Texts are as wide as the longest."""
    fields = []
    for name, values in columns.items():
        if isinstance(values, list):
            fields.append((name, f"U{max([len(each) for each in values], default=0) or 1}"))
        else:
            fields.append((name, values.dtype, values.shape[1:]))
    count = len(next(iter(columns.values()))) if columns else 0
    rows = np.empty(count, dtype=fields)
    for name, values in columns.items():
        rows[name] = values
    return rows


def columns(rows):
    """The fields of a structured array as one-dimensional columns by name, as `pandas.DataFrame` takes them.

    A vector becomes `NAME_x`, `NAME_y`, `NAME_z`, a quaternion `NAME_w` … `NAME_z`, a matrix `NAME_11` … `NAME_33`.
    """
    result = {}
    for name in rows.dtype.names:
        values = rows[name]
        if values.ndim == 1:
            result[name] = values
        elif values.ndim == 2:
            for letter, column in zip("wxyz"[-values.shape[1] :], values.T):
                result[f"{name}_{letter}"] = column
        else:
            for i in range(values.shape[1]):
                for j in range(values.shape[2]):
                    result[f"{name}_{i + 1}{j + 1}"] = values[:, i, j]
    return result
