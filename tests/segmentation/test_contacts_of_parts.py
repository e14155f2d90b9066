"""Test contacts between patches, and dependent groups."""

import numpy as np
import pytest
import trimesh
from assets import box, mesh_of
from geometry.rigid import shape_of
from scipy.spatial.distance import cdist

from anymesh.motion.part_context import connecting_area
from anymesh.runtime import Deadline
from anymesh.segmentation.contacts import (
    PROBES,
    TOUCH_RATIO,
    Contacts,
    area_in_contact,
    dominated_by,
    find_contacts,
    gap_within,
)
from anymesh.segmentation.divide import object_shape

BLOCK = box((0, 0, 0), (1, 1, 1))


def contacts(*boxes) -> Contacts:
    return find_contacts(object_shape(mesh_of(boxes)[0]))


def gaps(a: np.ndarray, b: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    between = cdist(a, b)
    return between.min(1), between.min(0)


def test_the_connecting_area_of_two_boxes_is_their_common_face() -> None:
    boxes = [BLOCK, box((1, 0.25, 0.25), (2, 0.75, 0.75))]
    whole = object_shape(mesh_of(boxes)[0])
    a, b = (whole.of(np.flatnonzero(whole.patch == k)).samples.points for k in (0, 1))
    in_a, in_b, threshold = connecting_area(*gaps(a, b), 0.05)
    assert threshold == 0.05
    for points in (a[in_a], b[in_b]):
        assert len(points) > 3
        assert (np.abs(points[:, 0] - 1) <= 0.05).all()
        assert (points[:, 1:] > 0.2 - 1e-9).all()
        assert (points[:, 1:] < 0.8 + 1e-9).all()


def test_the_threshold_is_doubled_until_a_point_is_near() -> None:
    a, b = np.zeros((1, 3)), np.array([[0, 0, 1.0], [0, 0, 9.0]])
    in_a, in_b, threshold = connecting_area(*gaps(a, b), 0.3)
    assert (in_a.tolist(), in_b.tolist(), threshold) == ([True], [True, False], 1.2)
    with pytest.raises(ValueError, match="positive, found 0"):
        connecting_area(*gaps(a, b), 0.0)


@pytest.mark.parametrize("seed", range(8))
def test_a_gap_is_the_smallest_distance_of_all_points(seed: int) -> None:
    rng = np.random.default_rng(seed)
    balls = [trimesh.creation.icosphere(2, radius) for radius in rng.uniform(0.2, 1.5, 2)]
    a, b = contacts(*((ball.vertices + rng.uniform(-1.5, 1.5, 3), ball.faces) for ball in balls)).shapes
    points = [p[:: max(1, len(p) // PROBES)] for p in (a.corners, a.samples.points)]
    gap = float(b.tree.distance(np.concatenate(points)).min())
    assert gap_within(a, b, 100.0) == gap
    assert gap_within(a, b, 100.0, enough=gap) == gap
    assert gap <= gap_within(a, b, 100.0, enough=gap + 0.2) < gap + 0.2


def test_touching_boxes_are_one_body_that_touches_at_the_face() -> None:
    found = contacts(BLOCK, box((1, 0, 0), (3, 1, 1)))
    assert found.touch.tolist() == [[0, 1]]
    assert len(found.near) == 0
    assert found.touching_group[0] == found.touching_group[1]
    assert found.area[0, 1] == pytest.approx(1, abs=0.1)  # sampled with 500 points
    assert found.area[1, 0] == pytest.approx(1, abs=0.1)  # sampled with 500 points


@pytest.mark.parametrize("size", [0.02, 0.2])
def test_the_area_in_contact_is_measured_on_a_large_plate_as_on_a_small_knob(size: float) -> None:
    """On the plate, it includes what is within the tolerance around the knob, on the knob the bottom of its walls."""
    plate, knob = box((-5, -3, -0.1), (5, 3, 0)), box((1, 1, 0), (1 + size, 1 + size, size))
    reach = 2 * TOUCH_RATIO * float(np.linalg.norm([10, 6, 0.1 + size]))
    found, walls = contacts(plate, knob).area, 4 * size * min(reach, size)
    assert found[0, 1] == pytest.approx(size**2 + 4 * size * reach + np.pi * reach**2, rel=0.1)
    assert found[1, 0] == pytest.approx(size**2 + walls, rel=0.1)


@pytest.mark.parametrize("far", [0.0, 0.5], ids=["a point", "a line"])
def test_what_has_no_area_has_none_in_contact_and_a_plate_has_little_on_it(far: float) -> None:
    plate = shape_of(box((-5, -3, -0.1), (5, 3, 0)))
    needle = shape_of((np.array([[1, 1, 0], [1 + far, 1, 0], [1 + far, 1, 0]]), np.array([[0, 1, 2]])))
    assert area_in_contact(needle, plate, 0.01) == 0
    assert area_in_contact(plate, needle, 0.01) == pytest.approx(np.pi * 0.01**2 + 2 * far * 0.01, rel=0.2)


def test_a_clearance_keeps_bodies_apart_and_a_wide_one_makes_them_strangers() -> None:
    near = contacts(BLOCK, box((1.01, 0, 0), (2, 1, 1)))
    far = contacts(BLOCK, box((1.5, 0, 0), (2, 1, 1)))
    assert (near.touch.tolist(), near.near.tolist()) == ([], [[0, 1]])
    assert (far.touch.tolist(), far.near.tolist()) == ([], [])
    assert near.touching_group[0] != near.touching_group[1]


def test_boxes_that_cross_touch() -> None:
    for x in np.linspace(0.1, 0.8, 8):  # points of one are near the other by chance only
        assert contacts(BLOCK, box((x, 0.4, -1), (x + 0.1, 0.5, 2))).touch.tolist() == [[0, 1]]


def test_what_reaches_the_root_only_through_a_piece_hangs_on_it() -> None:
    """The scene is a tower 0-1-2, a bridge 3 from the root to 1, and a separate piece 4."""
    found = contacts(
        box((0, 0, 0), (3, 1, 1)),
        box((0, 0, 1), (1, 1, 2)),
        box((0, 0, 2), (1, 1, 3)),
        box((1, 0, 1), (2, 1, 1.5)),
        box((9, 0, 0), (9.5, 1, 1)),
    )
    dominated = dominated_by(found, np.arange(5), root=0)
    assert {k: sorted(v) for k, v in dominated.items()} == {0: [0, 1, 2, 3, 4], 1: [1, 2], 2: [2], 3: [3], 4: [4]}


def test_after_the_deadline_no_contact_is_measured() -> None:
    late = Deadline(1e-9)
    whole = object_shape(mesh_of([BLOCK, box((1, 0, 0), (2, 1, 1)), box((2.01, 0, 0), (3, 1, 1))])[0])
    found = find_contacts(whole, late)
    assert len(found.shapes) == 3
    assert (len(found.touch), len(found.near), found.area) == (0, 0, {})
    assert late.warnings() == ("time limit of 1e-09 s: segmentation: some contacts were not measured",)
    in_time = Deadline(600.0)
    found = find_contacts(whole, in_time)
    assert (found.touch.tolist(), found.near.tolist(), in_time.warnings()) == ([[0, 1]], [[1, 2]], ())


def test_a_deadline_during_the_search_for_clearances_ends_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """A row of boxes a hair apart, of which no two touch."""
    measured: list[int] = []
    monkeypatch.setattr(Deadline, "late", lambda self, share: len(measured) >= 4)
    monkeypatch.setattr(
        "anymesh.segmentation.contacts.gap_within", lambda *a, **k: (measured.append(1), gap_within(*a, **k))[1]
    )
    late = Deadline()
    found = find_contacts(object_shape(mesh_of([box((1.01 * k, 0, 0), (1.01 * k + 1, 1, 1)) for k in range(9)])[0]), late)
    assert len(measured) == 4
    assert len(found.near) == 2
    assert len(late.warnings()) == 1
