"""Generators by name: Meshy, a program of the user (TRELLIS, Hunyuan3D, or any other that writes a GLB), and a given file."""

from __future__ import annotations

import hashlib
import os
import re
import shlex
import shutil
import signal
import subprocess
import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from anymesh.applications.generate.meshy import SHAPE, TEXTURED, MeshyGenerator
from anymesh.applications.generate.protocol import GeneratedMesh, Generator3D, MeshRequest, Step, Unit
from anymesh.errors import SECRET, InputError, ModelError, OptionError, redacted
from anymesh.finishing.meshy_api import KEY
from anymesh.loading import load_mesh
from anymesh.loading.load import LoadedMesh
from anymesh.prompted.models.servers import KEYS
from anymesh.runtime import Progress

PROGRAM = "command:"
PLACEHOLDERS = ("prompt", "image", "out", "seed")
VALID = "command:PROGRAM with {out}, and {prompt} or {image}, such as 'command:python run.py --image {image} --out {out}'"
LOG = "command.log"
SECRET_OPTION = re.compile(r"(?i)(--?[\w-]*(?:key|token|secret|password)[\w-]*)(=|\s+)\S+")
GRACE = 3.0  # [s] between SIGTERM and SIGKILL
LOOK = 0.2  # [s] between checks of a running program
TAIL = 4000  # [bytes] at the end of a log that a message may quote
LINES = 6
LONGEST = 600  # characters


def open_generator(name: str, *, time_limit: float = 1800.0, max_calls: int | None = None) -> Generator3D:
    """Return the generator of a name. time_limit: of a program [s]; max_calls: maximum number of paid tasks.

    Makes no request and needs no key. Raise OptionError for a name that is not valid.
    """
    if name in (TEXTURED, SHAPE):
        return MeshyGenerator(textured=name == TEXTURED, max_calls=max_calls)
    if name.startswith(PROGRAM):
        return CommandGenerator.parse(name.removeprefix(PROGRAM), time_limit)
    raise OptionError(f"--generator: found {name!r}; valid are {TEXTURED}, {SHAPE}, {VALID}")


@dataclass(frozen=True)
class CommandGenerator:
    """Generator that runs a command without a shell, once per mesh.

    words: of the command, with placeholders; timeout [s].
    """

    words: tuple[str, ...]
    timeout: float = 1800.0

    @classmethod
    def parse(cls, template: str, timeout: float = 1800.0) -> CommandGenerator:
        """Parse the text after `command:`, quoted as in a shell. Raise OptionError for a template that is not valid."""
        try:
            words = tuple(shlex.split(template))
        except ValueError as error:
            raise OptionError(f"--generator: the command cannot be split into words ({error}); valid is {VALID}") from None
        placeholders = set(re.findall(r"\{([a-z_]+)\}", template))
        unknown = sorted(placeholders - set(PLACEHOLDERS))
        if unknown:
            names = ", ".join(f"{{{name}}}" for name in PLACEHOLDERS)
            raise OptionError(f"--generator: found the placeholders {unknown}; valid are {names}")
        if not words or "out" not in placeholders or not placeholders & {"prompt", "image"}:
            raise OptionError(f"--generator: found the command {redacted(template)!r}; valid is {VALID}")
        if not timeout > 0:
            raise OptionError(f"--generator-time-limit must be more than 0 s, found {timeout:g}")
        return cls(words, timeout)

    @property
    def name(self) -> str:
        """Name of the generator, from the program's file name."""
        return f"command:{Path(self.words[0]).name}"

    @property
    def unit(self) -> Unit:
        """Meaning of a unit of the meshes, which programs write in a box of arbitrary size."""
        return Unit.ARBITRARY

    def settings(self, request: MeshRequest) -> Mapping[str, object]:
        """Return the command without folders and keys, the digest of the full command, and the seed if the command takes it."""
        whole = shlex.join(self.words)
        seed = {"seed": request.seed} if self._takes("seed") else {}
        return {"name": self.name, "command": _public(whole), "sha256": hashlib.sha256(whole.encode()).hexdigest(), **seed}

    def steps(self, request: MeshRequest) -> tuple[Step, ...]:
        """Return the command with its placeholders filled in."""
        words = self._filled(request, Path(f"{request.name}.glb"))
        return (Step(f"run a program, for at most {self.timeout:g} s: {shlex.join(words)}"),)

    def check(self) -> None:
        """Raise ModelError if the program does not exist."""
        if shutil.which(self.words[0]) is None:
            raise ModelError(f"--generator: found no program {self.words[0]!r}; valid is one on the PATH, or its path")

    def make(self, request: MeshRequest, folder: Path, progress: Progress) -> GeneratedMesh:
        """Run the program and return the file that it writes as {out}. Raise ModelError if it is no readable mesh."""
        out, log = folder / f"{request.name}.glb", folder / LOG
        out.unlink(missing_ok=True)
        code = run_program(
            self._filled(request, out.absolute()),
            log,
            environment=_keyless(),
            timeout=self.timeout,
            on_wait=lambda seconds: progress("generate", f"{self.name}, {seconds:.0f} s", 0, 1),
        )
        if code:
            raise ModelError(f"{self.name} ended with status {code}{log_tail(log)}")
        if not out.is_file():
            raise ModelError(f"{self.name} ended and wrote no file at {{out}}{log_tail(log)}")
        try:
            load_mesh(out)
        except InputError as error:
            raise ModelError(f"{self.name} wrote a file that is not a usable mesh: {error}{log_tail(log)}") from None
        log.unlink()
        return GeneratedMesh(out)

    def _takes(self, placeholder: str) -> bool:
        return any(f"{{{placeholder}}}" in word for word in self.words)

    def _filled(self, request: MeshRequest, out: Path) -> list[str]:
        """Return the words of the command with placeholders filled in, each value within its word."""
        image = None if request.image is None else str(request.image.absolute())
        values = {"prompt": request.prompt, "image": image, "out": str(out), "seed": str(request.seed)}
        for name, value in values.items():
            if self._takes(name) and value is None:
                raise OptionError(f"--generator: the command takes {{{name}}}, and none was given")
        pattern = re.compile(r"\{(" + "|".join(PLACEHOLDERS) + r")\}")
        return [pattern.sub(lambda match: str(values[match[1]]), word) for word in self.words]


