"""Test that a material's name names a piece if it is recognized and not that of the whole object."""

import numpy as np
import pytest
from assets import box, mesh_of

from anymesh.pipeline.solving import Solver
from anymesh.types import Material

WALLS = [
    box((-0.3, 0.28, 0), (0.3, 0.3, 0.8)),
    box((-0.3, 0, 0), (-0.28, 0.28, 0.8)),
    box((0.28, 0, 0), (0.3, 0.28, 0.8)),
    box((-0.28, 0, 0), (0.28, 0.28, 0.02)),
    box((-0.28, 0, 0.78), (0.28, 0.28, 0.8)),
]
FRONT = box((-0.3, -0.02, 0), (0.3, 0, 0.8))  # a plate that covers the opening, without handle and clearance


@pytest.mark.parametrize(
    ("wood", "paint", "found"),
    [("wood", "Door_white", ["base", "door"]), ("wood", "paint_2", ["base"]), ("door_oak", "door_oak", ["base"])],
)
def test_a_front_in_a_material_named_door(wood: str, paint: str, found: list[str]) -> None:
    materials = (Material(wood),) if wood == paint else (Material(wood), Material(paint))
    number = np.repeat([0] * len(WALLS) + [len(materials) - 1], 12)
    mesh, _ = mesh_of([*WALLS, FRONT], number, materials=materials)
    segmentation = Solver(mesh).parts().segmentation
    assert [p.name for p in segmentation.parts] == found
