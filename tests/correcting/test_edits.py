"""Corrections as laws: what one changes, what it leaves, what its inverse gives back, and what is refused."""

from dataclasses import replace

import numpy as np
import pytest
from assets import cabinet, slanted
from hypothesis import given
from hypothesis import strategies as st

from anymesh.correcting import (
    ChangeParent,
    ChangeType,
    ChooseMotion,
    Confirm,
    CorrectionError,
    FaceSet,
    FlipSign,
    MergeParts,
    MoveFaces,
    Relabel,
    RemovePart,
    Rename,
    SetAxis,
    SetLimits,
    SplitComponents,
    SplitPart,
    apply,
    corrections_of,
)
from anymesh.correcting.listing import part_rows
from anymesh.types import Asset, JointType, Mimic


def joint(asset: Asset, part: str):
    return next(j for j in asset.joints if j.child == part)


def faces_of(asset: Asset, part: str) -> np.ndarray:
    names = [p.name for p in asset.segmentation.parts]
    return asset.segmentation.faces(names.index(part))


def same_joint(a, b) -> None:
    assert (a.name, a.type, a.parent, a.child, a.limits) == (b.name, b.type, b.parent, b.child, b.limits)
    np.testing.assert_allclose(a.axis, b.axis)
    np.testing.assert_allclose(a.origin, b.origin)


def test_a_face_set_is_a_set():
    assert FaceSet.of([3, 1, 2, 2, 9]) == FaceSet(((1, 4), (9, 10)))
    assert FaceSet.of(np.array([], int)) == FaceSet(())
    assert FaceSet.of([7]).numbers.tolist() == [7]


@given(st.sets(st.integers(0, 60)))
def test_a_face_set_gives_back_what_it_was_made_of(numbers):
    assert FaceSet.of(sorted(numbers)).numbers.tolist() == sorted(numbers)


@pytest.mark.parametrize(
    ("kind", "limits"),
    [(JointType.CONTINUOUS, None), (JointType.FIXED, None), (JointType.PRISMATIC, (0.0, None))],
)
def test_a_type_brings_limits_that_go_with_it(kind, limits):
    found = joint(apply(cabinet(), ChangeType("door", kind)), "door")
    assert found.type is kind
    assert (found.limits is None) == (limits is None)
    assert found.reason.startswith("corrected by hand")
    assert found.confidence == 1


def test_flipping_twice_is_nothing_and_once_opens_the_other_way():
    asset = cabinet()
    once = apply(asset, FlipSign("door"))
    np.testing.assert_array_equal(joint(once, "door").axis, -joint(asset, "door").axis)
    assert joint(once, "door").limits == joint(asset, "door").limits
    same_joint(joint(apply(once, FlipSign("door")), "door"), joint(asset, "door"))


def test_a_parent_changed_and_changed_back_is_as_before():
    asset = slanted()
    moved = apply(asset, ChangeParent("p4", "p0"))
    assert joint(moved, "p4").parent == "p0"
    same_joint(joint(apply(moved, ChangeParent("p4", "p3")), "p4"), joint(asset, "p4"))


@given(st.sampled_from(range(1, 5)), st.sampled_from(range(5)))
def test_the_tree_stays_a_tree_whatever_parent_is_asked_for(child, parent):
    asset = slanted()
    try:
        changed = apply(asset, ChangeParent(f"p{child}", f"p{parent}"))
    except CorrectionError:
        assert parent >= child or parent == child - 1  # itself, what it carries, or where it hangs already
    else:
        assert joint(changed, f"p{child}").parent == f"p{parent}"


def test_an_axis_is_made_unit_and_its_origin_level_with_the_part():
    found = joint(apply(cabinet(), SetAxis("door", (0.0, 0.0, 2.0), (0.1, -0.02, 5.0))), "door")
    corners = cabinet().mesh.triangles[faces_of(cabinet(), "door")].reshape(-1, 3)
    np.testing.assert_allclose(found.axis, (0, 0, 1))
    np.testing.assert_allclose(found.origin, (0.1, -0.02, (corners[:, 2].min() + corners[:, 2].max()) / 2))


def test_the_origin_of_a_slide_is_the_middle_of_its_part():
    found = joint(apply(cabinet(), SetAxis("drawer", (0.0, -1.0, 0.0), (9.0, 9.0, 9.0))), "drawer")
    corners = cabinet().mesh.triangles[faces_of(cabinet(), "drawer")].reshape(-1, 3)
    np.testing.assert_allclose(found.origin, (corners.min(0) + corners.max(0)) / 2)


def test_limits_are_taken_and_end_a_joint_that_had_none():
    assert joint(apply(cabinet(), SetLimits("door", -0.1, 1.2)), "door").limits == (-0.1, 1.2)
    endless = apply(cabinet(), ChangeType("door", JointType.CONTINUOUS))
    assert joint(apply(endless, SetLimits("door", 0.0, 1.0)), "door").type is JointType.REVOLUTE


