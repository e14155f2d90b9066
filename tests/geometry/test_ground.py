"""Test which component is the ground of an object: a level one below all others that reaches beyond them on all sides."""

import numpy as np
import pytest
from assets import box, mesh_of

from anymesh.geometry.surface import ground_faces

CABINET = [box((-0.3, -0.2, 0), (0.3, 0.2, 0.8)), box((-0.3, -0.22, 0), (0, -0.2, 0.8))]


def ground(*shapes: tuple[np.ndarray, np.ndarray]) -> list[int]:
    """Return the shapes of which all faces are ground, and check that no other face is."""
    mesh = mesh_of(list(shapes))[0]
    faces = ground_faces(mesh).reshape(len(shapes), -1)
    assert (faces.all(1) == faces.any(1)).all()
    return np.flatnonzero(faces.all(1)).tolist()


@pytest.mark.parametrize(("low", "high"), [((-1, -1, -0.02), (1, 1, 0)), ((-0.37, -0.3, -0.02), (0.37, 0.3, 0.01))])
def test_a_slab_that_reaches_beyond_a_cabinet_is_its_ground(low: tuple, high: tuple) -> None:
    assert ground(*CABINET, box(low, high)) == [2]


@pytest.mark.parametrize(
    ("low", "high"),
    [
        ((-0.3, -0.22, -0.02), (0.3, 0.2, 0)),  # a plinth as wide as the cabinet
        ((-1, -0.22, -0.02), (1, 0.2, 0)),  # a shelf that is no deeper
        ((-0.1, -0.1, -0.02), (1.9, 1.9, 0)),  # beside it
        ((-1, -1, -0.2), (1, 1, 0)),  # a pedestal
        ((-1, -1, 0.8), (1, 1, 0.82)),  # a table top
    ],
)
def test_what_is_as_small_thick_or_high_is_no_ground(low: tuple, high: tuple) -> None:
    assert ground(*CABINET, box(low, high)) == []


def test_an_object_of_one_component_has_no_ground() -> None:
    assert ground(box((-1, -1, 0), (1, 1, 0.02))) == []
