"""Our figures against those of others: the published formulas, written down anew, and the package `articulatearena`.

`articulatearena` (He 2026, arXiv 2609.33931) reads two URDFs with a reader of its own. What it gives for single joints is
compared with our scores of the objects that the URDFs were written from.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from assets import cabinet, joint
from hypothesis import given
from hypothesis import strategies as st

from anymesh.evaluation.ground_truth import EvalSample, GroundTruth, TrueJoint
from anymesh.evaluation.score import TURNED, JointScore, angle_error, displacement, line_distance, range_iou, score
from anymesh.evaluation.summary import articulate_anything, opd, s2o
from anymesh.export import write_asset
from anymesh.types import Asset, Joint, JointType

number = st.floats(-3, 3)
points = st.tuples(number, number, number).map(np.array)
axes = points.filter(lambda v: np.linalg.norm(v) > 0.1).map(lambda v: v / np.linalg.norm(v))


@given(axes, axes)
def test_angle_as_published(a, b) -> None:
    published = np.degrees(np.arccos(min(1.0, abs(float(np.dot(a, b))))))
    assert angle_error(a, b) == pytest.approx(published, abs=1e-5)  # which is blind to angles below 1e-6


@given(points, axes, points, axes)
def test_line_distance_as_published_and_as_a_least_squares_problem(p, a, q, b) -> None:
    if angle_error(a, b) < 2:
        return
    published = abs(np.linalg.det([q - p, a, b])) / np.linalg.norm(np.cross(a, b))
    (s, t), *_ = np.linalg.lstsq(np.column_stack([a, -b]), q - p, rcond=None)
    closest = np.linalg.norm((p + s * a) - (q + t * b))
    assert line_distance(p, a, q, b) == pytest.approx(published, abs=1e-6)
    assert line_distance(p, a, q, b) == pytest.approx(closest, abs=1e-6)


@given(points, axes, points, st.sampled_from([1.0, -1.0]))
def test_line_distance_of_parallel_axes_is_the_distance_of_a_point_from_a_line(p, a, q, sign) -> None:
    nearest = p + np.dot(q - p, a) * a
    assert line_distance(p, a, q, sign * a) == pytest.approx(np.linalg.norm(q - nearest), abs=1e-7)


ends = st.tuples(st.integers(-6, 0), st.integers(0, 6)).filter(lambda e: e[0] < e[1])


@given(ends, ends)
def test_range_iou_by_counting(a, b) -> None:
    first, second = set(range(*a)), set(range(*b))
    assert range_iou(tuple(map(float, a)), tuple(map(float, b))) == pytest.approx(len(first & second) / len(first | second))


ASSET = cabinet()


def perturbed(seed: int) -> Asset:
    """Axes off by 2 to 20 degrees, origins and limits as well, and some signs turned over."""
    rng = np.random.default_rng(seed)

    def one(j: Joint) -> Joint:
        side = np.cross(j.axis, rng.normal(size=3))
        angle = np.deg2rad(rng.uniform(2, 20))
        axis = np.cos(angle) * j.axis + np.sin(angle) * side / np.linalg.norm(side)
        limits = None if j.limits is None else (0.0, j.limits[1] * rng.uniform(0.5, 1.5))
        if limits and rng.random() < 0.5:
            axis, limits = -axis, (-limits[1], 0.0)
        return replace(j, axis=axis / np.linalg.norm(axis), origin=j.origin + rng.normal(0, 0.05, 3), limits=limits)

    return replace(ASSET, joints=tuple(one(j) for j in ASSET.joints))


def scored(found: Asset) -> dict[str, JointScore]:
    joints = tuple(TrueJoint(j.type, j.origin, j.axis, j.limits, child=j.child, parent=j.parent) for j in ASSET.joints)
    s = ASSET.segmentation
    truth = GroundTruth("cabinet", Path("x"), s.parts, s.face_part, joints)
    return {j.part: j for j in score(EvalSample(truth, found.mesh, s.face_part, np.eye(4)), s, found.joints).joints}


@pytest.mark.parametrize("seed", range(8))
def test_success_as_their_evaluations_have_it(seed: int) -> None:
    found = perturbed(seed)
    scores, unit = scored(found), ASSET.mesh.diagonal / 2
    for true, ours in zip(ASSET.joints, found.joints, strict=True):
        off = np.arccos(min(1.0, abs(float(true.axis @ ours.axis))))
        turns = true.type is not JointType.PRISMATIC
        w = np.cross(ours.axis, true.axis)
        lines = abs((true.origin - ours.origin) @ w) / np.linalg.norm(w)
        origin = np.linalg.norm(np.cross(ours.origin - true.origin, true.axis))
        corners = ASSET.mesh.triangles[ASSET.segmentation.faces(ASSET.joints.index(true) + 1)].reshape(-1, 3)
        part = np.linalg.norm(corners.max(0) - corners.min(0))
        told = scores[true.child]
        assert articulate_anything(told) == (off <= 0.25 and (not turns or lines / unit <= 0.05))
        assert opd(told) == (np.degrees(off) <= 10 and (not turns or origin / (2 * unit) <= 0.25))
        assert s2o(told) == (np.degrees(off) < 5 and (not turns or origin / part < 0.1))


# What follows needs the package.


def written(asset: Asset, folder: Path) -> Path:
    folder.mkdir()
    write_asset(asset, folder)
    return folder / f"{asset.name}.urdf"


def components(arena, urdf: Path, joint: str):
    """A joint of a URDF as `articulatearena` reads it: as a screw, and as type, axis, origin and limits."""
    from articulatearena.previous_metrics.component_scores import JointTuple

    screw = arena.load_joint(urdf, joint)
    turn, slide = screw.xi_hat.omega, screw.xi_hat.nu
    axis = turn if screw.joint_type == "revolute" else slide
    return screw, JointTuple(screw.joint_type, axis, np.cross(turn, slide), (screw.a, screw.b))


@pytest.mark.parametrize("seed", range(3))
def test_components_of_two_urdfs(seed: int, tmp_path) -> None:
    arena = pytest.importorskip("articulatearena")
    from articulatearena.previous_metrics import component_scores as theirs

    found = perturbed(seed)
    urdfs = written(found, tmp_path / "found"), written(ASSET, tmp_path / "true")
    scores, unit = scored(found), ASSET.mesh.diagonal / 2
    for j in ASSET.joints:
        ours, true = (components(arena, urdf, j.name)[1] for urdf in urdfs)
        told = scores[j.child]
        assert told.type_right == (theirs.type_error(ours, true) == 0)
        assert told.angle == pytest.approx(np.degrees(theirs.axis_error(ours, true)), abs=1e-4)
        if j.type is not JointType.PRISMATIC:
            assert told.line_distance == pytest.approx(theirs.origin_error_revolute(ours, true) / unit, abs=1e-5)
            assert articulate_anything(told) == theirs.joint_success(ours, true, tau_origin=0.05 * unit)


def test_their_metric_is_zero_where_our_errors_are(tmp_path) -> None:
    arena = pytest.importorskip("articulatearena")
    turned = tuple(
        j if j.limits is None else replace(j, axis=-j.axis, limits=(-j.limits[1], -j.limits[0]), origin=j.origin + j.axis)
        for j in ASSET.joints
    )
    short = tuple(replace(j, limits=(0.0, 0.15)) if j.name == "slide" else j for j in ASSET.joints)
    true = written(ASSET, tmp_path / "true")
    norm = arena.make_split_norm(alpha=1.0)

    def metric(urdf: Path, name: str) -> float:
        a, b = (arena.joint_to_endpoint_pair(components(arena, u, name)[0]) for u in (urdf, true))
        return arena.joint_metric(a.u.data, a.v.data, b.u.data, b.v.data, norm)

    same, other = replace(ASSET, joints=turned), replace(ASSET, joints=short)
    urdf = written(same, tmp_path / "same")
    for j in ASSET.joints[:2]:
        told = scored(same)[j.child]
        assert metric(urdf, j.name) == pytest.approx(0, abs=1e-6)
        assert (told.angle, told.displacement, told.range_iou) == pytest.approx((0, 0, 1), abs=1e-6)
        assert told.opens_right
    assert metric(written(other, tmp_path / "short"), "slide") == pytest.approx(0.15, abs=1e-6)  # of .3
    assert scored(other)["drawer"].range_iou == pytest.approx(0.5)


@given(points, axes, points, axes, points)
def test_displacement_of_a_point_as_their_rigid_bodies_have_it(p, a, q, b, x) -> None:
    arena = pytest.importorskip("articulatearena")
    from articulatearena.new_equation.material_motion import config_discrepancy, se3_exp

    ours = joint("j", "revolute", "base", "door", p, a, (0.0, 1.0))
    true = TrueJoint(JointType.REVOLUTE, q, b, (0.0, 1.0), child="door", parent="base")
    moved = [se3_exp(arena.screw_twist(axis, o, "revolute").data, TURNED) for axis, o in ((ours.axis, p), (b, q))]
    theirs = config_discrepancy(*moved, arena.LinkInertia(1.0, x, 1e-12 * np.eye(3)))  # a point
    assert displacement(x[None], ours, true, 1.0) == pytest.approx(theirs, abs=1e-5)
