"""Test the answered size, a ground in the file, and that the result does not depend on the yaw of the object."""

import numpy as np
import pytest
import trimesh
from assets import box, mesh_of, source

from anymesh.correcting.motions import ranked_motions
from anymesh.evaluation.changes import rotation
from anymesh.geometry.surface import ground_faces
from anymesh.loading import load_mesh, place_mesh
from anymesh.pipeline import solving
from anymesh.pipeline.results import SegmentationResult
from anymesh.pipeline.solving import GROUND_WARNING, Solver, solve
from anymesh.segmentation.divide import divide_surface
from anymesh.types import Asset, Joint, JointType, Mesh, Segmentation
from anymesh.types.motion import Recognition, RecognizedLabel

MESH, _ = mesh_of([box((0, 0, 0), (1, 1, 0.5))])


class Sees:
    """Answers that the object is a box of some length."""

    name, exchanges, warnings = "sees", (), ()

    def __init__(self, size: float, *labels: RecognizedLabel) -> None:
        self.size, self.labels = size, labels

    def ask(self, question):
        return Recognition("box", self.size, self.labels)


def test_only_where_pictures_are_answered_seams_closed_in_places_divide_the_surface(monkeypatch) -> None:
    divided = []
    monkeypatch.setattr(solving, "divide_surface", lambda *_, seams: divided.append(seams) or divide_surface(MESH, 0))
    for factory in (None, lambda _: Sees(1.0)):
        assert len(Solver(MESH, answerer_factory=factory).geometry.whole.patch)
    assert divided == [False, True]


@pytest.mark.parametrize(
    ("size", "metric", "scale", "doubted"),
    [
        (1.2, False, 1.0, False), (3.0, False, 3.0, False), (20.0, False, 20.0, True),
        (1.2, True, 1.0, False), (2.0, True, 1.0, True), (3.0, True, 1.0, True), (0.1, True, 1.0, True),
    ],
)  # fmt: skip
def test_an_answered_size_sets_the_scale_unless_the_file_has_a_unit(
    size: float, metric: bool, scale: float, doubted: bool
) -> None:
    found = Solver(MESH, answerer_factory=lambda _: Sees(size)).answers.recognize(sized=True, metric=metric)
    assert found.note or found.warnings  # the answer is never dropped without a word
    assert found.scale == pytest.approx(scale)
    assert bool(found.warnings) is doubted
    if doubted:
        assert "give --scale" in found.warnings[0]
        assert ("unit was kept" in found.warnings[0]) is metric
    assert (
        Solver(MESH, answerer_factory=lambda _: Sees(size)).answers.recognize(metric=metric).scale == 1.0
    )  # the user gave the scale


SASH = RecognizedLabel("sash", JointType.PRISMATIC, "base", (-0.1, 0.4))
KEPT = {"sized": True, "metric": True}  # of a file with a unit
LEAF = RecognizedLabel("leaf", JointType.REVOLUTE, "base", (0.0, 1.5))


@pytest.mark.parametrize(
    ("size", "asked", "share"),
    [
        (0.01, KEPT, 100.0), (0.01, {"metric": True}, 100.0), (50.0, KEPT, 0.02),
        (0.01, {"sized": True}, 1.0), (0.8, KEPT, 1.0),
    ],
)  # fmt: skip
def test_answered_slides_fit_the_size_that_the_mesh_keeps(size: float, asked: dict[str, bool], share: float) -> None:
    """Their centimetres are those of an object of the answered length; the mesh is 1 m long."""
    found = Solver(MESH, answerer_factory=lambda _: Sees(size, SASH, LEAF)).answers.recognize(**asked)
    assert found.recognition is not None
    sash, leaf = found.recognition.labels
    assert sash.limits == pytest.approx((-0.1 * share, 0.4 * share))
    assert leaf == LEAF
    assert ("slides fit it" in " ".join(found.warnings)) is (share != 1)


def test_files_say_whether_they_have_a_unit(tmp_path) -> None:
    shape = trimesh.creation.box((0.4, 0.3, 0.2))
    for name, metric in (("a.glb", True), ("a.obj", False), ("a.stl", False)):
        shape.export(tmp_path / name)
        loaded = load_mesh(tmp_path / name)
        assert place_mesh(loaded).metric is metric
        assert place_mesh(loaded, scale="0.5").metric is False
    shape.apply_scale(1e5)
    shape.export(tmp_path / "b.glb")
    placed = place_mesh(load_mesh(tmp_path / "b.glb"))
    assert not placed.metric  # its unit was implausible
    assert np.linalg.norm(placed.mesh.extents) == pytest.approx(1.0)


# a case with two doors in front of it
WALLS = [((0, 0, 0), (0.02, 0.4, 0.8)), ((0.78, 0, 0), (0.8, 0.4, 0.8)), ((0, 0.38, 0), (0.8, 0.4, 0.8))]
ENDS = [((0, 0, 0), (0.8, 0.4, 0.02)), ((0, 0, 0.78), (0.8, 0.4, 0.8)), ((0, 0, 0.4), (0.8, 0.4, 0.42))]
DOORS = [((0.003, -0.022, 0.003), (0.398, -0.002, 0.797)), ((0.402, -0.022, 0.003), (0.797, -0.002, 0.797))]
KNOBS = [((0.36, -0.05, 0.5), (0.375, -0.022, 0.53)), ((0.425, -0.05, 0.5), (0.44, -0.022, 0.53))]
CUPBOARD = mesh_of([box(*corners) for corners in (*WALLS, *ENDS, *DOORS, *KNOBS)])[0]


