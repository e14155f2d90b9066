"""Recovery of a damaged ledger: it is moved away, and its readable content is copied to a new one."""

from __future__ import annotations

import logging
import sqlite3
from contextlib import closing, suppress
from pathlib import Path
from typing import Any

from anymesh.applications.annotate.ledger import NAME, CorruptLedgerError, Ledger
from anymesh.applications.annotate.ledger_schema import OBJECTS
from anymesh.errors import OutputError

log = logging.getLogger("anymesh")
STEP = 500  # rows read at a time


def open_ledger(out: Path) -> Ledger:
    """Open the ledger of an output, or a new one in place of a damaged one. Raise OutputError if this fails.

    Unreadable objects are registered again with the collection; an asset that exists in its folder is not made again.
    """
    try:
        return Ledger.open(out, create=True, check=True)
    except CorruptLedgerError as error:
        aside = _put_aside(out)
        log.warning("%s; it is kept as %s, and its readable content is recovered", error, aside.name)
        ledger = Ledger.open(out, create=True)
        rescued = _take_over(ledger, aside)
        log.warning("%d objects were recovered from the damaged ledger", rescued)
        return ledger


def _put_aside(out: Path) -> Path:
    number = 1 + sum(1 for _ in out.glob("ledger.damaged-*.sqlite"))
    aside = out / f"ledger.damaged-{number}.sqlite"
    try:
        for ending in ("-wal", "-shm", ""):  # the write-ahead log may hold content that the file lacks
            with suppress(FileNotFoundError):
                (out / f"{NAME}{ending}").rename(f"{aside}{ending}")
    except OSError as error:
        raise OutputError(f"cannot put aside the damaged {out / NAME}: {error.strerror or error}") from None
    return aside


def _take_over(ledger: Ledger, aside: Path) -> int:
    names = list(OBJECTS)
    put = f"INSERT OR IGNORE INTO objects({', '.join(names)}) VALUES({', '.join('?' * len(names))})"
    count = 0
    with closing(sqlite3.connect(aside, isolation_level=None)) as damaged:
        for table, query in (("meta", "SELECT key, value FROM meta"), ("account", "SELECT id, calls, cost FROM account")):
            marks = "?, ?" if table == "meta" else "?, ?, ?"
            rows = []
            with suppress(sqlite3.Error):
                rows = damaged.execute(query).fetchall()
            with ledger.writing() as connection:
                connection.executemany(f"INSERT OR REPLACE INTO {table} VALUES({marks})", rows)
        last = _last_row(damaged)
        for first in range(1, last + 1, STEP):
            rows = _readable(damaged, names, first, min(first + STEP - 1, last))
            with ledger.writing() as connection:
                connection.executemany(put, rows)
            count += len(rows)
    with ledger.writing() as connection:
        connection.execute("UPDATE objects SET state = 'pending', token = NULL WHERE state = 'running'")
        connection.execute("UPDATE account SET cost = max(cost, (SELECT total(cost) FROM objects))")
    return count


def _last_row(damaged: sqlite3.Connection) -> int:
    for query in ("SELECT max(seq) FROM objects", "SELECT count(*) FROM objects"):
        with suppress(sqlite3.Error):
            return int(damaged.execute(query).fetchone()[0] or 0)
    return 0


def _readable(damaged: sqlite3.Connection, names: list[str], first: int, last: int) -> list[tuple[Any, ...]]:
    """Return the readable rows from first to last, bisecting unreadable ranges down to single rows."""
    query = f"SELECT {', '.join(names)} FROM objects NOT INDEXED WHERE seq BETWEEN ? AND ?"
    try:
        rows = damaged.execute(query, (first, last)).fetchall()
        return [row for row in rows if isinstance(row[0], str)]
    except sqlite3.Error:
        if first == last:
            return []
    middle = (first + last) // 2
    return _readable(damaged, names, first, middle) + _readable(damaged, names, middle + 1, last)
