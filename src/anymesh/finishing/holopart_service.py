"""HoloPart (Yang et al. 2025), which completes the parts of a scene: run in its own checkout, or over HTTP.

Both take a GLB with one geometry per part and return one with the completed parts. The checkout is the authors' released code.
It needs a GPU and its own environment, so it runs as a separate process and is never imported.
"""

from __future__ import annotations

import logging
import os
import shutil
import signal
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol, runtime_checkable

from anymesh.errors import ModelError, OptionError
from anymesh.finishing.web import Call, LostError, exchange, is_web
from anymesh.prompted.models.error_redaction import LONGEST, SECRET
from anymesh.prompted.models.retry import persist

log = logging.getLogger("anymesh")
VALID = "holopart:FOLDER, holopart:FOLDER#PYTHON or holopart:URL"
MODULE = "scripts.inference_holopart"
RESULT = "output.glb"
LARGEST = 1 << 29  # [bytes] maximum size of a result


class CrashError(ModelError):
    """HoloPart ran and failed."""


@runtime_checkable
class PartService(Protocol):
    """Protocol of a service that completes the parts of a scene."""

    def complete(self, glb: bytes) -> bytes:
        """Return the GLB of the completed parts.

        Raise CrashError if the service fails on this scene, ModelError if it cannot be used.
        """
        ...


def open_holopart(where: str, *, timeout: float = 1800.0, seed: int = 0) -> PartService:
    """Open a HoloPart checkout or server.

    where: URL of a server, or a folder with the checkout, which is run by the Python after `#` (else that of its .venv, else
    `python`);
    timeout: [s] for all parts together. Raise OptionError if there is no such checkout, program or valid URL.
    """
    if not timeout > 0:
        raise OptionError(f"a time-out must be more than 0 s, found {timeout:g}")
    if where.startswith(("http://", "https://")):
        if not is_web(where, plain=True) or "@" in where:
            raise OptionError(f"--completer: the URL is not valid; valid are {VALID}, without user or password")
        return PartServer(where, timeout)
    folder, _, python = where.partition("#")
    root = Path(folder).expanduser()
    script = root.joinpath(*MODULE.split(".")).with_suffix(".py")
    if not folder or not script.is_file():
        held = "no folder" if not (folder and root.is_dir()) else f"a folder without {script.relative_to(root)}"
        raise OptionError(f"--completer: found {held} at {folder or '(nothing)'!r}; valid are {VALID}")
    own = [str(p) for p in (root / ".venv/bin/python", root / ".venv/Scripts/python.exe") if p.is_file()]
    asked = python or next(iter(own), "python")
    program = shutil.which(str(Path(asked).expanduser()) if os.sep in asked else asked)
    if program is None:
        raise OptionError(f"--completer: found no program {asked!r} to run {root} with; valid are {VALID}")
    return Checkout(root.resolve(), str(Path(program).absolute()), timeout, seed)


@dataclass(frozen=True)
class PartServer:
    """HoloPart server: receives the GLB as the body of a POST and returns the GLB of the completed parts."""

    url: str
    timeout: float

    def complete(self, glb: bytes) -> bytes:
        headers = {"Content-Type": "model/gltf-binary", "Accept": "model/gltf-binary"}
        call = Call("the HoloPart server", "POST", self.url, headers, glb, self.timeout, LARGEST, plain=True)

        def ask() -> bytes:
            try:
                answer = exchange(call)
            except LostError as error:  # it may still be working: another request would repeat all of the work
                raise ModelError(str(error)) from None
            if answer.status == 200:
                return answer.body
            words = SECRET.sub("[removed]", " ".join(answer.body[:2000].decode("utf-8", "replace").split()))[:LONGEST]
            error = CrashError if answer.status == 500 else ModelError
            raise error(f"the HoloPart server: HTTP {answer.status}, it says: {words}")

        return persist(ask, attempts=3)


@dataclass(frozen=True)
class Checkout:
    """Checkout of the released code. folder, python: absolute paths; timeout: [s]."""

    folder: Path
    python: str
    timeout: float
    seed: int

    def complete(self, glb: bytes) -> bytes:
        with tempfile.TemporaryDirectory(prefix="anymesh-holopart-") as name:
            work = Path(name)
            (work / "in.glb").write_bytes(glb)
            self._run(work)
            result = work / "out" / RESULT
            if not result.is_file():
                held = sorted(p.name for p in (work / "out").iterdir()) if (work / "out").is_dir() else []
                raise CrashError(f"HoloPart ended and left no {RESULT}; found {held or 'nothing'} in its output folder")
            if result.stat().st_size > LARGEST:
                raise ModelError(f"HoloPart's {RESULT} has {result.stat().st_size} bytes, at most {LARGEST} are read")
            return result.read_bytes()

    def _run(self, work: Path) -> None:
        files = ["--mesh-input", str(work / "in.glb"), "--output-dir", str(work / "out")]
        keyless = {name: value for name, value in os.environ.items() if not name.endswith("_API_KEY")}
        with (work / "log").open("wb") as output:
            process = subprocess.Popen(
                [self.python, "-m", MODULE, *files, "--seed", str(self.seed)],
                cwd=self.folder,
                env=keyless,
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )
            try:
                code = process.wait(self.timeout)
            except subprocess.TimeoutExpired:
                raise ModelError(f"HoloPart was stopped: it took longer than {self.timeout:g} s") from None
            finally:
                _stop(process)
        if code:
            raise CrashError(f"HoloPart ended with status {code}{_last_words(work / 'log')}")


def _stop(process: subprocess.Popen[bytes]) -> None:
    """Kill the process and its children if it is still running."""
    if process.poll() is not None:
        return
    if hasattr(os, "killpg"):
        os.killpg(process.pid, signal.SIGKILL)
    else:
        process.kill()
    process.wait()


def _last_words(path: Path) -> str:
    """Return the last line of its log, with anything that looks like a key removed."""
    with path.open("rb") as file:
        file.seek(max(0, path.stat().st_size - 4000))
        lines = [line.strip() for line in file.read().decode("utf-8", "replace").splitlines() if line.strip()]
    return f"; the end of its output: {SECRET.sub('[removed]', lines[-1])[:LONGEST]}" if lines else ""
