"""Generator that runs a program of the user: TRELLIS, Hunyuan3D, or any other that writes a GLB."""

from __future__ import annotations

import hashlib
import os
import re
import shlex
import shutil
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from anymesh.applications.generate.program import log_tail, run_program
from anymesh.applications.generate.protocol import GeneratedMesh, MeshRequest, Step, Unit
from anymesh.defects import redacted
from anymesh.errors import InputError, ModelError, OptionError
from anymesh.finishing.meshy_api import KEY
from anymesh.loading import load_mesh
from anymesh.prompted.models.address import KEYS
from anymesh.runtime import Progress

PLACEHOLDERS = ("prompt", "image", "out", "seed")
VALID = "command:PROGRAM with {out}, and {prompt} or {image}, such as 'command:python run.py --image {image} --out {out}'"
LOG = "command.log"
SECRET_OPTION = re.compile(r"(?i)(--?[\w-]*(?:key|token|secret|password)[\w-]*)(=|\s+)\S+")


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
