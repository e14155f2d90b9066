"""Copies are recognized by shape wherever they lie, and get the joint of the part, mirrored where they are mirror images."""

from dataclasses import replace

import numpy as np
import pytest
from assets import box, joint, mesh_of, source

from anymesh.correcting import (
    CorrectionError,
    FlipSign,
    RemovePart,
    Rename,
    SetLimits,
    SplitPart,
    apply,
    copies_of,
    same_for_copies,
)
from anymesh.types import Asset, Part, Segmentation

CASE = [box((0, 0, 0), (1, 0.4, 0.02)), box((0, 0, 0.98), (1, 0.4, 1)), box((0, 0.38, 0.02), (1, 0.4, 0.98)),
        box((0, 0, 0.02), (0.02, 0.38, 0.98)), box((0.98, 0, 0.02), (1, 0.38, 0.98))]  # fmt: skip
LEAVES = [
    [box((0.005, -0.02, 0.3), (0.495, 0, 0.99)), box((0.46, -0.06, 0.6), (0.48, -0.02, 0.7))],  # a leaf with its handle
    [box((0.505, -0.02, 0.3), (0.995, 0, 0.99)), box((0.52, -0.06, 0.6), (0.54, -0.02, 0.7))],
]
FRONTS = [[box((x, -0.02, 0.03), (x + 0.3, 0, 0.28))] for x in (0.03, 0.35, 0.67)]


def asset_of(*parts, joints) -> Asset:
    mesh, piece = mesh_of([p for part in parts for p in part])
    of = np.repeat(np.arange(len(parts)), [len(p) for p in parts])[piece]
    names = ("base", *(j.child for j in joints))
    return Asset("thing", source(), mesh, Segmentation(of, tuple(Part(n, n) for n in names)), joints, "geometry")


def cupboard() -> Asset:
    """Two leaves that are mirror images, and three drawer fronts."""
    leaves = (
        joint("hinge_1", "revolute", "base", "leaf_1", (0, 0, 0.6), (0, 0, -1), (0.0, 1.5)),
        joint("hinge_2", "prismatic", "base", "leaf_2", (0.75, 0, 0.6), (1, 0, 0), (0.0, 0.2)),
    )
    fronts = tuple(
        joint(f"slide_{k}", "prismatic", "base", f"front_{k}", (0, 0, 0.1), (0, -1, 0), (0.0, 0.3)) for k in (1, 2, 3)
    )
    return asset_of(CASE, *LEAVES, *FRONTS, joints=(*leaves, *fronts))


def corrected(asset: Asset, corrections) -> Asset:
    for c in corrections:
        asset = apply(asset, c)
    return asset


def of(asset: Asset, part: str):
    return next(j for j in asset.joints if j.child == part)


def test_the_other_leaf_is_hinged_at_its_other_side_and_opens_outwards_too():
    done = corrected(cupboard(), same_for_copies(cupboard(), "leaf_1"))
    found = of(done, "leaf_2")
    assert (found.type, found.limits, found.reason) == ("revolute", (0.0, 1.5), "corrected by hand: as its copy leaf_1")
    np.testing.assert_allclose(found.axis, (0, 0, 1), atol=1e-6)
    np.testing.assert_allclose(found.origin[:2], (1, 0), atol=1e-6)


def test_plain_leaves_that_meet_are_a_pair_and_drawers_are_shifted():
    plain = asset_of(CASE, LEAVES[0][:1], LEAVES[1][:1], *FRONTS, joints=cupboard().joints)
    np.testing.assert_allclose(of(corrected(plain, same_for_copies(plain, "leaf_1")), "leaf_2").axis, (0, 0, 1), atol=1e-6)
    asset = apply(apply(cupboard(), FlipSign("front_2")), SetLimits("front_3", 0.0, 0.01))
    done = corrected(asset, same_for_copies(asset, "front_1"))
    assert [c.part for c in copies_of(asset, "front_1")] == ["front_2", "front_3"]
    for name in ("front_2", "front_3"):
        assert of(done, name).limits == (0.0, 0.3)
        np.testing.assert_allclose(of(done, name).axis, (0, -1, 0), atol=1e-6)
    np.testing.assert_allclose(of(done, "leaf_1").axis, of(asset, "leaf_1").axis)


def test_copies_that_were_missed_become_parts_with_all_their_components():
    asset = cupboard()
    for name in ("leaf_2", "front_2", "front_3"):
        asset = apply(asset, RemovePart(name))
    done = corrected(asset, (*same_for_copies(asset, "leaf_1"), *same_for_copies(asset, "front_1")))
    before, after = cupboard().segmentation, done.segmentation
    groups = {tuple(before.faces(k)) for k in range(len(before.parts))}
    assert {tuple(after.faces(k)) for k in range(len(after.parts))} == groups
    assert [of(done, p.name).type for p in after.parts[1:]].count("revolute") == 2
    assert copies_of(asset, "leaf_1", regions=False) == ()


def test_the_back_of_a_case_is_no_copy_of_its_door():
    case = [*CASE, box((0.005, 0.4, 0.3), (0.495, 0.42, 0.99))]
    asset = asset_of(case, LEAVES[0][:1], joints=cupboard().joints[:1])
    assert copies_of(asset, "leaf_1") == ()
    with pytest.raises(CorrectionError, match="no copy"):
        same_for_copies(asset, "leaf_1")


