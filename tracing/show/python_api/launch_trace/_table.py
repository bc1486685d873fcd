# SPDX-License-Identifier: Apache-2.0
"""A table in columns, and the ways out of it: NumPy, pandas, polars, Arrow."""

from __future__ import annotations

import html
import importlib
from typing import Any, Iterator, Mapping, NamedTuple, Sequence

SHOWN = 10  # rows in a notebook


def needed(module: str, purpose: str) -> Any:
    """The module, or an error that says what to install."""
    try:
        return importlib.import_module(module)
    except ImportError as error:
        package = module.split('.')[0]
        raise ImportError(f'{purpose} needs {package}, which is not installed: apt install python3-{package}, '
                          f'or pip install {package}') from error


def _numpy() -> Any:
    try:
        return importlib.import_module('numpy')
    except ImportError:
        return None


class Column(NamedTuple):
    values: Any  # a buffer or a list; of texts the places in `words`
    words: Sequence[str] | None = None
    nulls: Any = None  # a buffer with 1 for each row without a value

    def to_list(self) -> list[Any]:
        values = self.values if isinstance(self.values, list) else memoryview(self.values).tolist()
        if self.words is not None:
            words = self.words
            return [None if value < 0 else words[value] for value in values]
        if self.nulls is None:
            return values
        return [None if null else value for value, null in zip(values, memoryview(self.nulls).tolist())]

    def to_numpy(self, numpy: Any) -> Any:
        """Numbers without a copy; a masked array where some are missing; texts as objects."""
        if isinstance(self.values, list):
            if any(value is None or isinstance(value, str) for value in self.values):
                return numpy.array(self.values, dtype=object)
            return numpy.array(self.values)
        values = numpy.asarray(memoryview(self.values))
        if self.words is not None:
            words = numpy.array(list(self.words) + [None], dtype=object)  # -1 is the last one
            return words[values]
        if self.nulls is None or values.dtype.kind == 'f':
            return values
        return numpy.ma.MaskedArray(values, mask=numpy.asarray(memoryview(self.nulls)).view(bool), copy=False)

    def to_pandas(self, numpy: Any, pandas: Any) -> Any:
        if isinstance(self.values, list):
            return pandas.array(self.values) if None in self.values else self.values
        values = numpy.asarray(memoryview(self.values))
        if self.words is not None:
            return pandas.Categorical.from_codes(values, categories=list(self.words))
        if self.nulls is None or values.dtype.kind == 'f':
            return values
        return pandas.arrays.IntegerArray(values, numpy.asarray(memoryview(self.nulls)).view(bool))


class Table:
    """The rows of one kind in a trace. `table['column']` is an array, a loop over it gives each row as a dict."""

    def __init__(self, name: str, columns: Mapping[str, Column], rows: int, help: str = '', stream: Any = None) -> None:
        self.name = name
        self.help = help
        self._columns = dict(columns)
        self._rows = rows
        self._stream = stream

    @property
    def columns(self) -> list[str]:
        return list(self._columns)

    def __len__(self) -> int:
        return self._rows

    def __contains__(self, column: object) -> bool:
        return column in self._columns

    def _column(self, column: str) -> Column:
        if column not in self._columns:
            raise KeyError(f"the table {self.name} has no column '{column}'; it has {', '.join(self._columns)}")
        return self._columns[column]

    def __getitem__(self, column: str) -> Any:
        """An array of NumPy where it is installed, masked where rows have no value. Otherwise a list."""
        numpy = _numpy()
        found = self._column(column)
        return found.to_list() if numpy is None else found.to_numpy(numpy)

    def to_list(self, column: str) -> list[Any]:
        """The values of a column as objects of Python; None where there is none."""
        return self._column(column).to_list()

    def __iter__(self) -> Iterator[dict[str, Any]]:
        names = self.columns
        for row in zip(*(self.to_list(name) for name in names)):
            yield dict(zip(names, row))

    def rows(self, *columns: str) -> list[tuple[Any, ...]]:
        """These columns of all rows; all columns if none is named."""
        return list(zip(*(self.to_list(name) for name in columns or self.columns)))

    def to_pandas(self) -> Any:
        """A DataFrame of pandas, which shares the numbers with this table. Texts are categories."""
        pandas = needed('pandas', 'to_pandas()')
        numpy = needed('numpy', 'to_pandas()')
        columns = {name: column.to_pandas(numpy, pandas) for name, column in self._columns.items()}
        return pandas.DataFrame(columns, copy=False)

    def to_polars(self) -> Any:
        """A DataFrame of polars, which shares the numbers with this table."""
        polars = needed('polars', 'to_polars()')
        if self._stream is not None:
            return polars.DataFrame(self)
        return polars.DataFrame({name: column.to_list() for name, column in self._columns.items()})

    def to_arrow(self) -> Any:
        """A table of pyarrow, which can write it as Parquet."""
        arrow = needed('pyarrow', 'to_arrow()')
        if self._stream is not None:
            return arrow.table(self)
        return arrow.table({name: column.to_list() for name, column in self._columns.items()})

    def __arrow_c_stream__(self, requested_schema: object = None) -> Any:
        """For libraries that know Arrow's PyCapsule interface."""
        if self._stream is None:
            return self.to_arrow().__arrow_c_stream__(requested_schema)
        return self._stream()

    def __repr__(self) -> str:
        return f"<Table {self.name}: {self._rows} rows of {', '.join(self._columns)}>"

    def _repr_html_(self) -> str:
        def cells(kind: str, values: Sequence[Any]) -> str:
            return ''.join(f"<{kind}>{html.escape('' if value is None else str(value))}</{kind}>" for value in values)

        lines = [f"<tr>{cells('th', self.columns)}</tr>"]
        lines += [f"<tr>{cells('td', row)}</tr>" for row in self._first_rows(SHOWN)]
        more = f'<p>{self._rows} rows</p>' if self._rows > SHOWN else ''
        return f"<p><b>{html.escape(self.name)}</b> {html.escape(self.help)}</p><table>{''.join(lines)}</table>{more}"

    def _first_rows(self, count: int) -> list[tuple[Any, ...]]:
        def first(column: Column) -> list[Any]:
            part = [None if some is None else (some if isinstance(some, list) else memoryview(some))[:count]
                    for some in (column.values, column.nulls)]
            return Column(part[0], column.words, part[1]).to_list()

        return list(zip(*(first(column) for column in self._columns.values())))
