"""Claims of objects by runs. Claims of a dead run are freed, and its late results are rejected.

A run is alive while it holds the lock on its file in `runs/`, which the system frees when the process ends for any reason, and
while it renews its beat, by a monotonic clock. So nothing depends on the time of day.
"""

from __future__ import annotations

import json
import os
import secrets
import socket
import sqlite3
import time
from collections.abc import Generator
from contextlib import contextmanager, suppress
from pathlib import Path

from anymesh import __version__
from anymesh.applications.annotate.ledger import Ledger
from anymesh.applications.annotate.states import AttemptOutcome, Claim, Result, State
from anymesh.errors import OutputError
from anymesh.pipeline.storage.atomic_folder import locked, locks_known

RUNS = "runs"  # folder of the lock files
LEASE = 120.0  # [s] without a beat after which a run that holds its lock counts as stuck
LOSSES = 20  # number of killed runs while working on an object, after which it is quarantined
RUNNING = f"state = '{State.RUNNING}' AND run = ?"
CLAIM = f"""
UPDATE objects SET state = 'running', run = ?, token = ? || '.' || seq || '.' || losses || '.' || attempts || '.' || ?
WHERE seq IN (SELECT seq FROM objects WHERE state = '{State.PENDING}' ORDER BY attempts, losses, seq LIMIT ?)
RETURNING seq, name, source, options, folder, token, redo
"""
FINISH = """
UPDATE objects SET state = ?, attempts = attempts + ?, losses = losses + ?, error_class = ?, error = ?, stage = ?, seconds = ?,
  memory = ?, token = NULL WHERE seq = ? AND token = ?
"""


def boot_id() -> str:
    """Return an id of this boot of the machine; the clock of the beats restarts with each boot."""
    with suppress(OSError):
        return Path("/proc/sys/kernel/random/boot_id").read_text().strip()
    return socket.gethostname()


@contextmanager
def begun_run(ledger: Ledger, workers: int) -> Generator[str]:
    """Register a run and hold its lock; yield its name. At the end, its claims become pending again."""
    run = secrets.token_hex(6)
    lock = ledger.out / RUNS / f"{run}.lock"
    try:
        lock.parent.mkdir(exist_ok=True)
        lock.touch()
    except OSError as error:
        raise OutputError(f"cannot write {lock}: {error.strerror or error}") from None
    with locked(lock):
        with ledger.writing() as connection:
            values = (run, socket.gethostname(), os.getpid(), boot_id(), time.monotonic(), time.time(), __version__, workers)
            columns = "run, host, pid, boot, beat, begun, version, workers"
            connection.execute(f"INSERT INTO runs({columns}) VALUES(?,?,?,?,?,?,?,?)", values)
        try:
            yield run
        finally:
            with suppress(OutputError):  # else the next run frees them
                with ledger.writing() as connection:
                    connection.execute(f"UPDATE objects SET state = 'pending', token = NULL WHERE {RUNNING}", (run,))
                _end(ledger, run)


def _end(ledger: Ledger, run: str) -> None:
    with ledger.writing() as connection:
        connection.execute("UPDATE runs SET ended = ? WHERE run = ?", (time.time(), run))
    with suppress(OSError):
        (ledger.out / RUNS / f"{run}.lock").unlink()


def renew(ledger: Ledger, run: str) -> None:
    """Renew the beat of a run."""
    with ledger.writing() as connection:
        connection.execute("UPDATE runs SET beat = ? WHERE run = ?", (time.monotonic(), run))


def claim(ledger: Ledger, run: str, count: int) -> list[Claim]:
    """Claim up to `count` pending objects; those that failed or were lost before come last."""
    if count < 1:
        return []
    with ledger.writing() as connection:
        rows = connection.execute(CLAIM, (run, run, secrets.token_hex(4), count)).fetchall()
    return [Claim(s, name, src, json.loads(o), folder, token, bool(redo)) for s, name, src, o, folder, token, redo in rows]


def finish(ledger: Ledger, taken: Claim, outcome: AttemptOutcome, *, most: int) -> State | None:
    """Record the outcome of a claimed object; return its state, None if the claim was no longer valid.

    most: attempts after which a failing object is quarantined.
    """
    with ledger.writing() as connection:
        held = connection.execute("SELECT attempts, losses FROM objects WHERE seq = ? AND token = ?", (taken.seq, taken.token))
        before = held.fetchone()
        _charge_holds(connection, taken)
        if before is None:
            return None
        counts = outcome.result in (Result.DONE, Result.REFUSED, Result.FAILED)
        lost = outcome.result is Result.LOST
        state = _next_state(outcome, before[0] + counts, before[1] + lost, most)
        values = (outcome.error_class or None, outcome.error or None, outcome.stage or None, outcome.seconds, outcome.memory)
        connection.execute(FINISH, (state, counts, lost, *values, taken.seq, taken.token))
        if outcome.result is Result.DONE:
            record = {**outcome.record, "version": __version__, "finished": time.time(), "redo": 0}
            assigned = ", ".join(f"{name} = ?" for name in record)
            connection.execute(f"UPDATE objects SET {assigned} WHERE seq = ?", (*record.values(), taken.seq))
        attempt = (taken.seq, taken.token.partition(".")[0], time.time(), outcome.result, *values[:2], *values[3:])
        connection.execute("INSERT INTO attempts VALUES(?,?,?,?,?,?,?,?)", attempt)
    return state


def _charge_holds(connection: sqlite3.Connection, taken: Claim) -> None:
    """Charge calls that were in progress when their process ended at their upper bound, since they may be billed."""
    execute = connection.execute
    count, cost = execute("SELECT count(*), total(most) FROM holds WHERE token = ?", (taken.token,)).fetchone()
    if count:
        execute("UPDATE account SET calls = calls + ?, cost = cost + ?", (count, cost))
        execute("UPDATE objects SET calls = calls + ?, cost = coalesce(cost, 0) + ? WHERE seq = ?", (count, cost, taken.seq))
        execute("DELETE FROM holds WHERE token = ?", (taken.token,))


def _next_state(outcome: AttemptOutcome, attempts: int, losses: int, most: int) -> State:
    match outcome.result:
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


def free_lost(ledger: Ledger, run: str) -> int:
    """Free the claims of dead runs; return the number of objects."""
    freed = 0
    for other in _open_runs(ledger, run):
        if _is_alive(ledger, other):
            continue
        for seq, name, token in ledger.rows(f"SELECT seq, name, token FROM objects WHERE {RUNNING}", (other,)):
            message = f"the run that worked on it ended {LOSSES} times unexpectedly (killed, out of memory, power failure?)"
            lost = AttemptOutcome(Result.LOST, "LostError", message)
            freed += finish(ledger, Claim(seq, name, "", {}, "", token, False), lost, most=1) is not None
        _end(ledger, other)
    return freed


def _open_runs(ledger: Ledger, run: str) -> list[str]:
    return [other for (other,) in ledger.rows("SELECT run FROM runs WHERE ended IS NULL AND run != ?", (run,))]


def live_runs(ledger: Ledger, run: str) -> int:
    """Count the other runs that work on this output."""
    return sum(_is_alive(ledger, other) for other in _open_runs(ledger, run))


def _is_alive(ledger: Ledger, run: str) -> bool:
    lock = ledger.out / RUNS / f"{run}.lock"
    if locks_known():
        if not lock.exists():
            return False
        with locked(lock) as free:
            if free:
                return False
    rows = ledger.rows("SELECT boot, beat FROM runs WHERE run = ?", (run,))
    return bool(rows) and rows[0][0] == boot_id() and time.monotonic() - rows[0][1] < LEASE
