"""Generator that returns an existing mesh."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from anymesh.applications.generate.protocol import GeneratedMesh, MeshRequest, Step, Unit
from anymesh.loading import load_mesh
from anymesh.loading.load import LoadedMesh
from anymesh.runtime import Progress


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
