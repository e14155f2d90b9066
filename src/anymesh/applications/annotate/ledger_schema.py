"""Tables of the ledger."""

from __future__ import annotations

VERSION = 1  # of these tables, in the file's `user_version`
OBJECTS = {  # columns of the table of objects, and of its export
    "name": "TEXT",  # unique in the collection
    "source": "TEXT",  # path of the mesh, or objaverse:UID
    "options": "TEXT",  # of this object, JSON
    "folder": "TEXT",  # relative to the output
    "state": "TEXT",  # pending, running, done, waiting or quarantined
    "attempts": "INTEGER",  # attempts that count towards quarantine
    "losses": "INTEGER",  # number of killed runs while it was in progress
    "run": "TEXT",  # current or last run
    "token": "TEXT",  # of the claim; results under another token are rejected
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
    "version": "TEXT",  # of anymesh
    "size": "INTEGER",  # of the mesh [bytes]
    "modified": "INTEGER",  # time of the mesh [ns]
    "redo": "INTEGER",  # 1: the existing asset was made with other options
    "finished": "REAL",  # [s] since 1970
}
ZERO = ("attempts", "losses", "calls", "size", "modified", "redo")
DEFAULTS = {"options": "'{}'", "state": "'pending'", **dict.fromkeys(ZERO, "0")}


def _column(name: str, kind: str) -> str:
    unique = " NOT NULL UNIQUE" if name == "name" else ""
    return f"{name} {kind}{unique}" + (f" NOT NULL DEFAULT {DEFAULTS[name]}" if name in DEFAULTS else "")


SCHEMA = f"""
CREATE TABLE IF NOT EXISTS meta(key TEXT PRIMARY KEY, value TEXT NOT NULL);
CREATE TABLE IF NOT EXISTS objects(seq INTEGER PRIMARY KEY, {", ".join(_column(n, k) for n, k in OBJECTS.items())});
CREATE INDEX IF NOT EXISTS objects_next ON objects(state, attempts, losses, seq);
CREATE INDEX IF NOT EXISTS objects_unsure ON objects(state, confidence);
CREATE TABLE IF NOT EXISTS attempts(seq INTEGER NOT NULL, run TEXT, ended REAL, outcome TEXT, error_class TEXT, error TEXT,
  seconds REAL, memory INTEGER);
CREATE TABLE IF NOT EXISTS runs(run TEXT PRIMARY KEY, host TEXT, pid INTEGER, boot TEXT, beat REAL, begun REAL, ended REAL,
  version TEXT, workers INTEGER);
CREATE TABLE IF NOT EXISTS account(id INTEGER PRIMARY KEY CHECK (id = 1), calls INTEGER NOT NULL, cost REAL NOT NULL);
INSERT OR IGNORE INTO account VALUES(1, 0, 0.0);
CREATE TABLE IF NOT EXISTS holds(id INTEGER PRIMARY KEY, token TEXT, name TEXT, most REAL NOT NULL);
CREATE TABLE IF NOT EXISTS rates(id INTEGER PRIMARY KEY, at REAL NOT NULL, tokens INTEGER NOT NULL);
PRAGMA user_version = {VERSION};
"""
