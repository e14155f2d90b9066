"""The built-in shape completer: what is added, and what stays as it was."""

import sys
from dataclasses import replace

import numpy as np
import pytest
from assets import box, cabinet, joint
from geometry.rigid import move
from surfaces import (
    FRONT,
    SIZE,
    asset_of,
    case_with_controls,
    case_with_door,
    case_with_drawer,
    is_closed,
    part_triangles,
    shell,
    volume,
)

from anymesh.errors import MissingExtraError
from anymesh.finishing.boards import board, tray
from anymesh.finishing.complete import accept, accepted, complete, complete_shapes
from anymesh.finishing.protocol import Completer, PartMesh, ShapeConfig
from anymesh.finishing.sheets import covers_itself, open_sheets, without_folds
from anymesh.finishing.solids import backed, cap, shelled
from anymesh.formats.polygons_ import triangulate
from anymesh.geometry.distance_ import distance_to_triangles
from anymesh.geometry.kinematics import posed
from anymesh.geometry.raycast_ import RayScene
from anymesh.types import Asset

WALL = ShapeConfig().wall


def wall_of(asset: Asset) -> float:
    return WALL * asset.mesh.diagonal


def test_a_case_gets_walls_and_its_door_a_back():
    asset = case_with_door()
    done = complete_shapes(asset).asset
    t, (x, y, z) = wall_of(asset), SIZE
    assert volume(done, "case") == pytest.approx(x * y * z - (x - 2 * t) * (y - t) * (z - 2 * t), rel=1e-9)
    assert volume(done, "door") == pytest.approx(x * FRONT * z, rel=1e-9)
    assert is_closed(part_triangles(done, "case"))
    assert is_closed(part_triangles(done, "door"))


@pytest.mark.parametrize("make", [case_with_door, case_with_drawer, lambda: case_with_controls(0.6)])
def test_what_was_there_stays_and_twice_is_once(make):
    asset = make()
    found = complete_shapes(asset)
    mesh, old = found.asset.mesh, len(asset.mesh.faces)
    assert (found.source_face[:old] == np.arange(old)).all()
    assert (found.source_face[old:] == -1).all()
    assert len(found.source_face) == len(mesh.faces) > old
    assert (mesh.triangles[:old] == asset.mesh.triangles).all()
    for name in ("face_node", "face_material", "corner_uv", "corner_normal"):
        assert (getattr(mesh, name)[:old] == getattr(asset.mesh, name)).all(), name
    assert (found.asset.segmentation.face_part[:old] == asset.segmentation.face_part).all()
    again = complete_shapes(found.asset)
    assert again.asset is found.asset
    assert again.notes == {}
    assert (complete_shapes(asset).asset.mesh.triangles == mesh.triangles).all()


def test_new_faces_look_like_their_part_and_are_lit_right():
    asset = case_with_drawer()
    found = complete_shapes(asset)
    mesh, new = found.asset.mesh, found.source_face < 0
    assert (mesh.face_material[new] == found.asset.segmentation.face_part[new]).all()
    assert (mesh.face_node[new] == found.asset.segmentation.face_part[new]).all()
    assert mesh.corner_normal is not None
    assert np.einsum("fkj,fj->fk", mesh.corner_normal[new], mesh.face_normals[new]).min() > 0.999
    assert mesh.corner_uv is not None
    assert (mesh.corner_uv[new] == mesh.corner_uv[new][:, :1]).all()


@pytest.mark.parametrize("scale", [1.0, 0.01, 100.0])
def test_turned_shifted_and_scaled_it_is_the_same(scale):
    asset = case_with_door()
    T = move(3) @ np.diag([scale, scale, scale, 1.0])
    hinge = asset.joints[0]
    placed = replace(hinge, origin=T[:3, :3] @ hinge.origin + T[:3, 3], axis=T[:3, :3] @ hinge.axis / scale)
    moved = replace(asset, mesh=asset.mesh.transformed(T), joints=(placed,))
    diagonal = moved.mesh.diagonal / asset.mesh.diagonal  # the box is another one when turned
    here = complete_shapes(asset, ShapeConfig(wall=WALL * diagonal / scale)).asset
    there = complete_shapes(moved).asset
    for name in ("case", "door"):
        assert volume(there, name) == pytest.approx(volume(here, name) * scale**3, rel=1e-6)


