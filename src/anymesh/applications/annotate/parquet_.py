"""Parquet tables by pyarrow, the extra `parquet`."""

from __future__ import annotations

import secrets
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from anymesh.errors import InputError, MissingExtraError, pip_install

ROWS = 10_000  # rows per batch in memory


def _pyarrow() -> Any:
    try:
        import pyarrow
        import pyarrow.parquet
    except ImportError:
        message = f"Parquet needs pyarrow, which is not installed; install it with {pip_install('parquet')}"
        raise MissingExtraError(message) from None
    return pyarrow


def read_rows(path: Path) -> Iterator[Mapping[str, str]]:
    """Yield the rows of a table as text; null is "".

    Raise InputError for an invalid table, MissingExtraError without pyarrow.
    """
    arrow = _pyarrow()
    try:
        for batch in arrow.parquet.ParquetFile(path).iter_batches(ROWS):
            for row in batch.to_pylist():
                yield {name: "" if value is None else str(value) for name, value in row.items()}
    except (arrow.ArrowException, OSError) as error:
        raise InputError(f"{path.name} is not a valid Parquet table: {' '.join(str(error).split())[:200]}") from None


def write_rows(path: Path, columns: Mapping[str, str], batches: Iterator[Sequence[Sequence[Any]]]) -> None:
    """Write a table whose columns have the SQLite types TEXT, INTEGER or REAL. Raise MissingExtraError or OSError."""
    arrow = _pyarrow()
    kinds = {"TEXT": arrow.string(), "INTEGER": arrow.int64(), "REAL": arrow.float64()}
    schema = arrow.schema([(name, kinds[kind]) for name, kind in columns.items()])
    temporary = path.with_name(f".{path.name}.{secrets.token_hex(4)}.part")
    try:
        with arrow.parquet.ParquetWriter(temporary, schema, compression="zstd") as writer:
            for rows in batches:
                values = list(zip(*rows, strict=True)) if rows else [()] * len(columns)
                arrays = [arrow.array(column, kind) for column, kind in zip(values, schema.types, strict=True)]
                writer.write_table(arrow.Table.from_arrays(arrays, schema=schema))
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)
