"""A mesh that is there already, in the place of a generated one."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from anymesh.applications.generate.protocol import GeneratedMesh, MeshRequest, Step, Unit
from anymesh.loading import load_mesh
from anymesh.loading.load import LoadedMesh
from anymesh.progress import Progress


@dataclass(frozen=True)
class GivenMesh:
    """Takes a mesh file as it is. root: the folder within which files that it refers to may be read."""

    path: Path
    root: str | Path | None = None

    @property
    def name(self) -> str:
        """Of nobody."""
        return "file"

    @property
    def unit(self) -> Unit:
        """The file's."""
        return Unit.STATED

    @cached_property
    def _loaded(self) -> LoadedMesh:
        return load_mesh(self.path, root=self.root)

    def settings(self, request: MeshRequest) -> Mapping[str, object]:
        """Digests of the file and of those that it refers to. Raises InputError for what is no usable mesh."""
        return {"name": self.name, "file": self.path.name, "sha256": self._loaded.sha256, "references": self._loaded.references}

    def steps(self, request: MeshRequest) -> tuple[Step, ...]:
        """Read the file."""
        return (Step(f"take the mesh {self.path.name} ({len(self._loaded.mesh.faces):,} faces); nothing is generated"),)

    def check(self) -> None:
        """InputError for what is no usable mesh."""
        self._loaded  # noqa: B018 - reads it

    def make(self, request: MeshRequest, folder: Path, progress: Progress) -> GeneratedMesh:
        """The file where it is."""
        return GeneratedMesh(self.path)