@pytest.mark.parametrize("angle", [0.0, 0.4, 2.0])
def test_copies_turned_about_any_axis_get_the_turned_joint(angle):
    turn = np.eye(4)
    turn[:2, :2] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
    blade = [box((0.1, -0.02, 0), (0.5, 0.02, 0.01)), box((0.4, 0.02, 0), (0.5, 0.08, 0.01))]
    other = [(v @ turn[:3, :3].T + (0, 0, 0.3), f) for v, f in blade]
    joints = tuple(joint(f"j{k}", "revolute", "base", f"blade_{k}", (0.1, 0, 0), (0, 1, 0), (0.0, 1.0)) for k in (1, 2))
    asset = asset_of([box((-0.05, -0.05, -0.1), (0.05, 0.05, 0.6))], blade, other, joints=joints)
    found = of(corrected(asset, same_for_copies(asset, "blade_1")), "blade_2")
    np.testing.assert_allclose(found.axis, turn[:3, 1], atol=1e-3)
    np.testing.assert_allclose(np.cross(found.origin - turn[:3, 0] * 0.1 - (0, 0, 0.3), found.axis), 0, atol=1e-3)


def test_the_label_goes_with_the_joint_and_wheels_turn_the_same_way():
    sides = [[box((x, y, 0), (x + 0.05, y + 0.2, 0.2))] for x, y in ((-0.3, -0.5), (0.25, 0.3))]
    joints = tuple(joint(f"j{k}", "continuous", "base", f"wheel_{k}", (0, 0, 0), (1, 0, 0), None) for k in (1, 2))
    asset = asset_of([box((-0.2, -0.6, 0.05), (0.2, 0.6, 0.3))], *sides, joints=joints)
    parts = (asset.segmentation.parts[0], Part("wheel_1", "tyre"), Part("wheel_2", "part"))
    asset = replace(asset, segmentation=replace(asset.segmentation, parts=parts))
    done = corrected(asset, same_for_copies(asset, "wheel_1"))
    assert [p.label for p in done.segmentation.parts[1:]] == ["tyre", "tyre"]
    np.testing.assert_allclose(of(done, "wheel_2").axis, (1, 0, 0), atol=1e-6)


def test_names_of_new_parts_are_new():
    asset = apply(cupboard(), RemovePart("front_3"))
    asset = apply(asset, Rename("front_2", "front_9"))
    splits = [c for c in same_for_copies(asset, "front_1") if isinstance(c, SplitPart)]
    assert [c.part for c in splits] == ["base"]
    assert len(corrected(asset, same_for_copies(asset, "front_1")).segmentation.parts) == len(cupboard().segmentation.parts)


def raised(raised_cells, part_cells) -> Asset:
    """A wall (x, z) of one surface in which some columns are raised fronts (-y); those of `part_cells` are a part."""
    x, z = np.cumsum([0, *[0.1, 0.8] * 3, 0.1]), (0.0, 0.1, 0.9, 1.0)
    height = {(i, k): -0.1 if k == 1 and i in raised_cells else 0.0 for i in range(7) for k in range(3)}
    quads, of = [], []
    for (i, k), y in height.items():
        low, high = (x[i], z[k]), (x[i + 1], z[k + 1])
        quads.append([(low[0], y, low[1]), (high[0], y, low[1]), (high[0], y, high[1]), (low[0], y, high[1])])
        of.append(i if y else -1)
        if y:  # the walls around a raised cell, outwards
            ring = quads[-1]
            quads += [[b, a, (a[0], 0.0, a[2]), (b[0], 0.0, b[2])] for a, b in zip(ring, ring[1:] + ring[:1], strict=True)]
            of += [i] * 4
    faces = np.array([[4 * q + c for c in t] for q in range(len(quads)) for t in ((0, 1, 2), (0, 2, 3))])
    mesh, _ = mesh_of([(np.array(quads, float).reshape(-1, 3), faces)])
    part = np.isin(np.repeat(of, 2), part_cells).astype(np.int64)
    slide = joint("slide", "prismatic", "base", "front", (0.5, -0.1, 0.5), (0, -1, 0), (0.0, 0.3))
    parts = (Part("base", "base"), Part("front", "drawer"))
    return Asset("wall", source(), mesh, Segmentation(part, parts), (slide,), "geometry")


def test_fronts_of_one_surface_with_the_case_are_copies_by_their_facets():
    wall = raised((1, 3, 5), (1,))
    assert len(wall.segmentation.faces(1)) == 10
    copies = copies_of(wall, "front")
    assert [(c.part, len(c.faces)) for c in copies] == [("base", 10)] * 2
    np.testing.assert_allclose([(c.pose @ (0.5, 0, 0.5, 1))[:3] for c in copies], [(1.4, 0, 0.5), (2.3, 0, 0.5)], atol=1e-6)
    assert len(corrected(wall, same_for_copies(wall, "front")).joints) == 3
    assert copies_of(raised((1,), (1,)), "front") == ()
