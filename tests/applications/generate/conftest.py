"""Meshy on the loopback address, a small program that makes meshes, and an articulated box that stands in for the pipeline."""

import shutil
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from loopback import guard
from meshy_wire import MeshyServer, serving

from anymesh import pipeline
from anymesh.applications.generate import run as run_module
from anymesh.pipeline.run_folder import RunFolder, Saved
from anymesh.runtime import Progress
from anymesh.types import Asset

BOX = Path(__file__).parents[3] / "examples" / "meshes" / "storage_box.glb"
PROGRAM = Path(__file__).parent / "small_generator.py"


@pytest.fixture
def server(monkeypatch: pytest.MonkeyPatch) -> Iterator[MeshyServer]:
    """Gives the box at the first look."""
    guard(monkeypatch)
    with serving(MeshyServer(model=BOX.read_bytes(), steps=[]), monkeypatch) as found:
        yield found


@pytest.fixture(scope="session")
def articulated_box(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What `articulate` makes of the box."""
    out = tmp_path_factory.mktemp("box") / "out"
    pipeline.articulate(BOX, out, formats="urdf")
    return out


@pytest.fixture
def articulations(articulated_box: Path, monkeypatch: pytest.MonkeyPatch) -> list[dict]:
    """`articulate` gives the box without computing it; its calls are listed."""
    calls: list[dict] = []

    def articulate(mesh: Path, out: Path, **options: object) -> Asset:
        assert Path(mesh).is_file()
        calls.append({"mesh": Path(mesh), **options})
        shutil.rmtree(out, ignore_errors=True)
        shutil.copytree(articulated_box, out)
        return Saved.at(out).asset()

    monkeypatch.setattr(pipeline, "articulate", articulate)
    return calls


@pytest.fixture
def program() -> Callable[..., str]:
    """The name of a generator: the small program, with what it is to do."""
    return lambda *words: " ".join(["command:" + sys.executable, str(PROGRAM), *words])


@pytest.fixture
def quick(articulations: list[dict], monkeypatch: pytest.MonkeyPatch) -> list[dict]:
    """As `articulations`, and `finish` takes the stages over without computing or writing more."""

    def finish(folder: Path, out: Path, *, force: bool, progress: Progress, **options: object) -> Asset:
        progress("finish", str(options["completer"]), 0, 1)
        with RunFolder.create(out, source=folder / "asset.json", force=force) as run:
            run.take_over(folder)
            shutil.copyfile(folder / "asset.json", run.folder / "asset.json")
            return run.asset()

    monkeypatch.setattr(run_module, "finish", finish)
    return articulations
