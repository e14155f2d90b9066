"""Meshes of Objaverse: an index that is cut off, a hub that cannot be reached, ids that lead elsewhere."""

from __future__ import annotations

import errno
import gzip
import json
from pathlib import Path
from urllib.error import ContentTooShortError, URLError

import pytest

from anymesh.applications.annotate.objaverse_ import HubError, fetch
from anymesh.applications.annotate.states import Result
from anymesh.applications.annotate.work import failure
from anymesh.errors import InputError

objaverse = pytest.importorskip("objaverse")
UID, OTHER = "0" * 32, "f" * 32
INDEX = {UID: f"glbs/000-000/{UID}.glb", OTHER: "../../../secret.glb"}


class Hub:
    """The hub, in the place of the network: what it does with each address in turn, else the whole file."""

    def __init__(self) -> None:
        self.turns: list[Exception | bytes] = []
        self.asked = 0

    def urlretrieve(self, address: str, path: str) -> None:
        self.asked += 1
        turn = self.turns.pop(0) if self.turns else None
        if isinstance(turn, Exception):
            raise turn
        whole = gzip.compress(json.dumps(INDEX).encode()) if "object-paths" in address else b"glTF whole"
        Path(path).write_bytes(whole if turn is None else turn)


@pytest.fixture
def hub(tmp_path, monkeypatch) -> Hub:
    made = Hub()
    monkeypatch.setattr(objaverse, "_VERSIONED_PATH", str(tmp_path / "hub"))
    monkeypatch.setattr(objaverse.urllib.request, "urlretrieve", made.urlretrieve)
    return made


def test_a_mesh_is_fetched_once(hub) -> None:
    assert fetch(UID).read_bytes() == b"glTF whole"
    assert fetch(UID).read_bytes() == b"glTF whole"
    assert hub.asked == 2  # the index and the mesh


@pytest.mark.parametrize(
    "error", [URLError("unreachable"), ContentTooShortError("cut off", (b"", None)), TimeoutError(), ConnectionResetError()]
)
def test_a_hub_that_cannot_be_reached_is_waited_for(hub, error) -> None:
    hub.turns = [error]
    with pytest.raises(HubError) as caught:
        fetch(UID)
    assert failure(caught.value).result is Result.OUTAGE
    assert fetch(UID).exists()
    hub.turns = [error]


def test_a_mesh_that_is_cut_off_is_not_taken_for_one(hub) -> None:
    fetch(UID).unlink()
    hub.turns = [ContentTooShortError("cut off", (b"", None))]
    with pytest.raises(HubError):
        fetch(UID)
    assert fetch(UID).read_bytes() == b"glTF whole"


def test_an_index_that_was_cut_off_is_fetched_anew(hub) -> None:
    hub.turns = [gzip.compress(json.dumps(INDEX).encode())[:40]]
    assert fetch(UID).exists()


def test_a_full_disk_is_no_outage_of_the_hub(hub) -> None:
    hub.turns = [OSError(errno.ENOSPC, "full")]
    with pytest.raises(OSError, match="full") as caught:
        fetch(UID)
    assert failure(caught.value).result is Result.STORAGE


def test_ids_that_are_not_there_or_lead_elsewhere_are_refused(hub) -> None:
    for uid in ("1" * 32, OTHER):
        with pytest.raises(InputError, match="found no object with the id"):
            fetch(uid)