R = rotation(np.array([0.0, 0, 1]), np.deg2rad(133))

Solution = tuple[Segmentation, tuple[Joint, ...]]


@pytest.fixture(scope="module")
def turned_mesh() -> Mesh:
    return CUPBOARD.transformed(R)


@pytest.fixture(scope="module")
def turned_solution(turned_mesh: Mesh) -> Solution:
    return solve(turned_mesh)


def test_the_motions_that_a_correction_offers_begin_with_the_joint_that_was_found(
    turned_mesh: Mesh, turned_solution: Solution
) -> None:
    parts, joints = turned_solution
    asset = Asset("cupboard", source(), turned_mesh, parts, joints, "geometry")
    for joint in joints:
        first = ranked_motions(asset, joint.child)[0]
        np.testing.assert_allclose(np.abs(first.axis), np.abs(joint.axis), atol=1e-6)
        np.testing.assert_allclose(first.origin, joint.origin, atol=2e-3)


def test_a_cupboard_has_the_same_doors_whichever_way_it_faces(turned_solution: Solution) -> None:
    parts, joints = solve(CUPBOARD)
    turned_parts, turned_joints = turned_solution
    front = CUPBOARD.triangles[:, :, 1].max(1) < 0  # [m] the doors and their knobs are before the case
    assert {frozenset(parts.faces(number)) for number in range(1, len(parts.parts))} >= {
        frozenset(np.flatnonzero(front & (side * (CUPBOARD.triangles[:, :, 0].mean(1) - 0.4) > 0))) for side in (-1, 1)
    }
    # equal doors in any order
    same = [0, *(int(turned_parts.face_part[parts.faces(number)[0]]) for number in range(1, len(parts.parts)))]
    np.testing.assert_array_equal(np.array(same)[parts.face_part], turned_parts.face_part)
    for number, joint in enumerate(joints, start=1):
        turned = turned_joints[same[number] - 1]
        assert turned.type is joint.type
        np.testing.assert_allclose(turned.axis, R[:3, :3] @ joint.axis, atol=1e-6)
        np.testing.assert_allclose(turned.origin, R[:3, :3] @ joint.origin, atol=2e-3)
        assert turned.limits == pytest.approx(joint.limits, abs=0.04)


CHEST_SIDES = [((-0.4, -0.3, 0), (-0.38, 0.3, 0.5)), ((0.38, -0.3, 0), (0.4, 0.3, 0.5)), ((-0.4, 0.28, 0), (0.4, 0.3, 0.5))]
LEVELS = [((-0.4, -0.3, z), (0.4, 0.3, z + 0.02)) for z in (0, 0.24, 0.48)]
DRAWERS = [((-0.37, -0.3, z), (0.37, 0.25, z + 0.19)) for z in (0.03, 0.27)]
CHEST_KNOBS = [((-0.02, -0.33, z), (0.02, -0.3, z + 0.03)) for z in (0.12, 0.36)]
CHEST = [box(*corners) for corners in (*CHEST_SIDES, *LEVELS, *DRAWERS, *CHEST_KNOBS)]


def solution(*more: tuple[np.ndarray, np.ndarray]) -> tuple[SegmentationResult, tuple[Joint, ...]]:
    solver = Solver(mesh_of([*CHEST, *more])[0])
    found = solver.parts()
    return found, solver.joints(found.segmentation).joints


@pytest.fixture(scope="module")
def alone() -> tuple[SegmentationResult, tuple[Joint, ...]]:
    return solution()


@pytest.mark.parametrize("side", [0.6, 3.0])
def test_a_chest_on_a_ground_has_the_drawers_that_it_has_without_one(side: float, alone) -> None:
    result, joints = alone
    ground_result, ground_joints = solution(box((-side, -side, -0.02), (side, side, 0)))
    parts, on_ground = result.segmentation, ground_result.segmentation
    assert GROUND_WARNING not in result.warnings
    assert GROUND_WARNING in ground_result.warnings
    assert len(joints) == len(DRAWERS)
    count = len(parts.face_part)
    np.testing.assert_array_equal(on_ground.face_part[:count], parts.face_part)
    assert (on_ground.face_part[count:] == 0).all()
    for joint, other in zip(joints, ground_joints, strict=True):
        assert other.type is joint.type
        np.testing.assert_allclose(other.axis, joint.axis, atol=1e-6)


def test_a_lid_in_a_floor_is_found() -> None:
    floor = [((-1, -1, 0), (1, -0.31, 0.03)), ((-1, 0.31, 0), (1, 1, 0.03)), ((-1, -0.31, 0), (-0.31, 0.31, 0.03))]
    plate = trimesh.boolean.union([trimesh.creation.box(bounds=b) for b in [*floor, ((0.31, -0.31, 0), (1, 0.31, 0.03))]])
    mesh = mesh_of([(plate.vertices, plate.faces), box((-0.3, -0.3, 0), (0.3, 0.3, 0.03))])[0]
    assert ground_faces(mesh).any()
    assert len(solve(mesh)[1]) == 1
