"""Generation tasks on the loopback address."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from meshy_wire import MeshyServer, serving

from anymesh.applications.generate.meshy import Meshy3D

GLB = b"glTF" + (2).to_bytes(4, "little") + (20).to_bytes(4, "little") + b"12345678"
PROMPT = "a retro fridge"
PNG = b"\x89PNG\r\n\x1a\n" + b"picture"


@pytest.fixture
def model_server(monkeypatch: pytest.MonkeyPatch, loopback_only: None) -> Iterator[MeshyServer]:
    with serving(MeshyServer(model=GLB), monkeypatch) as found:
        yield found


@pytest.fixture
def generator(tmp_path: Path, waits: list[float]):
    def make(**options) -> Meshy3D:
        return Meshy3D(tmp_path / "meshy.json", sleep=waits.append, chance=lambda: 0.0, **{"timeout": 4.0, **options})

    return make


def bodies(model_server: MeshyServer) -> list[dict]:
    extra = {"path", "looked", "made", "type", "credits", "seed", "sent"}
    return [{k: v for k, v in task.items() if k not in extra} for task in model_server.tasks.values()]
