"""The ledger of an output: an SQLite file, the only record of all objects, written by one process, the driver of the run.

A killed process loses nothing that was written. After a power failure the last entries may be missing; the objects' folders
then show what was finished.
"""

from __future__ import annotations

import json
import socket
import sqlite3
import time
from collections.abc import Generator, Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from itertools import islice
from pathlib import Path
from typing import Any

from anymesh import __version__
from anymesh.applications.annotate.inputs import ObjectRequest
from anymesh.applications.annotate.states import AttemptOutcome, Job, Result, State
from anymesh.errors import InputError, OutputError

NAME, LOCK = "ledger.sqlite", ".run.lock"
BUSY = 60.0  # [s] to wait for a reader
BATCH = 2000  # rows per transaction
LOSSES = 20  # number of killed runs while working on an object, after which it is quarantined
VERSION = 3  # of the tables below, in the file's `user_version`
OBJECTS = {  # columns of the table of objects, and of its export
    "name": "TEXT",  # unique in the collection
    "source": "TEXT",  # path of the mesh, or objaverse:UID
    "options": "TEXT",  # of this object, JSON
    "folder": "TEXT",  # relative to the output
    "state": "TEXT",  # pending, running, done, waiting or quarantined
    "attempts": "INTEGER",  # attempts that count towards quarantine
    "losses": "INTEGER",  # number of killed runs while it was in progress
    "error_class": "TEXT",
    "error": "TEXT",  # one line
    "stage": "TEXT",  # in which the error occurred
    "seconds": "REAL",  # of the last attempt
    "stage_seconds": "TEXT",  # of its stages, JSON
    "memory": "INTEGER",  # peak resident [bytes] of the last attempt
    "calls": "INTEGER",  # of a model, over all attempts, without cached ones
    "cost": "REAL",  # [USD] over all attempts
    "confidence": "REAL",  # lowest of its joints; null without joints
    "parts": "INTEGER",
    "joints": "INTEGER",
    "faces": "INTEGER",
    "warnings": "INTEGER",
    "bytes": "INTEGER",  # of the asset's files
    "sha256": "TEXT",  # of the mesh
    "license": "TEXT",  # of the mesh, as far as it is stated
    "author": "TEXT",
    "version": "TEXT",  # of anymesh
    "size": "INTEGER",  # of the mesh [bytes]
    "modified": "INTEGER",  # time of the mesh [ns]
    "redo": "INTEGER",  # 1: the existing asset was made with other options
    "finished": "REAL",  # [s] since 1970
}
ZERO = ("attempts", "losses", "calls", "size", "modified", "redo")
CONSTRAINTS = {
    "name": "NOT NULL UNIQUE",
    "options": "NOT NULL DEFAULT '{}'",
    "state": "NOT NULL DEFAULT 'pending'",
    **dict.fromkeys(ZERO, "NOT NULL DEFAULT 0"),
}
COLUMNS = ", ".join(f"{name} {kind} {CONSTRAINTS.get(name, '')}" for name, kind in OBJECTS.items())
SCHEMA = f"""
CREATE TABLE meta(key TEXT PRIMARY KEY, value TEXT NOT NULL);
CREATE TABLE objects(seq INTEGER PRIMARY KEY, {COLUMNS});
CREATE INDEX objects_next ON objects(state, attempts, losses, seq);
CREATE INDEX objects_unsure ON objects(state, confidence);
CREATE TABLE attempts(seq INTEGER NOT NULL, run INTEGER, ended REAL, outcome TEXT, error_class TEXT, error TEXT, seconds REAL,
  memory INTEGER);
CREATE TABLE runs(run INTEGER PRIMARY KEY, host TEXT, begun REAL, ended REAL, version TEXT, workers INTEGER);
PRAGMA user_version = {VERSION};
"""
CREDITED = f"""
ALTER TABLE objects ADD COLUMN license TEXT;
ALTER TABLE objects ADD COLUMN author TEXT;
PRAGMA user_version = {VERSION};
"""
ENTER = """
INSERT INTO objects(name, source, options, folder, state, error_class, error, size, modified) VALUES(?,?,?,?,?,?,?,?,?)
ON CONFLICT(name) DO UPDATE SET source = excluded.source, options = excluded.options, size = excluded.size,
  modified = excluded.modified, state = 'pending', attempts = 0, losses = 0, error_class = excluded.error_class,
  error = excluded.error, redo = redo OR (finished IS NOT NULL AND (options != excluded.options OR source != excluded.source))
WHERE excluded.state = 'pending' AND (options != excluded.options OR source != excluded.source OR size != excluded.size
  OR modified != excluded.modified)
"""
TAKEN = "seq, name, source, folder, options, redo"
TAKE = f"""
UPDATE objects SET state = 'running'
WHERE seq IN (SELECT seq FROM objects WHERE state = 'pending' ORDER BY attempts, losses, seq LIMIT ?) RETURNING {TAKEN}
"""
FINISH = """
UPDATE objects SET state = ?, attempts = attempts + ?, losses = losses + ?, error_class = ?, error = ?, stage = ?, seconds = ?,
  memory = ?, calls = calls + ?, cost = CASE WHEN ? THEN coalesce(cost, 0) + ? ELSE cost END WHERE seq = ?
"""


