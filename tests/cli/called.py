"""Calls of the command line on a cabinet."""

from pathlib import Path

import pytest
import trimesh
from assets import CABINET

from anymesh.cli import run
from anymesh.pipeline import stages

PARTS = ["--parts", "nodes", "--up", "z"]
FACES = 12 * sum(len(pieces) for pieces in CABINET.values())


@pytest.fixture
def mesh(tmp_path, monkeypatch) -> Path:
    """Write a cabinet with one node per part, Z up, to an empty working folder."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(stages, "write_preview", lambda _, path: path.write_bytes(b"drawing takes longest; tested elsewhere"))
    scene = trimesh.Scene()
    for name, pieces in CABINET.items():
        solids = [trimesh.Trimesh(v, f, process=False) for v, f in pieces]
        scene.add_geometry(trimesh.util.concatenate(solids), node_name=name, geom_name=name)
    scene.export(tmp_path / "cabinet.glb")
    return Path("cabinet.glb")


def contents(folder: Path) -> dict[str, bytes]:
    return {str(p.relative_to(folder)): p.read_bytes() if p.is_file() else b"" for p in sorted(folder.rglob("*"))}


def called(capfd, *arguments) -> tuple[int, str, str]:
    """Exit code, stdout, stderr."""
    code = run([str(a) for a in arguments])
    return (code, *capfd.readouterr())
