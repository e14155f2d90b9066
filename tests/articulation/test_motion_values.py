"""Test the features of motions of a door, a drawer, a lid and a wheel against values worked out by hand.

The sizes are those of `scenes.py`. The door is 0.596 x 0.02 x 0.796 m, 2 mm in front of a case of 0.6 x 0.4 x 0.8 m, and the
bar of its handle is 0.07 m in front of the case.
"""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from assets import box, mesh_of
from made import X, Y, Z, context_of, slide, turn
from scenes import door, drawer, lid, wheel
from test_motion_features import LEFT_EDGE, OUT, features
from trimesh.creation import cylinder

from anymesh.articulation.candidate_motions import contact_points
from anymesh.articulation.evidence import contact_retention, hinge_support
from anymesh.articulation.motion_features import MISSING, adjacent_sides, line_features
from anymesh.articulation.part_contexts import find_barrel_candidates
from anymesh.segmentation.divide import object_shape

DIAGONAL = np.sqrt(0.6**2 + 0.47**2 + 0.8**2)  # [m] of the case with the door and its handle
PANEL = 2 * (0.596 * 0.796 + 0.596 * 0.02 + 0.796 * 0.02)  # [m^2]
BAR = 2 * (0.015 * 0.01 + 0.015 * 0.2 + 0.01 * 0.2) + 2 * 2 * (0.015 * 0.038 + 0.015 * 0.012 + 0.038 * 0.012)


@cache
def of_door() -> list[dict[str, float]]:
    return features(door("right"), LEFT_EDGE)


def test_the_shape_and_place_of_a_door() -> None:
    assert of_door()[0] == pytest.approx(of_door()[0] | {
        "size": np.linalg.norm([0.596, 0.068, 0.796]) / DIAGONAL,
        "thinness": 0.02 / 0.596,
        "width over length": 0.596 / 0.796,
        "thickness": 0.02 / DIAGONAL,
        "opening direction up": 0,
        "visibility": 1,
        "insertion depth": 0,
        "log2 height over width": np.log2(0.796 / 0.596),
        "height": 0.5,
        "two pivots": 0,
        "handle": 1,
        "handle size": 0.2 / np.linalg.norm([0.596, 0.02, 0.796]),
        "handle off the middle": (0.5625 - 0.3) / 0.298,
        "bar handle": 1,
        "log10 gap": np.log10(0.002 / DIAGONAL),
        "parts": 0,
        "object height": 0.8 / 0.6,
        "solid": 1,
        "horizontal offset": 1 - 2 * 0.034 / 0.47,
        "area over box": (PANEL + BAR) / PANEL,
    }, abs=0.002)  # fmt: skip


def test_the_hinge_line_of_a_door() -> None:
    """The line is in the middle of the panel's left rim, and the panel reaches 0.596 m from it."""
    assert of_door()[1] == pytest.approx(of_door()[1] | {
        "prismatic": 0, "along length": 1, "along width": 0, "along thickness": 0, "along opening direction": 0, "vertical": 1,
        "upwards": MISSING, "opening": 1, "free both ways": 0, "outward": 1,
        "off along length": 0, "off along width": 1, "off along thickness": 0, "off the part": 0,
        "another part along": 0, "support opposite": 1, "pair": 0, "outer": 0, "above": 0,
        "handle side": (0.5625 - 0.3) / 0.298,
        "handle off the hinge's middle": 0,
        "handle distance": 0.5605 / 0.596,
        "log2 reach over length": np.log2(0.596 / 0.796),
        "balance": 0.5,
        "off the parent's border": 0.002 / DIAGONAL,
        "away from the middle": 0.177 / DIAGONAL,
        "bar handle along": 1,
        "contact along the line": 1,
        "contact middle off the line": 0.5,
    }, abs=0.02)  # fmt: skip


