"""Tables of objects with their own options: CSV, or Parquet with the extra `parquet`."""

from __future__ import annotations

import csv
import logging
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

from anymesh.applications.annotate.requests import OBJAVERSE, OPTIONS, ObjectRequest, parse_option
from anymesh.errors import InputError

log = logging.getLogger("anymesh")
TABLES = (".csv", ".parquet")
PATH, UID, NAME = "path", "uid", "name"


def read_table(path: Path) -> Iterator[ObjectRequest]:
    """Yield the objects of a table, one per row.

    Columns: `path` (relative to the table's folder) or `uid` (of Objaverse), `name` (default: the path or id), and those of
    OPTIONS, where an empty cell is the default; others are ignored with a warning. Raise InputError for an invalid table.
    """
    rows = _csv_rows(path) if path.suffix.lower() == ".csv" else _parquet_rows(path)
    checked = False
    for number, row in enumerate(rows, 2):
        if not checked:
            checked = True
            _check_columns(path, row)
        yield _request(path, f"{path.name}, row {number}", row)


def _csv_rows(path: Path) -> Iterator[Mapping[str, str]]:
    try:
        with path.open(newline="", encoding="utf-8-sig") as file:
            for row in csv.DictReader(file, restkey=None):
                yield {str(k).strip(): v or "" for k, v in row.items() if k is not None and not isinstance(v, list)}
    except (csv.Error, UnicodeDecodeError) as error:
        raise InputError(f"{path.name} is not a valid CSV table in UTF-8: {error}") from None


def _parquet_rows(path: Path) -> Iterator[Mapping[str, str]]:
    from anymesh.applications.annotate.parquet_ import read_rows

    return read_rows(path)


def _check_columns(path: Path, row: Iterable[str]) -> None:
    names = set(row)
    if not names & {PATH, UID}:
        columns = ", ".join(sorted(names))[:200]
        raise InputError(f"{path.name}: found the columns {columns}; one of them must be `path` or `uid`")
    unknown = sorted(names - {PATH, UID, NAME, *OPTIONS})
    if unknown:
        log.warning("%s: the columns %s are ignored; options are %s", path.name, ", ".join(unknown)[:200], ", ".join(OPTIONS))


def _request(table: Path, where: str, row: Mapping[str, str]) -> ObjectRequest:
    uid, path = row.get(UID, "").strip(), row.get(PATH, "")
    if not (uid or path):
        raise InputError(f"{where}: found neither a path nor a uid")
    options = {k: parse_option(k, v, where) for k in OPTIONS if (v := row.get(k, "")) != ""}
    source = f"{OBJAVERSE}{uid}" if uid else str((table.parent / path).absolute())
    return ObjectRequest(row.get(NAME, "") or uid or path, source, options)