class Ledger:
    """The open ledger of the output folder `out`. For use by one thread.

    spent: calls and their cost [USD] over all runs; seconds: total time of reading and writing so far [s]; run: number of the
    current run, 0 for a reader.
    """

    def __init__(self, out: Path, connection: sqlite3.Connection) -> None:
        self.out, self.seconds, self.run = out, 0.0, 0
        self._connection = connection
        self.spent: tuple[int, float] = (0, 0.0)

    @classmethod
    def open(cls, out: Path, *, create: bool = False) -> Ledger:
        """Open the ledger in a folder.

        Raise OutputError if there is none, it cannot be read or written, it is damaged, or it has another version.
        """
        path = out / NAME
        if not create and not path.is_file():
            raise OutputError(f"{out} holds no {NAME}; valid is an output of `anymesh annotate INPUT -o {out}`")
        try:
            connection = sqlite3.connect(path, timeout=BUSY, isolation_level=None)
        except sqlite3.Error as error:
            raise OutputError(f"cannot write {path}: {error}") from None
        ledger = cls(out, connection)
        try:
            with ledger._guarded():
                ledger._prepare(create=create)
        except BaseException:
            connection.close()
            raise
        return ledger

    def _prepare(self, *, create: bool) -> None:
        version = self._connection.execute("PRAGMA user_version").fetchone()[0]
        if version != VERSION and not (create and version in (0, 2)):
            raise OutputError(f"{self.out / NAME} has version {version}; valid is {VERSION}: use the anymesh that made it")
        self._connection.execute("PRAGMA synchronous = NORMAL")  # in WAL mode a kill loses nothing
        if version == 0:
            self._connection.execute("PRAGMA journal_mode = WAL")  # `--status` reads while the driver writes
            self._connection.executescript(f"BEGIN IMMEDIATE;{SCHEMA}COMMIT;")
        elif version == 2:
            self._connection.executescript(f"BEGIN IMMEDIATE;{CREDITED}COMMIT;")
        calls, cost = self._connection.execute("SELECT total(calls), total(cost) FROM objects").fetchone()
        self.spent = int(calls), cost

    @contextmanager
    def _guarded(self) -> Generator[None]:
        """Convert SQLite's errors to errors of this package, and measure the time."""
        begin = time.perf_counter()
        try:
            yield
        except sqlite3.Error as error:
            message = " ".join(str(error).split())[:200]
            damaged = any(word in message for word in ("malformed", "not a database", "corrupt", "unsupported file format"))
            raise self._damaged(message) if damaged else OutputError(f"cannot write {self.out / NAME}: {message}") from error
        finally:
            self.seconds += time.perf_counter() - begin

    def _damaged(self, message: str) -> OutputError:
        advice = "move it and its -wal file away and run the same command again: finished assets are kept"
        return OutputError(f"{self.out / NAME} is damaged ({message}); {advice}")

    def check(self) -> None:
        """Raise OutputError if the file is damaged."""
        message = str(self.rows("PRAGMA quick_check(1)")[0][0])
        if message != "ok":
            raise self._damaged(" ".join(message.split())[:200])

    @contextmanager
    def writing(self) -> Generator[sqlite3.Connection]:
        """Open a transaction, which is committed completely or not at all."""
        with self._guarded():
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
        with self._guarded():
            return self._connection.execute(query, values).fetchall()

    def close(self) -> None:
        """Close the file."""
        self._connection.close()

    def __enter__(self) -> Ledger:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def setting(self, key: str, value: str) -> str:
        """Return the value stored under a key, which is `value` if there was none."""
        with self.writing() as connection:
            connection.execute("INSERT OR IGNORE INTO meta VALUES(?, ?)", (key, value))
        return self.rows("SELECT value FROM meta WHERE key = ?", (key,))[0][0]

    def enter(self, requests: Iterable[ObjectRequest]) -> None:
        """Register objects. Those of earlier runs become pending again if their file or their options changed.

        Raise InputError for two objects with the same name.
        """
        names: set[int] = set()
        waiting = iter(requests)
        while batch := list(islice(waiting, BATCH)):
            for request in batch:
                digest = hash(request.name)
                if digest in names:
                    raise InputError(
                        f"found two objects of the name {request.name[:200]!r}; names must be unique (column `name`)"
                    )
                names.add(digest)
            with self.writing() as connection:
                connection.executemany(ENTER, map(_row, batch))

    def reopen(self, *, quarantined: bool) -> None:
        """Set waiting objects to pending, since their questions may be answered, and also quarantined ones if requested."""
        with self.writing() as connection:
            connection.execute("UPDATE objects SET state = 'pending' WHERE state = 'waiting'")
            if quarantined:
                statement = "UPDATE objects SET state = 'pending', attempts = 0, losses = 0 WHERE state = 'quarantined'"
                connection.execute(statement)

    def take(self, count: int) -> list[Job]:
        """Set up to `count` pending objects to running; those that failed or were lost before come last."""
        if count < 1:
            return []
        with self.writing() as connection:
            return [self._job(row) for row in connection.execute(TAKE, (count,)).fetchall()]

    def running(self) -> list[Job]:
        """Return the objects in progress; at the start of a run, those of a run that was killed."""
        return [self._job(row) for row in self.rows(f"SELECT {TAKEN} FROM objects WHERE state = 'running'")]

    def _job(self, row: tuple[Any, ...]) -> Job:
        seq, name, source, folder, options, redo = row
        return Job(seq, name, source, folder, str(self.out), json.loads(options), bool(redo))

    def finish(self, job: Job, outcome: AttemptOutcome, *, most: int, spent: tuple[int, float] = (0, 0.0)) -> State:
        """Record the outcome of an object in progress; return its state.

        most: attempts after which a failing object is quarantined; spent: calls of the attempt and their cost [USD].
        """
        counts, lost = outcome.result in (Result.DONE, Result.REFUSED, Result.FAILED), outcome.result is Result.LOST
        with self.writing() as connection:
            attempts, losses = connection.execute("SELECT attempts, losses FROM objects WHERE seq = ?", (job.seq,)).fetchone()
            state = _next_state(outcome.result, attempts + counts, losses + lost, most)
            error = (outcome.error_class or None, outcome.error or None)
            measured = (outcome.seconds, outcome.memory)
            values = (state, counts, lost, *error, outcome.stage or None, *measured, spent[0], spent[0], spent[1], job.seq)
            connection.execute(FINISH, values)
            if outcome.result is Result.DONE:
                record = {**outcome.record, "version": __version__, "finished": time.time(), "redo": 0}
                assigned = ", ".join(f"{name} = ?" for name in record)
                connection.execute(f"UPDATE objects SET {assigned} WHERE seq = ?", (*record.values(), job.seq))
            attempt = (job.seq, self.run, time.time(), outcome.result, *error, *measured)
            connection.execute("INSERT INTO attempts VALUES(?,?,?,?,?,?,?,?)", attempt)
        self.spent = self.spent[0] + spent[0], self.spent[1] + spent[1]
        return state

    def export_rows(self) -> Iterator[list[tuple[Any, ...]]]:
        """Yield all objects in batches, with the columns of OBJECTS."""
        last, columns = 0, ", ".join(OBJECTS)
        while rows := self.rows(f"SELECT seq, {columns} FROM objects WHERE seq > ? ORDER BY seq LIMIT {BATCH}", (last,)):
            last = rows[-1][0]
            yield [row[1:] for row in rows]


