"""Joints driven in MuJoCo."""

import sys
from dataclasses import replace

import numpy as np
import pytest
from assets import box, cabinet, joint, mesh_of, slanted, source

from anymesh.checking.engines.mujoco_ import sweep_joints
from anymesh.errors import InputError, MissingExtraError
from anymesh.export import write_asset
from anymesh.types import Asset, Part, Segmentation


def swept(asset, folder):
    write_asset(asset, folder)
    return sweep_joints(folder / f"{asset.name}.urdf", steps=40)


@pytest.mark.parametrize("make", [cabinet, slanted])
def test_good_joints_pass(make, tmp_path):
    report = swept(make(), tmp_path)
    assert report.ok, report
    assert {j.name for j in report.joints} == {j.name for j in make().joints if j.type != "fixed"}
    for j in report.joints:
        assert j.reached_upper == pytest.approx(j.upper, abs=0.02 * (j.upper - j.lower))


def blocked(limit: float) -> Asset:
    """A slider that meets a post after 0.3 m."""
    pieces = [box((0, 0, -0.2), (2, 0.4, -0.1)), box((0.1, 0, 0), (0.4, 0.4, 0.2)), box((0.7, 0, 0), (0.9, 0.4, 0.2))]
    mesh, part = mesh_of(pieces)
    joints = (
        joint("slide", "prismatic", "base", "slider", (0.1, 0, 0), (1, 0, 0), (0.0, limit)),
        joint("post", "fixed", "base", "post", (0.7, 0, 0), (0, 0, 1), None),
    )
    parts = tuple(Part(n, n) for n in ("base", "slider", "post"))
    return Asset("blocked", source(), mesh, Segmentation(part, parts), joints, "geometry")


def test_a_joint_that_runs_into_another_link_is_told(tmp_path):
    (tmp_path / "short").mkdir()
    assert swept(blocked(0.25), tmp_path / "short").ok
    report = swept(blocked(0.5), tmp_path)
    (found,) = report.joints
    assert found.against == "post"
    assert found.penetration > 0.05
    assert found.reached_upper < 0.4
    assert any("'post'" in fault for fault in found.faults)
    assert any("upper limit" in fault for fault in found.faults)


def test_friction_beyond_the_effort_is_stuck(tmp_path):
    asset = cabinet()
    stiff = tuple(replace(j, friction=80.0) if j.name == "slide" else j for j in asset.joints)
    report = swept(replace(asset, joints=stiff), tmp_path)
    found = next(j for j in report.joints if j.name == "slide")
    assert "it does not move" in found.faults


def test_links_that_overlap_at_rest_are_named(tmp_path):
    asset = blocked(0.25)
    vertices = asset.mesh.vertices.copy()
    vertices[16:] -= (0.4, 0, 0)
    report = swept(replace(asset, mesh=replace(asset.mesh, vertices=vertices)), tmp_path)
    assert ("slider", "post", "overlap at rest") in report.excluded


def test_a_file_that_mujoco_refuses(tmp_path):
    (tmp_path / "a.urdf").write_text("<robot name='a'><link name='b'/><joint/></robot>")
    with pytest.raises(InputError, match="MuJoCo"):
        sweep_joints(tmp_path / "a.urdf")


def test_without_mujoco_it_is_named(monkeypatch, tmp_path):
    monkeypatch.setitem(sys.modules, "mujoco", None)
    with pytest.raises(MissingExtraError, match="mujoco is missing"):
        sweep_joints(tmp_path / "a.urdf")


def test_the_report_is_the_same_twice(tmp_path):
    first = swept(cabinet(), tmp_path)
    assert first == sweep_joints(tmp_path / "cabinet.urdf", steps=40)
    assert np.isfinite([j.penetration for j in first.joints]).all()
