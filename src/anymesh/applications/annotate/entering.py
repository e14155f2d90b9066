"""Registration of objects in the ledger, repeated by every run."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import islice

from anymesh.applications.annotate.ledger import BATCH, Ledger
from anymesh.applications.annotate.requests import ObjectRequest
from anymesh.errors import InputError

ENTER = """
INSERT INTO objects(name, source, options, folder, state, error_class, error, size, modified) VALUES(?,?,?,?,?,?,?,?,?)
ON CONFLICT(name) DO UPDATE SET source = excluded.source, options = excluded.options, size = excluded.size,
  modified = excluded.modified, state = 'pending', attempts = 0, losses = 0, error_class = excluded.error_class,
  error = excluded.error, redo = redo OR (finished IS NOT NULL AND (options != excluded.options OR source != excluded.source))
WHERE state != 'running' AND excluded.state = 'pending' AND (options != excluded.options OR source != excluded.source
  OR size != excluded.size OR modified != excluded.modified)
"""  # an object in progress is not changed; the next run registers its change


def enter_objects(ledger: Ledger, requests: Iterable[ObjectRequest]) -> int:
    """Register objects; return their number.

    Registered objects are unchanged unless their file or options changed; then they become pending again. Raise InputError for
    two objects with the same name.
    """
    names: set[int] = set()
    waiting, count = iter(requests), 0
    while batch := list(islice(waiting, BATCH)):
        for request in batch:
            digest = hash(request.name)
            if digest in names:
                raise InputError(f"found two objects of the name {request.name[:200]!r}; names must be unique (column `name`)")
            names.add(digest)
        count += len(batch)
        with ledger.writing() as connection:
            connection.executemany(ENTER, map(_row, batch))
    return count


def _row(request: ObjectRequest) -> tuple[str | int | None, ...]:
    refused = bool(request.refusal)
    state, error = ("quarantined", "InputError") if refused else ("pending", None)
    identity = (request.name, request.source, request.options_text, request.folder)
    return (*identity, state, error, request.refusal or None, request.size, request.modified)