@pytest.mark.parametrize("travel", [0.1, 0.25])
def test_a_drawer_gets_a_box_that_its_travel_asks_for(travel):
    asset = case_with_drawer(travel)
    found = complete_shapes(asset)
    assert any("drawer box" in note for note in found.notes["drawer"])
    t = part_triangles(found.asset, "drawer")
    assert is_closed(t)
    assert t[..., 1].max() == pytest.approx(travel / (1 - ShapeConfig().drawer_keep), abs=1e-3)
    clear = ShapeConfig().clearance * asset.mesh.diagonal
    for amount in (0.0, travel / 2, travel):
        mesh = posed(found.asset, {"slide": amount})
        case, drawer = (mesh.triangles[found.asset.segmentation.face_part == k] for k in (0, 1))
        behind = drawer.reshape(-1, 3)
        behind = behind[behind[:, 1] > -amount + 1e-6]
        assert distance_to_triangles(behind, case).min() > 0.9 * clear


def test_the_hollow_ends_beside_the_controls():
    found = complete_shapes(case_with_controls(0.6))
    assert any("wall" in note for note in found.notes["case"])
    t = part_triangles(found.asset, "case")
    scene = RayScene(t.reshape(-1, 3), np.arange(3 * len(t)).reshape(-1, 3))
    hits = scene.first_hit(np.array([[0.3 * SIZE[0], 0.2, 0.4]]), np.array([[1.0, 0, 0]]))
    assert 0.3 * SIZE[0] + hits.distance[0] == pytest.approx(0.6 * SIZE[0], abs=0.02)
    assert is_closed(t)
    new = found.asset.mesh.triangles[found.source_face < 0]
    assert (new > np.array([0, -FRONT, 0]) - 1e-9).all()
    assert (new < SIZE + 1e-9).all()


def test_a_small_flap_leaves_the_whole_body_hollow():
    found = complete_shapes(case_with_controls(0.2))
    assert not any("wall added" in note for note in found.notes["case"])


def test_a_hole_that_a_knob_hides_is_capped():
    turn = joint("turn", "continuous", "post", "knob", (0.05, 0.05, 0.3), (0, 0, 1), None)
    pieces = {"post": shell((0, 0, 0), (0.1, 0.1, 0.3), "+z"), "knob": shell((0, 0, 0.3), (0.1, 0.1, 0.35), "-z")}
    done = complete_shapes(asset_of(pieces, [turn])).asset
    assert volume(done, "post") == pytest.approx(0.003, rel=1e-9)
    assert volume(done, "knob") == pytest.approx(0.0005, rel=1e-9)


def test_a_hole_on_the_ground_is_capped_and_one_in_sight_is_not():
    standing = complete_shapes(asset_of({"bin": shell((0, 0, 0), SIZE, "-z")})).asset
    assert volume(standing, "bin") == pytest.approx(float(SIZE.prod()), rel=1e-9)
    asset = asset_of({"bin": shell((0, 0, 0), SIZE, "+z")})
    done = complete_shapes(asset).asset
    t = ShapeConfig().sheet * asset.mesh.diagonal
    assert is_closed(part_triangles(done, "bin"))
    assert volume(done, "bin") == pytest.approx(float(SIZE.prod() - (SIZE - (2 * t, 2 * t, t)).prod()), rel=1e-6)


def test_what_is_whole_is_left_alone():
    asset = cabinet()
    found = complete_shapes(asset, parts=["case", "door"])
    assert found.asset is asset
    assert found.notes == {}
    assert (found.source_face == np.arange(len(asset.mesh.faces))).all()


def test_a_closed_front_gets_a_box_once():
    found = complete_shapes(cabinet())
    assert [name for name, notes in found.notes.items() if "drawer box" in notes[0]] == ["drawer"]
    assert complete_shapes(found.asset).notes == {}


def test_only_the_parts_that_are_asked_for():
    found = complete_shapes(case_with_door(), parts=["door"])
    assert set(found.notes) == {"door"}
    assert not is_closed(part_triangles(found.asset, "case"))


def test_without_watertight_what_no_motion_lays_open_stays_open():
    foot = shell((0.1, 0.1, -0.1), (0.2, 0.2, 0), "+z")
    asset = case_with_door()
    pieces = {"case": np.concatenate([part_triangles(asset, "case"), foot]), "door": part_triangles(asset, "door")}
    asset = asset_of(pieces, asset.joints)
    loose = complete_shapes(asset, ShapeConfig(watertight=False)).asset
    tight = complete_shapes(asset).asset
    assert is_closed(part_triangles(tight, "case"))
    assert not is_closed(part_triangles(loose, "case"))
    assert volume(tight, "case") - volume(loose, "case") == pytest.approx(0, abs=1e-9)  # the cap lies in the plane z = 0
    assert len(part_triangles(tight, "case")) > len(part_triangles(loose, "case"))


