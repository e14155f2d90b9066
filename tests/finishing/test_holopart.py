"""HoloPart's released command line, spoken by a checkout that fails in the ways the real one does; and a server."""

import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from assets import box, joint, mesh_of, source
from holopart_checkout import checkout
from meshy_wire import MeshyServer, refuses, says

from anymesh.errors import ModelError, OptionError
from anymesh.finishing.complete import accept, accepted
from anymesh.finishing.holopart import (
    Checkout,
    CrashError,
    HoloPart,
    PartServer,
    Thickened,
    open_holopart,
    read_pieces,
    thicken,
)
from anymesh.finishing.scene_glb import scene_glb
from anymesh.geometry.topology import components
from anymesh.types import Asset, Mesh, Part, Segmentation


def cupboard() -> Asset:
    """What a generated surface has of a cupboard with a door and a lamp on it: the front of the door is a sheet of two
    triangles, the case is open behind it."""
    case_v, case_f = box((0, 0, 0), (0.6, 0.4, 1.0))
    front = np.isclose(case_v[case_f][:, :, 1], 0).all(1)
    door = box((0, 0, 0), (0.6, 0.4, 1.0))
    mesh, part = mesh_of([(case_v, case_f[~front]), (door[0], door[1][front]), box((0.1, 0.1, 1), (0.2, 0.2, 1.3))])
    hinge = joint("hinge", "revolute", "case", "door", (0.6, 0, 0.5), (0, 0, 1), (0.0, 1.9))
    lamp = joint("fix", "fixed", "case", "lamp", (0.15, 0.15, 1), (0, 0, 1), None)
    parts = (Part("case", "base"), Part("door", "door"), Part("lamp", "lamp"))
    return Asset("cupboard", source(), mesh, Segmentation(part, parts), (hinge, lamp), "geometry")


def completer(folder: Path, fault: str = "", timeout: float = 60.0) -> HoloPart:
    return HoloPart(open_holopart(f"{checkout(folder / 'HoloPart', fault)}#{sys.executable}", timeout=timeout).complete)


def thickness(mesh) -> float:
    return float(np.ptp(mesh.vertices[:, 1]))


