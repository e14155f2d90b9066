"""Test that a face has the superpoint of most of its points, and the mean colour of a superpoint."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from assets import box, mesh_of
from rows import row_cloud

from anymesh.prompted.grounding.regions import face_regions
from anymesh.segmentation.divide import object_shape

SIX = mesh_of([box((0, 0, 0), (1, 1, 1))])[0]


def regions(faces: list[int], superpoint: list[int], grey: list[float], borders: list[tuple[int, int]]) -> list[int]:
    """Return the regions of the first faces of a cube from points with a face, a superpoint and a brightness (0..1)."""
    count = max(superpoint) + 1
    base = row_cloud([0.0] * count, each=1)
    colors = np.rint(255 * np.repeat(np.array(grey)[:, None], 3, 1)).astype(np.uint8)
    cloud = replace(
        base, points=np.zeros((len(faces), 3)), normals=np.zeros((len(faces), 3)), colors=colors, faces=np.array(faces),
        superpoint=np.array(superpoint), borders=np.array(borders, np.int64).reshape(-1, 2),
    )  # fmt: skip
    found = face_regions(object_shape(SIX), cloud)
    return found[: max(faces) + 1].tolist()


def test_a_face_has_the_region_of_most_of_its_points() -> None:
    """Two superpoints of different colours share the middle one of three faces."""
    faces, superpoint = [0, 0, 1, 1, 1, 2], [0, 0, 0, 1, 1, 1]
    assert regions(faces, superpoint, [0.0, 0, 0, 1, 1, 1], [(0, 1)]) == [0, 1, 1]
    assert regions(faces, [0, 0, 0, 0, 1, 1], [0.0, 0, 0, 0, 1, 1], [(0, 1)]) == [0, 0, 1]


@pytest.mark.parametrize("face", [0, 1])
def test_at_a_tie_the_first_region_is_used(face: int) -> None:
    found = regions([0, 1, face, face, 2], [0, 1, 0, 1, 1], [0.0, 1, 0, 1, 1], [(0, 1)])
    assert found[2] == 1
    assert found[1 - face] == [1, 0][face]
