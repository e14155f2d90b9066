"""Recordings that the tests share; none of them changes one."""

import shutil
from pathlib import Path

import pytest
from recordings import SIZE, VOXEL, thing

from anymesh.applications.scan import render_frames, scan


@pytest.fixture(scope="session")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """24 noisy views of `thing`, on a floor."""
    return render_frames(thing(), tmp_path_factory.mktemp("scan") / "recording", views=24, size=SIZE, seed=3)


@pytest.fixture
def mine(recording: Path, tmp_path: Path) -> Path:
    """A copy that a test may spoil."""
    return Path(shutil.copytree(recording, tmp_path / "mine"))


@pytest.fixture(scope="session")
def scanned(recording: Path, tmp_path_factory: pytest.TempPathFactory):
    """The GLB of the recording and its report."""
    out = tmp_path_factory.mktemp("scanned") / "thing.glb"
    return out, scan(recording, out, voxel=VOXEL)
