"""The ledger of an output: an SQLite file in WAL mode, the only record of all objects.

All processes that open it must be on one machine, since WAL uses shared memory. A killed process loses nothing that was
written. After a power failure the last entries may be missing; the objects' folders then show what was finished.
"""

from __future__ import annotations

import sqlite3
import time
from collections.abc import Generator, Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from anymesh.applications.annotate.ledger_schema import OBJECTS, SCHEMA, VERSION
from anymesh.errors import OutputError

NAME = "ledger.sqlite"
BUSY = 60.0  # [s] to wait for another process that writes
BATCH = 2000  # rows per transaction


class CorruptLedgerError(OutputError):
    """The ledger's file is damaged."""


class Ledger:
    """The open ledger of the output folder `out`. For use by one thread.

    seconds: total time of reading and writing so far [s].
    """

    def __init__(self, out: Path, connection: sqlite3.Connection) -> None:
        self.out, self.seconds = out, 0.0
        self._connection = connection

    @classmethod
    def open(cls, out: Path, *, create: bool = False, check: bool = False) -> Ledger:
        """Open the ledger in a folder; check: verify its integrity first.

        Raise OutputError if there is none, it cannot be written, or it has another version; CorruptLedgerError if it is
        damaged.
        """
        path = out / NAME
        if not create and not path.is_file():
            raise OutputError(f"{out} holds no {NAME}; valid is an output of `anymesh annotate INPUT -o {out}`")
        try:
            if create:
                out.mkdir(parents=True, exist_ok=True)
            connection = sqlite3.connect(path, timeout=BUSY, isolation_level=None)
        except (OSError, sqlite3.Error) as error:
            raise OutputError(f"cannot write {path}: {getattr(error, 'strerror', None) or error}") from None
        ledger = cls(out, connection)
        try:
            ledger._prepare(check=check)
        except BaseException:
            connection.close()
            raise
        return ledger

    def _prepare(self, *, check: bool) -> None:
        with self.guarded():
            if check:
                integrity = self._connection.execute("PRAGMA quick_check(1)").fetchone()[0]
                if integrity != "ok":
                    raise CorruptLedgerError(f"{self.out / NAME} is damaged: {' '.join(str(integrity).split())[:200]}")
            version = self._connection.execute("PRAGMA user_version").fetchone()[0]
            if version not in (0, VERSION):
                raise OutputError(f"{self.out / NAME} has version {version}; valid is {VERSION}: use the anymesh that made it")
            self._connection.execute("PRAGMA synchronous = NORMAL")  # in WAL mode a kill loses nothing
            if version == 0:
                self._create()

    def _create(self) -> None:
        """Create the tables, retrying because SQLite does not wait for other processes when the journal mode changes."""
        end = time.monotonic() + BUSY
        while True:
            try:
                self._connection.execute("PRAGMA journal_mode = WAL")
                self._connection.executescript(f"BEGIN IMMEDIATE;{SCHEMA}COMMIT;")
                return
            except sqlite3.OperationalError as error:
                if self._connection.in_transaction:
                    self._connection.execute("ROLLBACK")
                if "locked" not in str(error) or time.monotonic() > end:
                    raise
                time.sleep(0.05)

    @contextmanager
    def guarded(self) -> Generator[None]:
        """Convert SQLite's errors to errors of this package, and measure the time."""
        begin = time.perf_counter()
        try:
            yield
        except sqlite3.Error as error:
            message = " ".join(str(error).split())[:200]
            corrupt = ("malformed", "not a database", "corrupt", "unsupported file format")
            if isinstance(error, sqlite3.DatabaseError) and any(word in message for word in corrupt):
                raise CorruptLedgerError(f"{self.out / NAME} is damaged: {message}") from None
            raise OutputError(f"cannot write {self.out / NAME}: {message}") from error
        finally:
            self.seconds += time.perf_counter() - begin

    @contextmanager
    def writing(self) -> Generator[sqlite3.Connection]:
        """Open a transaction, which is committed completely or not at all."""
        with self.guarded():
            self._connection.execute("BEGIN IMMEDIATE")
            try:
                yield self._connection
                self._connection.execute("COMMIT")
            except BaseException:
                with suppress(sqlite3.Error):
                    self._connection.execute("ROLLBACK")
                raise

    def rows(self, query: str, values: Sequence[Any] = ()) -> list[tuple[Any, ...]]:
        """Return all rows of a query."""
        with self.guarded():
            return self._connection.execute(query, values).fetchall()

    def close(self) -> None:
        """Close the file."""
        self._connection.close()

    def __enter__(self) -> Ledger:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def setting(self, key: str, value: str | None = None) -> str | None:
        """Return the value stored under a key; with `value`, store it first if there was none."""
        if value is not None:
            with self.writing() as connection:
                connection.execute("INSERT OR IGNORE INTO meta VALUES(?, ?)", (key, value))
        rows = self.rows("SELECT value FROM meta WHERE key = ?", (key,))
        return rows[0][0] if rows else None

    def export_rows(self) -> Iterator[list[tuple[Any, ...]]]:
        """Yield all objects in batches, with the columns of OBJECTS."""
        last, columns = 0, ", ".join(OBJECTS)
        while rows := self.rows(f"SELECT seq, {columns} FROM objects WHERE seq > ? ORDER BY seq LIMIT {BATCH}", (last,)):
            last = rows[-1][0]
            yield [row[1:] for row in rows]
