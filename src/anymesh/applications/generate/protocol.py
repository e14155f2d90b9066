"""Interface of 3D generators: requests, results, and steps with their costs for dry runs."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Protocol, runtime_checkable

from anymesh.errors import InputError, OptionError
from anymesh.names import legal_name
from anymesh.runtime import Progress

WORDS = 6  # number of words of a prompt used to name the asset
ARTICLES = ("a", "an", "the")


@dataclass(frozen=True)
class MeshRequest:
    """Request for a mesh: by its description, by an image, or by both; neither for an existing mesh.

    seed: for generators that take one.
    """

    prompt: str | None = None
    image: Path | None = None
    seed: int = 0

    def __post_init__(self) -> None:
        if self.prompt is not None and not self.prompt.strip():
            raise OptionError("found an empty prompt; valid is a description such as 'a retro fridge'")
        if self.image is not None and not self.image.is_file():
            raise InputError(f"found no picture {self.image}")

    @property
    def name(self) -> str:
        """Name of the asset: the first words of the prompt, or the image's name."""
        if self.prompt is None:
            return legal_name(self.image.stem if self.image else "", fallback="object")
        words = [word for word in self.prompt.lower().split() if word not in ARTICLES]
        return legal_name("_".join(words[:WORDS]), fallback="object")

    def as_dict(self) -> dict[str, object]:
        """Return plain values, with the image as its name and digest."""
        image = None if self.image is None else {"name": self.image.name, "sha256": file_digest(self.image)}
        return {"prompt": self.prompt, "image": image}


class Unit(StrEnum):
    """Meaning of a unit of a mesh file: stated by its author, estimated by a generator, or arbitrary."""

    STATED = "stated"
    ESTIMATED = "estimated"
    ARBITRARY = "arbitrary"


@dataclass(frozen=True)
class PaidTask:
    """Paid task of a service. credits: that it took; seed: drawn by the service, None if it does not state it."""

    kind: str
    id: str
    credits: float
    seed: int | None = None


@dataclass(frozen=True)
class GeneratedMesh:
    """Mesh file, and the tasks paid for it, also by earlier runs. calls: number of tasks paid for by this run."""

    path: Path
    tasks: tuple[PaidTask, ...] = ()
    calls: int = 0


@dataclass(frozen=True)
class Step:
    """Step of a dry run.

    credits: approximate price of the service, 0 if free; source: date and source of the price.
    """

    what: str
    credits: float = 0.0
    source: str = ""


@runtime_checkable
class Generator3D(Protocol):
    """Interface of a generator of surface meshes."""

    @property
    def name(self) -> str:
        """Name for files and messages, without secrets."""
        ...

    @property
    def unit(self) -> Unit:
        """Meaning of a unit of its meshes."""
        ...

    def settings(self, request: MeshRequest) -> Mapping[str, object]:
        """Return what affects the mesh, as plain values without secrets; with equal settings an existing mesh is reused."""
        ...

    def steps(self, request: MeshRequest) -> tuple[Step, ...]:
        """Return the steps of a request, without writing, sending, or reading the environment.

        Raise OptionError or InputError for a request that this generator does not support.
        """
        ...

    def check(self) -> None:
        """Raise ModelError if the generator cannot be used (no key, no program)."""
        ...

    def make(self, request: MeshRequest, folder: Path, progress: Progress) -> GeneratedMesh:
        """Make a mesh file in `folder`, where data for resuming may be stored. Raise ModelError if there is no result."""
        ...


def file_digest(path: Path) -> str:
    """Return the SHA-256 of a file. Raise InputError if it cannot be read."""
    try:
        with path.open("rb") as file:
            return hashlib.file_digest(file, "sha256").hexdigest()
    except OSError as error:
        raise InputError(f"cannot read {path}: {error.strerror or error}") from None
