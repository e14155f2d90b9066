"""Test that results of geometry cannot be changed, and are compared by identity, as arrays have no single truth value."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from assets import CUBE, CUBE_FACES, assert_fixed, box, mesh_of
from rigid import shape_of

from anymesh.config import PatchConfig
from anymesh.geometry.boxes import box_in_frame
from anymesh.geometry.circles import outline_about
from anymesh.geometry.patches import DividedSurface
from anymesh.geometry.raycast_ import RayScene
from anymesh.geometry.sampling import sample_surface
from anymesh.geometry.surface import mesh_surface
from anymesh.geometry.sweep import Obstacles
from anymesh.geometry.topology import components, edge_pairs
from anymesh.types import JointType, Motion


def obstacles() -> Obstacles:
    return Obstacles(shape_of(box((0, 0, 0), (1, 1, 1))), shape_of(box((2, 0, 0), (3, 1, 1))), 0.01)


def divided() -> DividedSurface:
    shape = shape_of(box((0, 0, 0), (1, 1, 1)))
    return DividedSurface(shape, np.arange(12), np.zeros(12, np.int64), np.zeros((0, 2), np.int64), 1.0)


def passage() -> Any:
    amounts = np.linspace(0, 1, 4)[None]
    return obstacles().passages([Motion(JointType.PRISMATIC, np.eye(3)[0], np.zeros(3), "")], amounts, amounts)[0]


MAKERS = {
    "box": lambda: box_in_frame(CUBE, np.eye(3)),
    "outline": lambda: outline_about(CUBE, np.eye(3)[2]),
    "edges": lambda: edge_pairs(CUBE, CUBE_FACES),
    "components": lambda: components(CUBE, CUBE_FACES),
    "hits": lambda: RayScene(CUBE, CUBE_FACES).first_hit(np.full((1, 3), -1.0), np.ones((1, 3))),
    "surface hits": lambda: RayScene(CUBE, CUBE_FACES).surface_hits(np.full(3, -1.0), np.ones((1, 3), np.float32)),
    "samples": lambda: sample_surface(CUBE[CUBE_FACES], 10, 0),
    "known faces": lambda: shape_of((CUBE, CUBE_FACES)).prepared().known,
    "triangles": lambda: shape_of((CUBE, CUBE_FACES)),
    "mesh surface": lambda: mesh_surface(mesh_of([(CUBE, CUBE_FACES)])[0]),
    "divided surface": divided,
    "object": lambda: divided().simplified(PatchConfig()),
    "obstacles": obstacles,
    "passage": passage,
}


@pytest.mark.parametrize("make", MAKERS.values(), ids=MAKERS)
def test_a_result_cannot_be_changed_and_equals_itself_only(make: Callable[[], Any]) -> None:
    assert_fixed(make)
