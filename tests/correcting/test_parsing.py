"""Operations as text: what each value means, in which order they apply, and what is refused with the valid values."""

import numpy as np
import pytest
from assets import cabinet, pistol

from anymesh.correcting import (
    ChangeType,
    ChooseMotion,
    Confirm,
    CorrectionError,
    MergeParts,
    Relabel,
    RemovePart,
    SetLimits,
    apply,
    corrections_of,
)
from anymesh.correcting.listing import changed_rows, motion_rows, named_part, region_rows, regions_of
from anymesh.correcting.operations import OPERATIONS, operations_text
from anymesh.correcting.parsing import HANDLERS, axis_of, limits_of, quantity
from anymesh.types import Asset, JointType

HINGE, SLIDE = JointType.REVOLUTE, JointType.PRISMATIC


def corrected(asset: Asset, part: str | None, **operations) -> Asset:
    for c in corrections_of(asset, part, operations):
        asset = apply(asset, c)
    return asset


def of(asset: Asset, part: str):
    return next(j for j in asset.joints if j.child == part)


@pytest.mark.parametrize(
    ("value", "kind", "limits"),
    [
        ("0,110", HINGE, (0, np.deg2rad(110))),
        ("-20..90", HINGE, (np.deg2rad(-20), np.deg2rad(90))),
        ("0, 1.5rad", HINGE, (0, 1.5)),
        ("0.5rad,90 deg", HINGE, (0.5, np.pi / 2)),
        (110, HINGE, (0, np.deg2rad(110))),
        ("-90", HINGE, (-np.pi / 2, 0)),
        ((0, 110), HINGE, (0, np.deg2rad(110))),
        ("0,0.4", SLIDE, (0, 0.4)),
        ("0,40cm", SLIDE, (0, 0.4)),
        ("-20,400 mm", SLIDE, (-0.02, 0.4)),
        ("-2cm,0.1", SLIDE, (-0.02, 0.1)),
        ("40cm", SLIDE, (0, 0.4)),
        ([-0.02, 0], SLIDE, (-0.02, 0)),
        (("0", "40cm"), SLIDE, (0, 0.4)),
    ],
)
def test_numbers_are_degrees_or_metres_and_may_have_units(value, kind, limits):
    np.testing.assert_allclose(limits_of(value, kind, 1.0), limits)


@pytest.mark.parametrize(
    ("value", "kind", "told"),
    [
        ("0,40cm", HINGE, "'0cm' is not an angle"),
        ("0,90deg", SLIDE, "is not a length; valid are numbers such as 0.4, 40cm"),
        ("0,40", SLIDE, "such as 0,40cm"),
        ("0,1,2", HINGE, "a lower and an upper one"),
        ("nan", HINGE, "not an angle"),
        ("", HINGE, "not an angle"),
        ("a" * 20_000, HINGE, "at most"),
    ],
)
def test_limits_that_are_none_are_refused(value, kind, told):
    with pytest.raises(CorrectionError) as error:
        limits_of(value, kind, 1.0)
    assert told in str(error.value)


def test_axes_are_letters_or_numbers():
    np.testing.assert_array_equal(axis_of("-z"), (0, 0, -1))
    np.testing.assert_array_equal(axis_of("+X"), (1, 0, 0))
    np.testing.assert_array_equal(axis_of([0, 0.6, -0.8]), (0, 0.6, -0.8))
    for wrong in ("up", "1,2", "1,2,x", "zz"):
        with pytest.raises(CorrectionError, match="x, -z or"):
            axis_of(wrong)
    assert quantity("50cm", SLIDE) == 0.5


def test_every_operation_has_one_meaning_and_one_text():
    assert [o.name for o in OPERATIONS if o.name != "undo"] == list(HANDLERS)
    assert all(o.name in operations_text() for o in OPERATIONS)


def test_a_part_is_known_by_its_joint_and_wrong_names_list_the_valid_ones():
    assert named_part(cabinet(), "hinge") == named_part(cabinet(), "door") == "door"
    with pytest.raises(CorrectionError, match="no part or joint 'dor'; the parts are base, door, drawer, knob"):
        corrections_of(cabinet(), "dor", {"flip": True})
    with pytest.raises(CorrectionError, match="name the part"):
        corrections_of(cabinet(), None, {"flip": True})


def test_operations_apply_in_one_order_whatever_the_order_given():
    asset = corrected(
        cabinet(), "door", rename="flap", limits="0,90", flip=True, axis="y", type="hinge", label="flap", right=False
    )
    found = of(asset, "flap")
    np.testing.assert_array_equal(found.axis, (0, -1, 0))
    np.testing.assert_allclose(found.limits, (0, np.pi / 2))
    slid = of(corrected(cabinet(), "hinge", limits="0,30cm", type="slide", axis="-y"), "door")
    assert (slid.type, slid.limits) == (SLIDE, (0, 0.3))
    moved = of(corrected(cabinet(), "door", through="0,0,50cm"), "door")
    np.testing.assert_allclose(moved.origin[:2], 0)
    np.testing.assert_array_equal(moved.axis, of(cabinet(), "door").axis)


def test_what_is_so_already_is_no_correction():
    assert corrections_of(cabinet(), "door", {"type": "hinge", "parent": "base", "label": "door", "rename": "door"}) == ()
    given = {"limits": "0,90", "type": "hinge", "flip": False, "motion": None}
    assert [type(c) for c in corrections_of(cabinet(), "door", given)] == [SetLimits]


