"""Main function of the child process that articulates a mesh for a page, with progress on standard output.

The page's process stays responsive, can end this one at any time, and survives a crash of native code.
"""

from __future__ import annotations

import os
import pickle
import sys
import threading
from pathlib import Path
from typing import IO, Any

from anymesh.errors import AnymeshError
from anymesh.isolation.child import LENGTH, write_message

PARENT_GONE = 1  # exit code if the parent ends


def main() -> None:
    """Read one request (keyword arguments of `articulate`), run it, and write messages.

    These are ("progress", stage, item, done, total), ("mesh", Mesh), then ("done",) or ("error", text).
    """
    replies = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # output of libraries must not mix with the messages
    head = sys.stdin.buffer.read(LENGTH)
    request = pickle.loads(sys.stdin.buffer.read(int.from_bytes(head, "little")))
    finished = threading.Event()
    threading.Thread(target=_end_with_parent, args=(finished,), daemon=True).start()
    try:
        _work(replies, **request)
    except AnymeshError as error:
        write_message(replies, ("error", " ".join(str(error).split())))
    except Exception as error:
        write_message(replies, ("error", f"internal defect, {type(error).__name__}: {' '.join(str(error).split())[:200]}"))
    finally:
        finished.set()  # before the messages end, upon which the parent closes its pipe


def _work(replies: IO[bytes], *, mesh: Path, out: Path, **options: Any) -> None:
    from anymesh import pipeline
    from anymesh.loading import load_mesh, place_mesh

    def progress(stage: str, item: str, done: int, total: int) -> None:
        write_message(replies, ("progress", stage, item, done, total))

    progress("load", mesh.name, 0, 1)
    placing = {name: options[name] for name in ("up", "scale") if name in options}
    placed = place_mesh(load_mesh(mesh, root=options.get("root")), **placing)
    write_message(replies, ("mesh", placed.mesh))
    pipeline.articulate(mesh, out, progress=progress, **options)
    write_message(replies, ("done",))


def _end_with_parent(finished: threading.Event) -> None:
    """End this process when the parent closes the pipe, with an exit code that states whether the work was over."""
    while os.read(sys.stdin.fileno(), 1):  # not through sys.stdin, whose lock would be held when this process ends by itself
        pass
    os._exit(0 if finished.is_set() else PARENT_GONE)
