# SPDX-License-Identifier: MIT
"""Tables of columns: numpy alone, and pandas where it is installed."""

from __future__ import annotations

import csv
import io
from typing import Any, Iterator, Mapping, Sequence

import numpy as np


class Table(Mapping[str, np.ndarray]):
    """Columns by name, all as long as each other. `table["time_s"]`, `table.to_pandas()`; len() counts the rows."""

    def __init__(self, columns: Mapping[str, Any]) -> None:
        self._columns = {name: np.asarray(values) for name, values in columns.items()}
        if len({len(values) for values in self._columns.values()}) > 1:
            raise ValueError("columns of different lengths")

    @staticmethod
    def from_rows(rows: Sequence[Mapping[str, Any]], names: Sequence[str] = ()) -> "Table":
        names = list(rows[0]) if rows else list(names)
        return Table({name: np.array([row[name] for row in rows]) for name in names})

    @staticmethod
    def from_csv(text: str) -> "Table":
        """Numbers, booleans and texts are told apart column by column; an empty field among numbers is NaN."""
        lines = list(csv.reader(io.StringIO(text)))
        if not lines:
            return Table({})
        return Table({name: column(name, [line[k] for line in lines[1:]]) for k, name in enumerate(lines[0])})

    @property
    def columns(self) -> list[str]:
        return list(self._columns)

    def rows(self) -> Iterator[dict[str, Any]]:
        for k in range(len(self)):
            yield {name: values[k : k + 1].tolist()[0] for name, values in self._columns.items()}

    def to_pandas(self) -> Any:
        """A pandas.DataFrame."""
        import pandas

        return pandas.DataFrame(self._columns)

    def __getitem__(self, name: str) -> np.ndarray:
        if name not in self._columns:
            raise KeyError(f"{name!r}; the columns are {', '.join(self._columns)}")
        return self._columns[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __contains__(self, name: object) -> bool:
        return name in self._columns

    def __len__(self) -> int:
        return len(next(iter(self._columns.values()), ()))

    def __repr__(self) -> str:
        return f"<banyan.Table: {len(self)} rows of {', '.join(self._columns)}>"

    def _repr_html_(self) -> str:
        try:
            return self.to_pandas()._repr_html_()
        except ImportError:
            return f"<pre>{repr(self)}</pre>"


_texts = ("hash", "git", "version", "run", "name", "study", "part", "error")  # whatever they look like


def column(name: str, cells: list[str]) -> np.ndarray:
    """What texts of a table stand for: booleans, whole numbers, numbers, or themselves."""
    if name in _texts:
        return np.array(cells, dtype=object)
    given = {cell for cell in cells if cell}
    if given and given <= {"true", "false"} and "" not in cells:
        return np.array([cell == "true" for cell in cells])
    for kind, of in ((int, np.int64), (int, np.uint64), (float, np.float64)):
        if kind is int and "" in cells:
            continue
        try:
            return np.array([kind(cell) if cell else np.nan for cell in cells], of)
        except (ValueError, OverflowError):
            continue
    return np.array(cells, dtype=object)


def frame_or_table(table: Table, pandas: bool | None) -> Any:
    """A DataFrame where pandas is installed, unless it says otherwise."""
    if pandas is False:
        return table
    try:
        return table.to_pandas()
    except ImportError:
        if pandas:
            raise
        return table