@contextmanager
def driven_ledger(out: Path, workers: int) -> Generator[Ledger]:
    """Open the ledger of an output as its only writer, or a new one, and register a run.

    Raise OutputError if another run works on this output, or as `Ledger.open`.
    """
    with _only_driver(out), Ledger.open(out, create=True) as ledger:
        ledger.check()
        with ledger.writing() as connection:
            values = (socket.gethostname(), time.time(), __version__, workers)
            added = connection.execute("INSERT INTO runs(host, begun, version, workers) VALUES(?,?,?,?)", values)
            ledger.run = added.lastrowid or 0
        try:
            yield ledger
        finally:
            with suppress(OutputError), ledger.writing() as connection:
                connection.execute("UPDATE runs SET ended = ? WHERE run = ?", (time.time(), ledger.run))


@contextmanager
def _only_driver(out: Path) -> Generator[None]:
    """Hold the lock of an output: a transaction on an empty database, which the system ends with the process."""
    try:
        out.mkdir(parents=True, exist_ok=True)
        lock = sqlite3.connect(out / LOCK, timeout=0.0, isolation_level=None)
    except (OSError, sqlite3.Error) as error:
        raise OutputError(f"cannot write {out}: {getattr(error, 'strerror', None) or error}") from None
    try:
        lock.execute("BEGIN EXCLUSIVE")
    except sqlite3.Error as error:
        lock.close()
        if getattr(error, "sqlite_errorname", "") == "SQLITE_BUSY":
            raise OutputError(f"another run works on {out}; valid is one run per output") from None
        raise OutputError(f"cannot write {out / LOCK}: {error}") from None
    try:
        yield
    finally:
        lock.close()


def _row(request: ObjectRequest) -> tuple[str | int | None, ...]:
    refused = bool(request.refusal)
    state, error = ("quarantined", "InputError") if refused else ("pending", None)
    identity = (request.name, request.source, request.options_text, request.folder)
    return (*identity, state, error, request.refusal or None, request.size, request.modified)


def _next_state(result: Result, attempts: int, losses: int, most: int) -> State:
    match result:
        case Result.DONE:
            return State.DONE
        case Result.REFUSED:
            return State.QUARANTINED
        case Result.WAITING:
            return State.WAITING
        case Result.FAILED if attempts >= most:
            return State.QUARANTINED
        case Result.LOST if losses >= LOSSES:
            return State.QUARANTINED
        case _:
            return State.PENDING
