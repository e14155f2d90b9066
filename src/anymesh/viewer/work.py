"""Articulation of a mesh in a child process that a page can follow and end."""

from __future__ import annotations

import contextlib
import os
import pickle
import subprocess
import sys
import threading
from pathlib import Path
from typing import Any

from anymesh.isolation.child import LENGTH, write_message
from anymesh.types import Mesh

STAGES = {"load": (0.0, 0.05), "segment": (0.05, 0.5), "joints": (0.5, 0.8), "export": (0.8, 1.0)}  # shares of the work
WORDS = {
    "start": "starting",
    "load": "reading the mesh",
    "segment": "finding the parts",
    "joints": "finding how they move",
    "export": "writing the files",
}
CRASHED = "processing of this mesh ended unexpectedly ({}); it may need more memory than there is, or a library crashed"


class ArticulationWork:
    """One run of `articulate`.

    `mesh`: the placed mesh, once it is loaded; `error`: why it failed, in words; `done`: whether the asset is in the folder
    `out`.
    """

    def __init__(self, mesh: Path, out: Path, **options: Any) -> None:
        self.out = out
        self.mesh: Mesh | None = None
        self.error: str | None = None
        self.done = self.cancelled = False
        self.stage, self.item, self.share = "start", "", 0.0
        command = [sys.executable, "-c", "from anymesh.viewer.work_child import main; main()"]
        environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
        self._process = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, env=environment, start_new_session=True
        )
        self._request = {"mesh": mesh, "out": out, **options}
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    @property
    def over(self) -> bool:
        """Whether it ended, successfully or not."""
        return self.done or self.cancelled or self.error is not None

    @property
    def begun(self) -> bool:
        """Whether the child process has reported."""
        return self.stage != "start"

    @property
    def words(self) -> str:
        """Description of the current stage."""
        stage = WORDS.get(self.stage, self.stage)
        return f"{stage} ({self.item})" if self.item and self.stage in ("segment", "joints") else stage

    def cancel(self) -> None:
        """End the work immediately."""
        self.cancelled = True
        self._process.kill()
        self._reader.join(10)

    def _read(self) -> None:
        stdin, stdout = self._process.stdin, self._process.stdout
        assert stdin is not None
        assert stdout is not None
        with contextlib.suppress(OSError, EOFError):
            write_message(stdin, self._request)
            while len(head := stdout.read(LENGTH)) == LENGTH:
                size = int.from_bytes(head, "little")
                data = stdout.read(size)
                if len(data) < size:
                    break
                self._note(*pickle.loads(data))
        stdout.close()
        with contextlib.suppress(OSError):
            stdin.close()
        code = self._process.wait()
        if not self.over:
            self.error = CRASHED.format(f"signal {-code}" if code < 0 else f"exit code {code}")

    def _note(self, kind: str, *fields: Any) -> None:
        match kind:
            case "progress":
                self.stage, self.item, done, total = fields
                begin, end = STAGES.get(self.stage, (self.share, self.share))
                self.share = max(self.share, begin + (end - begin) * min(done / max(total, 1), 1.0))
            case "mesh":
                (self.mesh,) = fields
            case "done":
                self.share, self.done = 1.0, True
            case _:
                (self.error,) = fields
