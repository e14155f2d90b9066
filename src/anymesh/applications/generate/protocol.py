"""What a 3D generator is asked for, what it gives, and what it says beforehand of its tasks and their cost."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Protocol, runtime_checkable

from anymesh.errors import InputError, OptionError
from anymesh.names import legal_name
from anymesh.progress import Progress

WORDS = 6  # of a prompt that name the asset
ARTICLES = ("a", "an", "the")


@dataclass(frozen=True)
class MeshRequest:
    """What to make: by its description, by a picture, or by both (neither for a mesh that is there already).

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
        """Of the asset: the first words of the prompt, or the picture's name."""
        if self.prompt is None:
            return legal_name(self.image.stem if self.image else "", fallback="object")
        words = [word for word in self.prompt.lower().split() if word not in ARTICLES]
        return legal_name("_".join(words[:WORDS]), fallback="object")

    def as_dict(self) -> dict[str, object]:
        """Plain values, the picture by its name and digest."""
        image = None if self.image is None else {"name": self.image.name, "sha256": file_digest(self.image)}
        return {"prompt": self.prompt, "image": image}


class Unit(StrEnum):
    """What a unit of a mesh file is worth: as its author states it, as a generator estimated it, or nothing."""

    STATED = "stated"
    ESTIMATED = "estimated"
    ARBITRARY = "arbitrary"


@dataclass(frozen=True)
class PaidTask:
    """A task of a service. credits: that it took; seed: that the service drew, None where it does not tell."""

    kind: str
    id: str
    credits: float
    seed: int | None = None


@dataclass(frozen=True)
class GeneratedMesh:
    """A mesh file, and the tasks that were paid for it, also by earlier runs. calls: tasks that were paid for now."""

    path: Path
    tasks: tuple[PaidTask, ...] = ()
    calls: int = 0


@dataclass(frozen=True)
class Step:
    """A step of a dry run. credits: about what a service takes for it, 0 where it is free; source: when and where that was
    stated."""

    what: str
    credits: float = 0.0
    source: str = ""


@runtime_checkable
class Generator3D(Protocol):
    """Whoever makes surface meshes."""

    @property
    def name(self) -> str:
        """As in files and messages; holds no secret."""
        ...

    @property
    def unit(self) -> Unit:
        """Of its meshes."""
        ...

    def settings(self, request: MeshRequest) -> Mapping[str, object]:
        """What the mesh hangs on, as plain values without secrets: equal settings mean that a mesh need not be made again."""
        ...

    def steps(self, request: MeshRequest) -> tuple[Step, ...]:
        """What would be done. Nothing is written, sent, or read from the environment. Raises OptionError, InputError for a
        request that this generator cannot take."""
        ...

    def check(self) -> None:
        """Raise ModelError where it cannot be asked at all (no key, no program)."""
        ...

    def make(self, request: MeshRequest, folder: Path, progress: Progress) -> GeneratedMesh:
        """A mesh file in `folder`, where it may also keep what a rerun goes on from. ModelError where nothing comes back."""
        ...


def file_digest(path: Path) -> str:
    """SHA-256 of a file. Raises InputError where it cannot be read."""
    try:
        with path.open("rb") as file:
            return hashlib.file_digest(file, "sha256").hexdigest()
    except OSError as error:
        raise InputError(f"cannot read {path}: {error.strerror or error}") from None