def test_a_motion_chosen_is_the_joint():
    c = ChooseMotion("door", JointType.PRISMATIC, (0.0, -1.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.2), 0.3, "slides outwards")
    found = joint(apply(cabinet(), c), "door")
    assert (found.type, found.limits, found.confidence) == (JointType.PRISMATIC, (0.0, 0.2), 1)
    np.testing.assert_array_equal(found.axis, (0, -1, 0))


def test_split_and_merge_are_inverse():
    asset = cabinet()
    some = faces_of(asset, "door")[:4]
    split = apply(asset, SplitPart("door", FaceSet.of(some), "hinge", "hinge"))
    assert [p.name for p in split.segmentation.parts][-1] == "hinge"
    assert joint(split, "hinge").type is JointType.FIXED
    assert joint(split, "hinge").parent == "door"
    np.testing.assert_array_equal(faces_of(split, "hinge"), some)
    back = apply(split, MergeParts("hinge", "door"))
    np.testing.assert_array_equal(back.segmentation.face_part, asset.segmentation.face_part)
    assert back.segmentation.parts == asset.segmentation.parts
    assert back.joints == asset.joints


def test_what_hung_on_a_merged_part_hangs_on_what_took_it():
    merged = apply(cabinet(), MergeParts("drawer", "base"))
    assert joint(merged, "knob").parent == "base"
    assert len(faces_of(merged, "base")) == len(faces_of(cabinet(), "base")) + len(faces_of(cabinet(), "drawer"))
    np.testing.assert_array_equal(faces_of(merged, "knob"), faces_of(cabinet(), "knob"))


def test_components_split_apart_and_keep_every_face():
    joined = apply(cabinet(), MergeParts("knob", "door"))
    split = apply(joined, SplitComponents("door"))
    assert len(split.segmentation.parts) == len(joined.segmentation.parts) + 1
    groups = {tuple(faces_of(cabinet(), n)) for n in ("door", "knob")}
    assert {tuple(faces_of(split, n)) for n in ("door", split.segmentation.parts[-1].name)} == groups


def test_faces_moved_there_and_back_are_where_they_were():
    asset = cabinet()
    some = FaceSet.of(faces_of(asset, "door")[:2])
    moved = apply(asset, MoveFaces(some, "drawer"))
    assert set(some.numbers) <= set(faces_of(moved, "drawer"))
    back = apply(moved, MoveFaces(some, "door"))
    np.testing.assert_array_equal(back.segmentation.face_part, asset.segmentation.face_part)


def test_label_and_name_change_and_joints_follow_the_name():
    asset = apply(apply(cabinet(), Relabel("door", "flap")), Rename("drawer", "tray"))
    assert {p.name: p.label for p in asset.segmentation.parts}["door"] == "flap"
    assert joint(asset, "knob").parent == "tray"


def test_a_doubt_goes_with_the_joint_that_was_corrected():
    name = joint(cabinet(), "door").name
    unsure = replace(cabinet(), warnings=(f"joint {name}: low confidence (0.20), please check", "another"))
    assert apply(unsure, FlipSign("door")).warnings == ("another",)
    assert apply(unsure, FlipSign("drawer")).warnings == unsure.warnings


def test_a_joint_called_right_is_certain_and_its_warnings_go():
    before = joint(cabinet(), "door")
    about = (f"joint {before.name}: blocked", "part door: low confidence (0.20) that", "part door: 90 kg", "part doors: low")
    found = apply(replace(cabinet(), warnings=about), Confirm("door"))
    assert found.warnings == about[2:]
    same_joint(joint(found, "door"), before)
    assert joint(found, "door").confidence == 1
    assert joint(found, "door").reason == f"confirmed by hand: {before.reason}"
    with pytest.raises(CorrectionError, match="already"):
        apply(found, Confirm("door"))


def test_a_part_removed_is_of_its_parent_which_carries_what_it_carried():
    asset = slanted()
    removed, merged = apply(asset, RemovePart("p3")), apply(asset, MergeParts("p3", "p2"))
    assert joint(removed, "p4").parent == "p2"
    np.testing.assert_array_equal(removed.segmentation.face_part, merged.segmentation.face_part)


def test_a_fixed_joint_takes_no_limits():
    with pytest.raises(CorrectionError, match="change its type first"):
        apply(slanted(), SetLimits("p4", 0.0, 1.0))


DOOR = len(faces_of(cabinet(), "base"))