def test_open_parts_come_back_whole_in_the_asset_frame(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("MESHY_API_KEY", "a key that is none of its business")
    asset = cupboard()
    made = completer(tmp_path, "thin").complete(asset)
    assert set(made) == {"case", "door"}, "the lamp is closed already"
    np.testing.assert_allclose(
        [made["case"].vertices.min(0), made["case"].vertices.max(0)], [[0, 0, 0], [0.6, 0.4, 1]], atol=1e-5
    )
    low, high = made["door"].vertices.min(0), made["door"].vertices.max(0)
    np.testing.assert_allclose([low[0], high[0], low[2], high[2], low[1]], [0, 0.6, 0, 1, 0], atol=1e-5)
    assert high[1] == pytest.approx(0.04, rel=0.05), "made thicker backwards, by 4 % of its longest side"
    taken = accept(asset, made, who="holopart")
    assert accepted(taken, "holopart") == ("case", "door")


def test_a_second_crash_is_told(tmp_path: Path) -> None:
    with pytest.raises(CrashError, match=r"status 1; the end of its output: RuntimeError: min\(\): Expected reduction dim 0"):
        completer(tmp_path, "crash").complete(cupboard())


class Echo:
    """A service that gives back what it was sent, changed."""

    def __init__(self, change: Callable[[dict[str, Mesh]], dict[str, Mesh]]) -> None:
        self.change = change

    def __call__(self, glb: bytes) -> bytes:
        return scene_glb(self.change(read_pieces(glb)), np.eye(4))


def test_a_crash_on_thin_parts_is_answered_with_twice_the_thickness() -> None:
    def crashes_below_six_percent(meshes: dict[str, Mesh]) -> dict[str, Mesh]:
        if meshes["door"].extents.min() < 0.06 * meshes["door"].extents.max():
            raise CrashError("min(): Expected reduction dim 0 to have non-zero size.")
        return meshes

    made = HoloPart(Echo(crashes_below_six_percent)).complete(cupboard())
    assert thickness(made["door"]) == pytest.approx(0.08, rel=0.05)


def test_parts_whose_names_are_lost_are_told_apart_by_where_they_are() -> None:
    made = HoloPart(Echo(lambda m: {f"geometry_{k}": m[name] for k, name in enumerate(sorted(m))})).complete(cupboard())
    assert {name: round(float(np.ptp(m.vertices[:, 1])), 2) for name, m in made.items()} == {"case": 0.4, "door": 0.04}


def test_parts_that_are_missing_are_left_out() -> None:
    made = HoloPart(Echo(lambda m: {"door": m["door"]})).complete(cupboard())
    assert set(made) == {"door"}
    with pytest.raises(ModelError, match="returned 2 parts for 3, under names that were not sent"):
        HoloPart(Echo(lambda m: {"a": m["door"], "b": m["case"]})).complete(cupboard())


def test_a_result_that_is_not_the_visible_surface_is_not_accepted() -> None:
    T = np.eye(4)
    T[0, 3] = 0.3
    asset = cupboard()
    made = HoloPart(Echo(lambda m: {name: mesh.transformed(T) for name, mesh in m.items()})).complete(asset)
    taken = accept(asset, made, who="holopart")
    assert set(made) == {"case", "door"}
    assert accepted(taken, "holopart") == ()
    assert len(taken.asset.mesh.faces) == len(asset.mesh.faces)


@pytest.mark.parametrize(
    ("fault", "told"),
    [
        ("nothing", r"left no output\.glb; found nothing in its output folder"),
        ("no file of its kind", r"left no output\.glb; found \['output\.obj'\]"),
        ("garbage", "HoloPart's result cannot be used|no readable GLB"),
        ("talks of a key", r"the end of its output: RuntimeError: \[removed\] is refused"),
    ],
)
def test_what_goes_wrong_is_told(tmp_path: Path, fault: str, told: str) -> None:
    with pytest.raises(ModelError, match=told):
        completer(tmp_path, fault).complete(cupboard())


def test_a_hang_is_ended(tmp_path: Path) -> None:
    with pytest.raises(ModelError, match=r"it took longer than 0\.5 s"):
        completer(tmp_path, "hang", timeout=0.5).complete(cupboard())


def test_a_checkout_that_is_none_is_told(tmp_path: Path) -> None:
    (tmp_path / "empty").mkdir()
    real = checkout(tmp_path / "real")
    for where, told in (
        ("", "no folder at '\\(nothing\\)'"),
        (str(tmp_path / "nowhere"), "no folder at"),
        (str(tmp_path / "empty"), "a folder without scripts/inference_holopart.py"),
        (f"{real}#/no/such/python", "no program '/no/such/python'"),
        ("http://user:secret@host/x", "without user or password"),
    ):
        with pytest.raises(OptionError, match=told) as error:
            open_holopart(where)
        assert "holopart:FOLDER#PYTHON" in str(error.value)
        assert "secret" not in str(error.value)
    with pytest.raises(OptionError, match="more than 0 s"):
        open_holopart(str(real), timeout=0.0)
    found = open_holopart(f"{real}#{sys.executable}")
    assert isinstance(found, Checkout)
    assert found.folder == real.resolve()


def test_a_server_takes_and_gives_glb(loopback_only: None, monkeypatch: pytest.MonkeyPatch) -> None:
    service = MeshyServer()
    running = service.start()
    monkeypatch.setenv("no_proxy", "*")
    found = open_holopart(service.url + "/complete", timeout=5.0)
    assert isinstance(found, PartServer)
    service.fails("create", lambda handler: says(handler, b"made of " + handler.content, kind="model/gltf-binary"))
    assert found.complete(b"glTF") == b"made of glTF"
    service.fails("create", refuses(500, "min(): Expected reduction dim 0"), refuses(503, "busy"))
    with pytest.raises(CrashError, match=r"HTTP 500, it says: .*reduction dim 0"):
        found.complete(b"glTF")
    with pytest.raises(ModelError, match="HTTP 503"):
        found.complete(b"glTF")
    service.fails("create", lambda handler: service.over.wait(5))
    with pytest.raises(ModelError, match="no answer within"):
        PartServer(service.url, 0.2).complete(b"glTF")
    service.over.set()
    running.shutdown()
    running.server_close()


def triangles(piece) -> np.ndarray:
    return piece[0][piece[1]]


def thick_volume(found: Thickened) -> float:
    t = found.mesh.triangles
    return float(np.einsum("ij,ij->i", t[:, 0], np.cross(t[:, 1], t[:, 2])).sum() / 6)


def front(piece) -> np.ndarray:
    t = triangles(piece)
    return t[(t[:, :, 1] == piece[0][:, 1].min()).all(1)]


def test_a_sheet_gets_a_back_behind_it_and_is_closed() -> None:
    sheet = front(box((0, 0, 0), (0.5, 0.3, 1)))
    found = thicken(sheet, 0.04)
    assert not found.closed
    assert found.added == pytest.approx(0.04, rel=0.03)
    parts = components(found.mesh.vertices, found.mesh.faces)
    assert (parts.solid & parts.agree).all()
    assert thick_volume(found) == pytest.approx(0.5 * 1 * found.added)
    assert found.mesh.vertices[:, 1].min() == 0, "what is seen of it stays where it is"
    np.testing.assert_allclose(np.sort(found.mesh.triangles[:2].reshape(-1, 3), 0), np.sort(sheet.reshape(-1, 3), 0))


def test_a_sheet_with_a_hole_gets_walls_in_it() -> None:
    x, z = np.meshgrid(np.arange(5.0), np.arange(5.0))
    points = np.stack([x.ravel(), 0 * x.ravel(), z.ravel()], 1)
    cells = [(i, j) for i in range(4) for j in range(4) if (i, j) != (1, 2)]
    quads = np.array([(5 * j + i, 5 * j + i + 1, 5 * j + i + 6, 5 * j + i + 5) for i, j in cells])
    found = thicken(points[np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])], 0.05)
    parts = components(found.mesh.vertices, found.mesh.faces)
    assert (parts.solid & parts.agree).all()
    assert thick_volume(found) == pytest.approx(15 * found.added)