@pytest.mark.parametrize(("z", "above"), [(0.002, -1.0), (0.599, 0.5), (0.798, 1.0), (0.9, 1.0)])
def test_a_line_across_a_door_is_at_a_height_of_it(z: float, above: float) -> None:
    (found, _) = features(door("right"), turn(X, (0.3, -0.012, z)))
    assert found["above"] == pytest.approx(above, abs=1e-6)
    assert found["handle off the hinge's middle"] == pytest.approx((0.5625 - 0.3) / 0.298, abs=0.02)
    assert found["vertical"] == 0


def test_a_drawer_that_slides_out() -> None:
    """Its box is 0.35 m deep between 25 mm and 0.2 m of height, in a case of 0.28 m; it may leave the case."""
    out, back = features(drawer(), OUT, "slide")
    diagonal = np.linalg.norm([0.6, 0.47, 0.28])
    size = np.linalg.norm([0.59, 0.42, 0.27])
    expected = {
        "size": size / diagonal, "prismatic": 1, "along opening direction": 1, "outward": 1, "vertical": 0, "upwards": 0,
        "closing": 0, "free both ways": 0, "captured": 0, "guided": 0.75,
        "insertion depth": 0.35 / 0.27,
        "depth": 0.35 / 0.27,
        "log2 height over width": np.log2(0.27 / 0.59),
        "object height": 0.28 / 0.6,
        "handle off the middle": 0.0015 / 0.135,
        "opening": 2, "room over extent": 2 * size / 0.42,  # swept to twice its size
    }  # fmt: skip
    # the handle is found at the top of its bar
    assert out == pytest.approx(out | expected, abs=0.11)
    assert (back["outward"], back["opening"], back["closing"]) == (-1, out["closing"], out["opening"])
    assert (back["depth"], back["guided"]) == (out["depth"], out["guided"])
    assert back["away from the middle"] == -out["away from the middle"]


def test_a_lid_about_its_back_edge() -> None:
    """The plate is 0.6 x 0.4 x 0.019 m, 1 mm above a box of 0.3 m, with a tab of 25 mm in front."""
    (_, up) = features(lid(), turn(X, (0.3, 0.4, 0.301)))
    diagonal = np.linalg.norm([0.6, 0.425, 0.32])
    expected = {
        "opening direction up": 1, "log2 height over width": 0, "height": 0.3105 / 0.32,
        "along length": 1, "vertical": 0, "above": -1,
        "outward": 1, "initial slope": 1, "opening": 1, "closing": 0,
        "off along length": 0, "off along width": 1, "off along thickness": 1,
        "hinge support": 1, "support opposite": 0,  # the line mirrored at its center is 0.02 m in front, at its top
        "handle side": 1, "bar handle": 0, "bar handle along": MISSING,
        "log10 gap": np.log10(0.001 / diagonal), "log2 reach over length": np.log2(0.425 / 0.6),
        "handle distance": 0.4 / 0.425,
    }  # fmt: skip
    assert up == pytest.approx(up | expected, abs=0.03)


def test_a_wheel_about_its_axle() -> None:
    """The disc of radius 0.1 m and 0.03 m on an axle of radius 0.03 m, 2 cm in front of a block of 0.4 x 0.2 x 0.2 m."""
    (about, _) = features(wheel(), turn(Y, (0, -0.035, 0.2)), "round")
    diagonal = np.linalg.norm([0.4, 0.28, 0.2])
    expected = {
        "size": np.linalg.norm([0.2, 0.2, 0.03]) / diagonal, "roundness": 1,
        "height over radius": 0.3, "log2 height over width": 0,
        "thickness": 0.03 / diagonal, "height": 0.5, "horizontal offset": 1 - 2 * 0.045 / 0.28,
        "handle": 0,
        "along thickness": 1, "balance": 0, "contact off the line": 0.3, "contact middle off the line": 0, "outward": 0,
        "log2 reach over length": np.log2(0.1 / 0.03), "off the part": 0, "contact retention": 1, "free both ways": 1,
        "handle distance": MISSING, "off the parent's border": 0.1 / diagonal,
        "contact proximity": 0.7,
    }  # fmt: skip
    assert about == pytest.approx(about | expected, abs=0.03)


