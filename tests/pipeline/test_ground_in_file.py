"""Test that a ground in the file belongs to the base, and that the parts of the object on it are found as without it."""

import numpy as np
import pytest
import trimesh
from assets import box, mesh_of

from anymesh.geometry.surface import ground_faces
from anymesh.pipeline.results import SegmentationResult
from anymesh.pipeline.solving import GROUND_WARNING, Solver, solve
from anymesh.types import Joint

SIDES = [((-0.4, -0.3, 0), (-0.38, 0.3, 0.5)), ((0.38, -0.3, 0), (0.4, 0.3, 0.5)), ((-0.4, 0.28, 0), (0.4, 0.3, 0.5))]
LEVELS = [((-0.4, -0.3, z), (0.4, 0.3, z + 0.02)) for z in (0, 0.24, 0.48)]
DRAWERS = [((-0.37, -0.3, z), (0.37, 0.25, z + 0.19)) for z in (0.03, 0.27)]
KNOBS = [((-0.02, -0.33, z), (0.02, -0.3, z + 0.03)) for z in (0.12, 0.36)]
CHEST = [box(*corners) for corners in (*SIDES, *LEVELS, *DRAWERS, *KNOBS)]


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
