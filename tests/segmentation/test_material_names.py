"""Test that a material's name names a piece if it is recognized and not that of the whole object."""

import numpy as np
import pytest
from assets import box, mesh_of

from anymesh.pipeline.solving import Solver
from anymesh.types import Material, Segmentation

WALLS = [
    box((-0.3, 0.28, 0), (0.3, 0.3, 0.8)),
    box((-0.3, 0, 0), (-0.28, 0.28, 0.8)),
    box((0.28, 0, 0), (0.3, 0.28, 0.8)),
    box((-0.28, 0, 0), (0.28, 0.28, 0.02)),
    box((-0.28, 0, 0.78), (0.28, 0.28, 0.8)),
]
FRONT = box((-0.3, -0.02, 0), (0.3, 0, 0.8))  # a plate that covers the opening, without handle and clearance


def segmented(wood: str, paint: str) -> Segmentation:
    materials = (Material(wood),) if wood == paint else (Material(wood), Material(paint))
    number = np.repeat([0] * len(WALLS) + [len(materials) - 1], 12)
    mesh, _ = mesh_of([*WALLS, FRONT], number, materials=materials)
    return Solver(mesh).parts().segmentation


@pytest.mark.parametrize(("paint", "found"), [("Door_white", ["base", "door"]), ("paint_2", ["base"])])
def test_a_front_in_a_material_named_door(paint: str, found: list[str]) -> None:
    assert [p.name for p in segmented("wood", paint).parts] == found


def test_the_name_of_the_only_material_tells_nothing() -> None:
    named, plain = segmented("door_oak", "door_oak"), segmented("wood", "wood")
    assert named.face_part.tolist() == plain.face_part.tolist()
    assert [(p.name, p.confidence, p.reason) for p in named.parts] == [(p.name, p.confidence, p.reason) for p in plain.parts]
