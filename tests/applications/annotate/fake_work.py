"""What worker processes run in these tests: the real work, but a fake `articulate` that does what the mesh's file says."""

from __future__ import annotations

import errno
import hashlib
import json
import os
import signal
import sys
import time
import types
from pathlib import Path
from typing import Any

from anymesh.applications.annotate import work
from anymesh.errors import InputError, ModelError, OpenQuestionError, OutputError
from anymesh.pipeline.options import Limit
from anymesh.prompted.models.retry import UnavailableError


def _finish(out: Path, mesh: Path, force: bool) -> None:
    if out.exists() and not force:
        raise OutputError(f"{out} is not empty")
    new = out.with_name(f".{out.name}.tmp-{os.getpid()}")
    new.mkdir()
    parts = [{"face_count": 12}, {"face_count": 2}]
    source = {"sha256": hashlib.sha256(mesh.read_bytes()).hexdigest()}
    confidence = int(source["sha256"][:4], 16) / 0xFFFF
    asset = {"joints": [{"confidence": confidence}], "parts": parts, "warnings": [], "source": source, "timing": "timing.json"}
    (new / "asset.json").write_text(json.dumps(asset))
    (new / "timing.json").write_text('{"load": 0.1}')
    if out.exists():
        out.rename(out.with_name(f".{out.name}.old-{os.getpid()}"))
    new.rename(out)


def articulate(mesh: Path, out: Path, *, force: bool = False, **options: Any) -> None:
    """Do what the first word of the file says; the trace has a line for each object that is finished."""
    mesh, out = Path(mesh), Path(out)
    collection = out.parents[2]
    what, _, value = mesh.read_text().partition(" ")
    account = options.get("spent")
    match what:
        case "crash":
            os.kill(os.getpid(), signal.SIGSEGV)
        case "once" if not (collection / f"once-{value}").exists():
            (collection / f"once-{value}").touch()
            os.kill(os.getpid(), signal.SIGKILL)
        case "hang":
            time.sleep(60)
        case "eat":
            bytearray(1 << 40)
        case "defect":
            raise ZeroDivisionError("no legs, key sk-0123456789abcdefghijklmnopqrstuv")
        case "bad":
            raise InputError("the mesh has no extent")
        case "full":
            raise OutputError(f"cannot write {out}: No space left on device") from OSError(errno.ENOSPC, "full")
        case "down" if not (collection / "up").exists():
            raise UnavailableError("openai:gpt-4o: HTTP 503; gave up after 5 attempts")
        case "refused":
            raise ModelError("openai:gpt-4o: HTTP 401, the key in OPENAI_API_KEY is missing or refused")
        case "open" if not (collection / "answered").exists():
            raise OpenQuestionError("a question waits", [out / "q"])
        case "pay":
            hold = account.hold("marks", 0.5, Limit(options.get("max_calls"), options.get("max_cost")))
            if value == "lost":
                os.kill(os.getpid(), signal.SIGKILL)
            account.settle(hold, 0.1)
        case "slow":
            time.sleep(float(value or 0.05))
    _finish(out, mesh, force)
    with (collection / "trace").open("a") as file:
        file.write(f"{out.name}\n")


sys.modules["anymesh.pipeline"] = types.SimpleNamespace(articulate=articulate)  # ty: ignore[invalid-assignment]


run = work.annotate_object