def door(shift: float = 0.0, deeper: float = 0.0) -> PartMesh:
    """The whole door, shifted along y or thicker inwards."""
    vertices, faces = box((0, -FRONT + shift, 0), (SIZE[0], shift + deeper, SIZE[2]))
    return PartMesh(vertices, faces)


def test_what_agrees_is_taken_and_the_part_keeps_its_faces():
    asset = case_with_door()
    found = accept(asset, {"door": door(deeper=0.05)}, who="someone")
    assert accepted(found, "someone") == ("door",)
    old = len(asset.mesh.faces)
    assert (found.asset.mesh.triangles[:old] == asset.mesh.triangles).all()
    new = found.asset.mesh.triangles[found.source_face < 0]
    assert len(new)
    assert new[..., 1].max() == 0.05
    assert (found.asset.segmentation.face_part[found.source_face < 0] == 1).all()


@pytest.mark.parametrize(("made", "why"), [(door(shift=-0.1), "of what is seen"), (door(deeper=2.0), "has no surface")])
def test_what_does_not_agree_is_not_taken(made, why):
    asset = case_with_door()
    found = accept(asset, {"door": made}, who="someone")
    assert found.asset is asset
    assert accepted(found, "someone") == ()
    assert why in found.notes["door"][0]


def test_empty_and_unknown_parts():
    asset = case_with_door()
    nothing = PartMesh(np.zeros((0, 3)), np.zeros((0, 3), int))
    assert "empty" in accept(asset, {"door": nothing}, who="someone").notes["door"][0]
    with pytest.raises(ValueError, match="window"):
        accept(asset, {"window": door()}, who="someone")
    with pytest.raises(ValueError, match=r"0\.\.7"):
        PartMesh(door().vertices, door().faces + 1)


def test_a_back_that_completes_the_border_closes_the_part():
    found = accept(case_with_door(), {"door": door()}, who="someone", tolerance=0.001)
    assert is_closed(part_triangles(found.asset, "door"))


class Someone:
    """Completes the door, and the case wrongly."""

    name = "someone"

    def complete(self, asset):
        return {"door": door(), "case": door(shift=0.3)}


def test_the_built_in_completer_does_what_was_not_taken():
    asset, someone = case_with_door(), Someone()
    assert isinstance(someone, Completer)
    found = complete(asset, completer=someone)
    assert found.notes["door"] == ("someone: accepted, 2 new faces",)
    assert "not accepted" in found.notes["case"][0]
    assert "skin" in found.notes["case"][1]
    old = len(asset.mesh.faces)
    assert (found.source_face[:old] == np.arange(old)).all()
    assert (found.source_face[old:] == -1).all()
    alone = complete(asset)
    assert (alone.asset.mesh.triangles == complete_shapes(asset).asset.mesh.triangles).all()


def solid_volume(triangles: np.ndarray) -> float:
    return float(np.einsum("ij,ij->i", triangles[:, 0], np.cross(triangles[:, 1], triangles[:, 2])).sum() / 6)


def sheets_of(triangles: np.ndarray):
    corners = triangles.reshape(-1, 3)
    return open_sheets(corners, np.arange(len(corners)).reshape(-1, 3), 5.0)


def test_a_box_without_a_side_is_one_sheet_with_one_border():
    (sheet,) = sheets_of(shell((0, 0, 0), (1, 2, 3), "-y"))
    assert len(sheet.faces) == 10
    assert [len(loop) for loop in sheet.loops] == [4]
    assert (sheet.points[sheet.loops[0]][:, 1] == 0).all()


def test_closed_solids_are_no_sheets_however_careless_their_faces_are() -> None:
    """Otherwise boards would get skins."""
    rng = np.random.default_rng(0)
    boards = [vertices[faces] for vertices, faces in (box((0, 0, 0), (1, 3, 1)), box((1, 0, 0), (2, 1, 1)))]
    frame = np.concatenate(boards)
    by_chance = np.where(rng.random(len(frame))[:, None, None] < 0.5, frame[:, ::-1], frame)
    for triangles in (
        frame,
        frame[:, ::-1],
        by_chance,
        np.concatenate([frame, frame]),
        np.concatenate([frame, frame[:, ::-1]]),
    ):
        assert sheets_of(triangles) == []
    assert sheets_of(boards[0] + rng.uniform(-2e-5, 2e-5, (12, 3, 3))) == []