@pytest.mark.parametrize(
    ("correction", "told"),
    [
        (FlipSign("window"), "no part 'window'; the parts are base, door"),
        (FlipSign("base"), "root"),
        (ChangeType("door", JointType.REVOLUTE), "already"),
        (ChangeParent("drawer", "knob"), "valid are base, door"),
        (ChangeParent("door", "door"), "which it carries"),
        (SetLimits("door", 0.1, 1.0), "rest pose 0"),
        (SetLimits("door", 0.0, 0.0), "a range"),
        (SetLimits("door", 0.0, float("nan")), "rest pose 0"),
        (SetLimits("door", 0.0, 1e-320), "a range"),
        (SetLimits("door", -1e300, 1e300), "within"),
        (SetAxis("door", (0.0, 0.0, 1.0), (1e305, 0.0, 0.0)), "up to"),
        (SetAxis("door", (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)), "direction"),
        (SetAxis("door", (0.0, 0.0, 1.0), (float("inf"), 0.0, 0.0)), "finite"),
        (MergeParts("drawer", "knob"), "merge 'knob' into 'drawer' instead"),
        (MergeParts("base", "door"), "instead"),
        (MergeParts("door", "door"), "itself"),
        (RemovePart("base"), "root"),
        (Confirm("base"), "root"),
        (SplitPart("door", FaceSet(((0, 1),)), "x"), "not of 'door'"),
        (SplitPart("door", FaceSet(()), "x"), "no face"),
        (SplitPart("door", FaceSet(((DOOR, DOOR + 12),)), "x"), "all faces"),
        (MoveFaces(FaceSet(((10**9, 10**9 + 1),)), "door"), "face numbers must lie"),
        (MoveFaces(FaceSet(((DOOR, DOOR + 12),)), "base"), "without a face; merge"),
        (SplitComponents("door"), "1 connected"),
        (Relabel("door", " "), "printable"),
        (Relabel("door", "a\x1b[2J"), "printable"),
        (Rename("door", "drawer"), "valid is 'drawer_2'"),
        (Rename("door", "../../x"), "not legal"),
    ],
)
def test_what_makes_no_sense_is_refused_with_the_reason(correction, told):
    with pytest.raises(CorrectionError) as error:
        apply(cabinet(), correction)
    assert told in str(error.value)


def corrected(asset, part, **operations):
    for correction in corrections_of(asset, part, operations):
        asset = apply(asset, correction)
    return asset


def test_a_part_follows_another_and_its_limits_are_implied():
    asset = corrected(cabinet(), "drawer", mimic="door,-0.1")
    door, drawer = (joint(asset, name) for name in ("door", "drawer"))
    assert drawer.mimic == Mimic(door.name, -0.1)
    assert drawer.limits == pytest.approx(sorted(-0.1 * end for end in door.limits))
    wider = corrected(asset, "door", limits="0,150")
    assert joint(wider, "drawer").limits[0] == pytest.approx(-0.1 * np.deg2rad(150))
    with pytest.raises(CorrectionError, match="whose limits give its own"):
        corrected(asset, "drawer", limits="0,0.1")
    with pytest.raises(CorrectionError, match="is led by it"):
        corrected(asset, "door", mimic="drawer")
    assert joint(corrected(asset, "drawer", mimic="none"), "drawer").mimic is None
    assert joint(corrected(asset, "door", type="fixed"), "drawer").mimic is None  # it cannot lead any more
    assert joint(corrected(asset, "door", rename="hatch"), "drawer").mimic.joint in {j.name for j in asset.joints} | {
        "hatch_joint"
    }
    assert joint(corrected(asset, "door", remove=True), "drawer").mimic is None


def test_screws_balls_and_loose_parts():
    screw = joint(corrected(cabinet(), "knob", screw="-3mm"), "knob")
    assert (screw.type, screw.pitch) == (JointType.SCREW, pytest.approx(-0.003))
    plain = joint(corrected(corrected(cabinet(), "knob", screw="3mm"), "knob", type="continuous"), "knob")
    assert plain.pitch == 0
    ball = joint(corrected(cabinet(), "knob", type="ball", limits="20"), "knob")
    assert ball.limits == pytest.approx((0, np.deg2rad(20)))
    assert joint(corrected(cabinet(), "door", type="free"), "door").limits is None
    with pytest.raises(CorrectionError, match="give screw instead of type"):
        corrected(cabinet(), "knob", type="screw")


def test_loops_are_set_renamed_and_removed():
    asset = corrected(cabinet(), "drawer", loop="door,0.1,0,20cm,ball")
    (loop,) = asset.loops
    assert (loop.first, loop.second, loop.kind) == ("drawer", "door", JointType.BALL)
    assert loop.origin == pytest.approx((0.1, 0, 0.2))
    assert "joined to door" in next(row["motion"] for row in part_rows(asset) if row["part"] == "drawer")
    assert corrected(asset, "door", rename="hatch").loops[0].second == "hatch"
    assert corrected(asset, "drawer", loop="none").loops == ()
    assert corrected(asset, None, merge="drawer,door").loops == ()
    for part, operations in (("drawer", {"loop": "door,1e30,0,0"}), ("door", {"screw": "1e9"})):
        with pytest.raises(CorrectionError, match=r"1e\+06 m"):
            corrected(cabinet(), part, **operations)
    with pytest.raises(CorrectionError, match="on no loop"):
        corrected(cabinet(), "drawer", loop="none")
    with pytest.raises(CorrectionError, match="is no loop"):
        corrected(cabinet(), "drawer", loop="door,0.1,0")