def _keyless() -> dict[str, str]:
    """Return the environment without the keys used by this package, which the program does not need."""
    keys = {KEY, *(name for names in KEYS.values() for name in names)}
    return {name: value for name, value in os.environ.items() if name not in keys}


def _public(command: str) -> str:
    return redacted(SECRET_OPTION.sub(r"\1\2[removed]", command))


def run_program(
    words: Sequence[str], log: Path, *, environment: Mapping[str, str], timeout: float, on_wait: Callable[[float], None]
) -> int:
    """Run a program without a shell and return its exit status; its output goes to the file `log`.

    timeout [s]; on_wait: called with the seconds elapsed. Raise ModelError if the program cannot be started or exceeds the time
    limit. In the latter case, on interruption, and if the program fails, its whole process group is ended.
    """
    with log.open("wb") as output:
        try:
            process = subprocess.Popen(
                list(words), env=dict(environment), stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT,
                start_new_session=True,
            )  # fmt: skip
        except (OSError, ValueError) as error:
            raise ModelError(f"{words[0]} cannot be run: {getattr(error, 'strerror', None) or error}") from None
        code = None
        try:
            code = _wait(process, timeout, on_wait)
        finally:
            if code != 0:
                _end(process)
    if code is None:
        raise ModelError(f"{Path(words[0]).name} was ended: it took longer than {timeout:g} s{log_tail(log)}")
    return code


def log_tail(log: Path) -> str:
    """Return the last lines of a program's output, with anything that resembles a key removed; may be empty."""
    begin = max(0, log.stat().st_size - TAIL)
    with log.open("rb") as file:
        file.seek(begin)
        text = file.read().decode("utf-8", "replace")
    lines = [re.sub(r"\s+", " ", line).strip() for line in re.split(r"[\r\n]+", text)]
    if begin:  # the first line may be cut, and half of a key does not resemble one
        del lines[0]
    tail = " | ".join([line for line in lines if line][-LINES:])
    return f"; the end of its output: {SECRET.sub('[removed]', tail)[-LONGEST:]}" if tail else ""


def _wait(process: subprocess.Popen[bytes], timeout: float, on_wait: Callable[[float], None]) -> int | None:
    """Return the exit status; None if the time limit is exceeded."""
    begin = time.monotonic()
    while (spent := time.monotonic() - begin) < timeout:
        on_wait(spent)
        with suppress(subprocess.TimeoutExpired):
            return process.wait(min(LOOK, timeout - spent))
    return None


def _end(process: subprocess.Popen[bytes]) -> None:
    """End a program and its process group, by SIGTERM and then by SIGKILL."""
    if not hasattr(os, "killpg"):
        process.kill()
        process.wait()
        return
    with suppress(ProcessLookupError, PermissionError):
        os.killpg(process.pid, signal.SIGTERM)
        with suppress(subprocess.TimeoutExpired):
            process.wait(GRACE)
        os.killpg(process.pid, signal.SIGKILL)  # child processes, and the program itself if it ignored SIGTERM
    process.wait()


@dataclass(frozen=True)
class GivenMesh:
    """Generator that returns a mesh file unchanged. root: the folder within which files that it refers to may be read."""

    path: Path
    root: str | Path | None = None

    @property
    def name(self) -> str:
        """Name of the generator."""
        return "file"

    @property
    def unit(self) -> Unit:
        """Meaning of a unit of the mesh, as stated by the file."""
        return Unit.STATED

    @cached_property
    def _loaded(self) -> LoadedMesh:
        return load_mesh(self.path, root=self.root)

    def settings(self, request: MeshRequest) -> Mapping[str, object]:
        """Return digests of the file and of those that it refers to. Raise InputError if it is no usable mesh."""
        return {"name": self.name, "file": self.path.name, "sha256": self._loaded.sha256, "references": self._loaded.references}

    def steps(self, request: MeshRequest) -> tuple[Step, ...]:
        """Return the reading of the file as the only step."""
        return (Step(f"take the mesh {self.path.name} ({len(self._loaded.mesh.faces):,} faces); nothing is generated"),)

    def check(self) -> None:
        """Raise InputError if the file is no usable mesh."""
        self._loaded  # noqa: B018 - reads it

    def make(self, request: MeshRequest, folder: Path, progress: Progress) -> GeneratedMesh:
        """Return the file at its place."""
        return GeneratedMesh(self.path)