@pytest.mark.parametrize("seed", range(3))
def test_cracks_between_the_faces_of_a_sheet_are_no_borders(seed: int) -> None:
    triangles = shell((0, 0, 0), (1, 2, 3), "-y")
    (sheet,) = sheets_of(triangles + np.random.default_rng(seed).uniform(-2e-5, 2e-5, triangles.shape))
    assert len(sheet.faces) == 10
    assert [len(loop) for loop in sheet.loops] == [4]


def test_a_whole_box_is_no_sheet_and_boxes_that_touch_in_a_point_are_two():
    vertices, faces = box((0, 0, 0), (1, 1, 1))
    assert open_sheets(vertices, faces, 5.0) == []
    two = np.concatenate([shell((0, 0, 0), (1, 1, 1), "-x"), shell((1, 1, 1), (2, 2, 2), "+x")])
    assert [len(s.faces) for s in sheets_of(two)] == [10, 10]


@pytest.mark.parametrize("turned", [False, True])
def test_a_shell_has_the_volume_of_its_walls(turned):
    triangles = shell((0, 0, 0), (1, 2, 3), "-y")
    (sheet,) = sheets_of(triangles[:, ::-1] if turned else triangles)
    points, faces = shelled(sheet, 0.1, faces_out=not turned)
    whole = sheet.with_faces(points, faces).triangles
    assert is_closed(whole)
    assert solid_volume(whole) == pytest.approx((-1 if turned else 1) * (6 - 0.8 * 1.9 * 2.8))


@pytest.mark.parametrize("draft", [0.0, 0.05])
def test_a_back_lies_where_it_is_asked_for(draft):
    (sheet,) = sheets_of(shell((0, 0, 0), (1, 2, 3), "-y"))
    whole = sheet.with_faces(*backed(sheet, np.array([0, -1.0, 0]), 0.5, faces_out=True, draft=draft)).triangles
    assert is_closed(whole)
    assert whole[..., 1].min() == -0.5
    back = whole.reshape(-1, 3)[whole.reshape(-1, 3)[:, 1] == -0.5]
    np.testing.assert_allclose(back.min(0)[[0, 2]], draft, atol=1e-12)
    np.testing.assert_allclose(back.max(0)[[0, 2]], [1 - draft, 3 - draft])


def test_folds_are_dropped_and_closed_surfaces_stay_closed():
    whole = board(np.zeros(3), np.ones(3), np.eye(3))
    flap = np.array([[[0, 0, 0], [0, 0, 1], [0.0, -1, 0]]])
    flat = np.array([[[0, 0, 0], [0, 0, 0], [0.0, 0, 1]]])
    kept = without_folds(np.concatenate([flap, flat, whole, flap[:, ::-1]]), whole)
    assert (kept == whole).all()
    assert covers_itself(np.array([[0, 1, 2]]), np.array([[3, 4, 5], [2, 1, 0]]))
    assert not covers_itself(np.array([[0, 1, 2]]), np.array([[0, 1, 3]]))


def test_boards_and_trays():
    turn = np.array([[0, 1, 0], [0, 0, 1], [1.0, 0, 0]])
    for axes in (np.eye(3), turn):
        solid, hollow = board(np.zeros(3), np.array([1, 2, 3.0]), axes), tray(np.zeros(3), np.array([1, 2, 3.0]), axes, 0.1)
        assert is_closed(solid)
        assert is_closed(hollow)
        assert solid_volume(solid) == pytest.approx(6)
        assert solid_volume(hollow) == pytest.approx(6 - 0.8 * 1.8 * 2.9)


def test_without_manifold3d_one_error_says_so(monkeypatch):
    monkeypatch.setitem(sys.modules, "manifold3d", None)
    with pytest.raises(MissingExtraError, match="manifold3d is missing"):
        triangulate([np.array([[0, 0], [1, 0], [0, 1.0]])])


def test_a_cap_leaves_out_a_hole_with_another_number_of_corners() -> None:
    """A square of area 4 with a triangular hole of area .5: the cap has area 3.5 and faces along the normal."""
    square = np.array([[0, 0, 0], [0, 2, 0], [2, 2, 0], [2, 0, 0]], float)  # clockwise from above, as the faces around it run
    hole = np.array([[0.5, 0.5, 0], [1.5, 0.5, 0], [0.5, 1.5, 0]], float)
    points = np.concatenate([square, hole])
    faces = cap(points, [np.arange(4), np.arange(4, 7)], np.array([0, 0, 1.0]))
    cross = np.cross(points[faces[:, 1]] - points[faces[:, 0]], points[faces[:, 2]] - points[faces[:, 0]])
    assert (cross[:, 2] > 0).all()
    assert cross[:, 2].sum() / 2 == pytest.approx(3.5)
