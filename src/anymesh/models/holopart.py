"""HoloPart (Yang et al. 2025), which completes the parts of a scene: run in a checkout of its own, or asked over HTTP.

Both take a GLB with a geometry a part and give one with the completed parts. The checkout is the authors' released code, which
needs a GPU and an environment of its own, so it is a process with a command line and never imported.
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
from anymesh.models.error_redaction import LONGEST, SECRET
from anymesh.models.retry import persist
from anymesh.models.web import Call, LostError, exchange, is_web

log = logging.getLogger("anymesh")
VALID = "holopart:FOLDER, holopart:FOLDER#PYTHON or holopart:URL"
MODULE = "scripts.inference_holopart"
RESULT = "output.glb"
LARGEST = 1 << 29  # [bytes] of a result


class CrashError(ModelError):
    """It ran and ended with an error of its own."""


@runtime_checkable
class PartService(Protocol):
    """Whoever completes the parts of a scene."""

    def complete(self, glb: bytes) -> bytes:
        """The GLB of the completed parts. CrashError where it fails on this scene, ModelError where it cannot be asked."""
        ...


def open_holopart(where: str, *, timeout: float = 1800.0, seed: int = 0) -> PartService:
    """The checkout in a folder, run by the Python after `#` (else that of its .venv, else `python`), or the server at a URL.

    timeout: [s] for all parts together. Raises OptionError where there is none.
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
    found = shutil.which(str(Path(asked).expanduser()) if os.sep in asked else asked)
    if found is None:
        raise OptionError(f"--completer: found no program {asked!r} to run {root} with; valid are {VALID}")
    return Checkout(root.resolve(), str(Path(found).absolute()), timeout, seed)


@dataclass(frozen=True)
class PartServer:
    """Takes the GLB as the body of a POST and answers with the GLB of the completed parts."""

    url: str
    timeout: float

    def complete(self, glb: bytes) -> bytes:
        headers = {"Content-Type": "model/gltf-binary", "Accept": "model/gltf-binary"}
        call = Call("the HoloPart server", "POST", self.url, headers, glb, self.timeout, LARGEST, plain=True)

        def ask() -> bytes:
            try:
                answer = exchange(call)
            except LostError as error:  # it may still be at work: asked again it would do all of it twice
                raise ModelError(str(error)) from None
            if answer.status == 200:
                return answer.body
            words = SECRET.sub("[removed]", " ".join(answer.body[:2000].decode("utf-8", "replace").split()))[:LONGEST]
            error = CrashError if answer.status == 500 else ModelError
            raise error(f"the HoloPart server: HTTP {answer.status}, it says: {words}")

        return persist(ask, attempts=3)


@dataclass(frozen=True)
class Checkout:
    """Runs the released script. folder, python: absolute paths; timeout [s]."""

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
    """Ends it and what it started, if it has not ended."""
    if process.poll() is not None:
        return
    if hasattr(os, "killpg"):
        os.killpg(process.pid, signal.SIGKILL)
    else:
        process.kill()
    process.wait()


def _last_words(path: Path) -> str:
    """The last line that it wrote, as far as it holds nothing that looks like a key."""
    with path.open("rb") as file:
        file.seek(max(0, path.stat().st_size - 4000))
        lines = [line.strip() for line in file.read().decode("utf-8", "replace").splitlines() if line.strip()]
    return f"; its last words: {SECRET.sub('[removed]', lines[-1])[:LONGEST]}" if lines else ""