def test_a_thin_solid_is_stretched_about_its_middle() -> None:
    found = thicken(triangles(box((0, 0.10, 0), (0.5, 0.11, 1))), 0.04)
    assert found.closed
    y = found.mesh.vertices[:, 1]
    assert (y.min() + y.max()) / 2 == pytest.approx(0.105, abs=1e-3)
    assert np.ptp(y) == pytest.approx(0.04, rel=0.05)
    assert np.ptp(found.mesh.vertices[:, [0, 2]], axis=0) == pytest.approx([0.5, 1.0], rel=1e-3)


def test_what_is_thick_enough_is_left() -> None:
    for piece in (box((0, 0, 0), (0.5, 0.3, 1)), box((0, 0, 0), (0.05, 0.3, 1))):
        found = thicken(triangles(piece), 0.04)
        assert found.added == 0
        assert thick_volume(found) == pytest.approx(float(np.prod(np.ptp(piece[0], axis=0))))


def test_a_handle_does_not_make_a_door_thick() -> None:
    sheet = front(box((0, 0, 0), (0.5, 0.3, 1)))
    handle = triangles(box((0.4, -0.06, 0.5), (0.42, -0.04, 0.54)))
    assert thicken(np.concatenate([sheet, handle]), 0.04).added > 0.03
