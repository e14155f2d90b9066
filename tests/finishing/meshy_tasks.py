"""Retexturing tasks on the loopback address."""

import base64
import json
from collections.abc import Iterator
from pathlib import Path

import pytest
from meshy_wire import MeshyServer, serving

from anymesh.finishing.meshy import Meshy

GLB = b"glTF" + (2).to_bytes(4, "little") + (20).to_bytes(4, "little") + b"12345678"
SENT = "data:application/octet-stream;base64," + base64.b64encode(GLB).decode()


@pytest.fixture
def server(monkeypatch: pytest.MonkeyPatch, loopback_only: None) -> Iterator[MeshyServer]:
    with serving(MeshyServer(), monkeypatch) as found:
        yield found


@pytest.fixture
def waits() -> list[float]:
    return []


@pytest.fixture
def meshy(tmp_path: Path, waits: list[float]):
    def make(**options) -> Meshy:
        return Meshy(tmp_path / "task.json", sleep=waits.append, chance=lambda: 0.0, **{"timeout": 4.0, **options})

    return make


def state(client: Meshy) -> dict:
    return json.loads(client.state.read_text())