RAIL = [box((0, 0, 0), (1, 0.1, 0.1))]
CAR = [box((0.1, 0, 0.1), (0.5, 0.1, 0.2))]  # stands on the rail


@pytest.mark.parametrize(("axis", "sign", "retained"), [(X, 1, 1.0), (X, -1, 0.75), (Z, 1, 0.0), (Y, 1, 0.55)])
def test_a_slide_keeps_the_contact_that_stays_on_its_rail(axis: np.ndarray, sign: int, retained: float) -> None:
    """The car moves by half of its extent: 0.2 m along the rail, 5 cm across it."""
    (found,) = contact_retention(context_of(CAR, RAIL), [slide(axis)], [sign])
    assert found == pytest.approx(retained, abs=0.1)


def test_a_hinge_keeps_the_contact_at_its_line() -> None:
    """A plate that stands on a board by its rim of 2 cm turns by 30 degrees about it, and about a line above it."""
    context = context_of([box((0, 0, 0.1), (1, 0.02, 0.6))], [box((0, -0.5, 0), (1, 0.5, 0.1))])
    low, high = contact_retention(context, [turn(X, (0, 0.01, 0.1)), turn(X, (0, 0.01, 0.6))], [1, 1])
    assert low > 0.9 > 0.1 > high
    assert contact_retention(context, [], []).tolist() == []


def test_the_support_of_a_line_is_the_share_of_it_near_the_parent_or_another_part() -> None:
    """The parent is along 40 % of the line at one side, another part along 70 % of it, both 1 cm away."""
    plate, other = [box((0, 0, 0), (1, 0.02, 0.5))], [box((0.3, 0.03, -0.02), (1, 0.05, 0.02))]
    context = context_of(plate, [box((0, 0.03, -0.3), (0.4, 0.05, 0.3))], other)
    here, above, up = hinge_support(context, [turn(X, (0.5, 0.01, 0)), turn(X, (0.5, 0.01, 0.5)), turn(Z, (0, 0.01, 0))])
    assert here == pytest.approx([0.4, 0.7, 0], abs=0.06)
    assert above == pytest.approx([0, 0, 0.4], abs=0.06)  # the line at the other side is the free one
    assert up[0] == pytest.approx(0.6, abs=0.15)
    assert hinge_support(context, []).shape == (0, 3)


def test_the_lever_arm_of_a_plate_on_its_rim() -> None:
    """The plate is 0.5 m high; its contact is at the line."""
    context = context_of([box((0, 0, 0), (1, 0.02, 0.5))], [box((0, -0.2, -0.02), (1, 0.2, 0))])
    lines = turn(X, (0.3, 0.01, 0)), turn(X, (0.3, 0.01, 0.5))
    near, far = (line_features(context, line, contact_points(context), adjacent_sides(context)) for line in lines)
    assert near["log2 reach over length"] == pytest.approx(np.log2(0.5 / 1), abs=0.02)
    assert near["contact proximity"] == pytest.approx(0.98, abs=0.015)
    assert far["contact proximity"] == pytest.approx(0.01, abs=0.02)


@pytest.mark.parametrize(("radius", "y", "found"), [(0.01, -0.02, True), (0.06, -0.02, False), (0.01, -0.3, False)])
def test_a_barrel_is_thin_and_near_both(radius: float, y: float, found: bool) -> None:
    barrel = cylinder(radius, 0.2, sections=16)
    barrel.apply_translation((0, y - radius, 0.5))
    pieces = [door("right")["leaf"][0], *door("right")["base"], (np.asarray(barrel.vertices), np.asarray(barrel.faces))]
    mesh, piece = mesh_of(pieces)
    whole = object_shape(mesh, 0, labels=(piece > 0).astype(np.int64))
    part, parent = (whole.of(np.flatnonzero((piece[whole.source] > 0) == side)) for side in (False, True))
    assert len(find_barrel_candidates(whole, part, parent)) == found