def test_the_motion_with_a_number_is_the_one_listed(monkeypatch):
    sides = ((0.6, 0.8), (0.0, 0.1))
    free = tuple(ChooseMotion("door", HINGE, (0.0, 0.0, 1.0), (x, 0.0, 0.3), (0.0, 1.9), share, "free") for x, share in sides)
    for module in ("parsing", "listing"):
        monkeypatch.setattr(f"anymesh.correcting.{module}.ranked_motions", lambda asset, part: free)
    rows = motion_rows(cabinet(), "door")
    assert [r["number"] for r in rows] == list(range(1, len(rows) + 1))
    assert [r["motion"] for r in rows] == ["hinge right, vertical", "hinge left, vertical"]
    (chosen,) = corrections_of(cabinet(), "door", {"motion": 2})
    assert isinstance(chosen, ChooseMotion)
    assert chosen.confidence == rows[1]["share"]
    for wrong in ("0", "99", "-1", "first"):
        with pytest.raises(CorrectionError, match=r"valid are 1 \(hinge"):
            corrections_of(cabinet(), "door", {"motion": wrong})


def test_removing_and_merging_say_where_the_faces_went():
    assert corrections_of(cabinet(), "knob", {"remove": True}) == (RemovePart("knob"),)
    rows = changed_rows(cabinet(), corrected(cabinet(), "knob", remove=True))
    assert [(r["part"], r["change"]) for r in rows] == [("drawer", "changed"), ("knob", "removed, now of drawer")]
    assert corrections_of(cabinet(), None, {"merge": ("knob", "hinge")}) == (MergeParts("knob", "door"),)
    with pytest.raises(CorrectionError, match="two parts"):
        corrections_of(cabinet(), None, {"merge": "knob"})


def test_what_changed_is_listed_once_per_part():
    rows = changed_rows(cabinet(), corrected(cabinet(), "door", rename="flap", flip=True))
    assert [(r["part"], r["change"]) for r in rows] == [("flap", "was door")]
    rows = changed_rows(cabinet(), corrected(cabinet(), "door", right=True))
    assert [(r["part"], r["change"], r["confidence"]) for r in rows] == [("door", "changed", 1.0)]
    assert changed_rows(cabinet(), cabinet()) == []


def test_regions_of_a_part_become_a_new_part_that_moves():
    rows = region_rows(cabinet(), "base")
    assert [r["kind"] for r in rows] == 6 * ["piece"] + 36 * ["patch"]
    shelf = next(r for r in rows if r["size"] == [0.56, 0.37, 0.02] and r["middle"][2] == 0.61)
    asset = corrected(cabinet(), "base", new_part="tray_1", region=shelf["number"], type="slide", axis="-y", limits="0,20cm")
    found = of(asset, "tray_1")
    assert (found.type, found.parent, found.limits) == (SLIDE, "base", (0, 0.2))
    assert asset.segmentation.parts[-1].label == "tray"
    assert changed_rows(cabinet(), asset)[0]["change"] == "new"
    by_faces = corrected(cabinet(), "base", new_part="tray_1", faces="60-71")
    np.testing.assert_array_equal(by_faces.segmentation.face_part, asset.segmentation.face_part)
    assert len(regions_of(cabinet(), "door")) == 6  # the sides of a single component


@pytest.mark.parametrize(
    ("operations", "told"),
    [
        ({"explode": True}, "unknown operation 'explode'; valid are merge"),
        ({"limits": True}, "limits needs a value: A,B"),
        ({"type": "wobbly"}, "valid are revolute"),
        ({"parent": "x"}, "the parts are"),
        ({"new_part": "x"}, "regions, or those of its faces"),
        ({"region": "1"}, "those of a new part"),
        ({"new_part": "x", "region": "9-1"}, "valid are 1 to"),
        ({"new_part": "x", "faces": "0-99999999999"}, "valid are 0 to"),
        ({"through": "1,2"}, "is not a point"),
        ({"press": "0"}, "more than 0"),
    ],
)
def test_values_that_make_no_sense_are_refused(operations, told):
    with pytest.raises(CorrectionError) as error:
        corrections_of(cabinet(), "door", operations)
    assert told in str(error.value)


@pytest.mark.parametrize("axis", [(0, 1, 0), (0, -1, 0)])
def test_a_part_that_is_pressed_moves_in_whichever_way_its_axis_pointed(axis):
    found = of(corrected(pistol(axis), "trigger", press="5mm", label="trigger"), "trigger")
    np.testing.assert_array_equal(found.axis, (0, 1, 0))
    assert found.limits == (0, 0.005)
    turned = apply(pistol(axis), ChangeType("trigger", HINGE))
    np.testing.assert_array_equal(of(corrected(turned, "trigger", press="5mm"), "trigger").axis, (0, 1, 0))


def test_copies_get_what_the_part_got_in_the_same_command():
    given = {"right": True, "label": "front", "limits": "0,20cm"}
    assert [type(c) for c in corrections_of(cabinet(), "drawer", given)] == [SetLimits, Relabel, Confirm]
    with pytest.raises(CorrectionError, match="no copy"):
        corrections_of(cabinet(), "drawer", {"copies": True})
