"""What the live page draws: the parts as they are, axes and limits where the joints are, overlays with the right size."""

import json
from dataclasses import replace

import numpy as np
import pytest
from assets import box, cabinet, mesh_of, slanted, source
from hypothesis import given
from hypothesis import strategies as st

from anymesh.geometry.kinematics import link_transforms
from anymesh.physics.inertia import Inertia
from anymesh.types import Asset, Box, Cylinder, Joint, JointType, Part, Segmentation
from anymesh.viewer.panels import head, joint_table, selection
from anymesh.viewer.scene import (
    Surfaces,
    apart,
    box_lines,
    color_of,
    gripper_lines,
    inertia_box,
    joint_lines,
    read_grippers,
    report_scene,
    shape_surface,
    swayed,
)
from anymesh.viewer.session import part_poses


def volume(surface) -> float:
    t = surface.vertices[surface.faces]
    return float(np.einsum("ij,ij->i", t[:, 0], np.cross(t[:, 1], t[:, 2])).sum() / 6)


def test_parts_are_drawn_as_they_are_and_drawn_once():
    asset, surfaces = cabinet(), Surfaces()
    found = surfaces.of(asset)
    for number, part in enumerate(asset.segmentation.parts):
        drawn = found[part.name].vertices[found[part.name].faces]
        np.testing.assert_array_equal(drawn, asset.mesh.triangles[asset.segmentation.faces(number)])
    assert surfaces.note(asset) == ""
    assert all(surfaces.of(asset)[name] is surface for name, surface in found.items())


def test_another_mesh_with_the_same_face_numbers_is_drawn_anew():
    asset, surfaces = cabinet(), Surfaces()
    surfaces.of(asset)
    larger = replace(asset, mesh=asset.mesh.transformed(np.diag([2.0, 2, 2, 1])))
    assert np.ptp(surfaces.of(larger)["door"].vertices[:, 2]) == pytest.approx(2 * 0.575)


def dense(rows: int) -> Asset:
    """A wavy sheet on a box, of 2 rows^2 faces."""
    x, y = np.meshgrid(np.linspace(0, 1, rows + 1), np.linspace(0, 1, rows + 1))
    points = np.c_[x.ravel(), y.ravel(), 1.2 + 0.05 * np.sin(9 * x.ravel())]
    k = (np.arange(rows)[:, None] * (rows + 1) + np.arange(rows)).ravel()
    faces = np.concatenate([np.c_[k, k + 1, k + rows + 2], np.c_[k, k + rows + 2, k + rows + 1]])
    mesh, part = mesh_of([box((0, 0, 0), (1, 1, 1)), (points, faces)])
    joint = Joint("j", JointType.FIXED, "base", "sheet", np.zeros(3), np.array([0.0, 0, 1]), None, 1.0, "built so")
    return Asset(
        "dense", source(), mesh, Segmentation(part, (Part("base", "base"), Part("sheet", "sheet"))), (joint,), "geometry"
    )


def test_a_dense_object_is_decimated_for_display_and_says_so():
    asset, surfaces = dense(60), Surfaces(most=2000)
    found = surfaces.of(asset)
    assert sum(len(s.faces) for s in found.values()) < 2500 < len(asset.mesh.faces)
    assert "7,212 faces" in surfaces.note(asset)
    corners = found["sheet"].vertices
    assert np.abs(corners[:, 2] - 1.2 - 0.05 * np.sin(9 * corners[:, 0])).max() < 0.01


def test_colours_differ_and_fade():
    assert len({color_of(k) for k in range(10)}) == 10
    assert all(a < b for a, b in zip(color_of(1)[1:], color_of(1, faded=True)[1:], strict=True))


@pytest.mark.parametrize("make", [cabinet, slanted])
def test_the_arrow_lies_on_the_axis_and_the_range_ends_at_the_limits(make):
    asset = make()
    for joint in asset.joints:
        lines = joint_lines(asset, joint)
        way = lines.arrow[1] - lines.arrow[0]
        assert way @ joint.axis == pytest.approx(np.linalg.norm(way))
        if joint.type is JointType.REVOLUTE:
            np.testing.assert_allclose(np.cross(lines.arrow - joint.origin, joint.axis), 0, atol=1e-9)
        if joint.limits is None:
            assert len(lines.range) == 0
            continue
        points = lines.range[:, 0]
        if joint.type is JointType.PRISMATIC:
            assert np.linalg.norm(lines.range[0, 1] - lines.range[0, 0]) == pytest.approx(joint.limits[1] - joint.limits[0])
        else:
            arms = np.linalg.norm(np.cross(points[:32] - joint.origin, joint.axis), axis=1)
            np.testing.assert_allclose(arms, arms[0])


def test_apart_moves_every_part_off_its_parent_and_not_the_root():
    asset = cabinet()
    off = apart(asset)
    np.testing.assert_array_equal(off["base"], 0)
    np.testing.assert_allclose(off["drawer"] / np.linalg.norm(off["drawer"]), (0, -1, 0))
    for joint in asset.joints:
        assert np.linalg.norm(off[joint.child] - off[joint.parent]) == pytest.approx(0.35 * asset.mesh.diagonal)


def test_parts_are_posed_by_the_kinematics_and_put_apart():
    asset, positions = cabinet(), {"hinge": 0.7, "slide": 0.1}
    placed, far = part_poses(asset, positions, 0.0), part_poses(asset, positions, 0.5)
    for name, T in link_transforms(asset, positions).items():
        np.testing.assert_array_equal(placed[name], T)
        np.testing.assert_allclose(far[name][:3, 3] - T[:3, 3], 0.5 * apart(asset)[name])


@given(st.floats(0, 1))
def test_a_play_stays_within_limits_and_passes_rest(phase):
    for asset in (cabinet(), slanted()):
        for joint in asset.joints:
            at = swayed(asset, joint, phase)
            low, high = joint.limits or (0, 2 * np.pi)
            assert low - 1e-9 <= at <= high + 1e-9
            assert swayed(asset, joint, 0.0) == 0


def test_a_play_reaches_both_limits():
    joint = slanted().joints[0]
    reached = [swayed(slanted(), joint, p) for p in np.linspace(0, 1, 201)]
    np.testing.assert_allclose((min(reached), max(reached)), joint.limits)


def test_overlays_have_the_size_of_what_they_show():
    turn = np.array([[0.0, 0, 1], [1, 0, 0], [0, 1, 0]])
    assert volume(shape_surface(Box(np.ones(3), turn, np.array([1.0, 2, 3])))) == pytest.approx(6)
    assert volume(shape_surface(Cylinder(np.ones(3), turn, 0.5, 2.0))) == pytest.approx(np.pi / 2, rel=0.02)
    size = np.array([0.2, 0.4, 0.6])
    moments = np.array([size[1] ** 2 + size[2] ** 2, size[0] ** 2 + size[2] ** 2, size[0] ** 2 + size[1] ** 2]) * 5 / 12
    drawn = inertia_box(Inertia(5.0, np.zeros(3), np.diag(moments)))
    np.testing.assert_allclose(np.sort(np.ptp(drawn.vertices, axis=0)), size)
    assert box_lines(np.array([[0.0, 0, 0], [1, 2, 3]]), 0.1).reshape(-1, 3).max(0).tolist() == pytest.approx([1.1, 2.1, 3.1])


def test_names_from_a_file_are_escaped_and_warnings_come_first():
    bad = "<img src=x onerror=alert(1)>"
    asset = cabinet(names=(bad, "door", "drawer", "knob"), name=bad, warnings=(f"{bad} is odd",))
    asset = replace(asset, joints=tuple(replace(j, reason=bad) for j in asset.joints))
    for text in (
        head(asset, unsaved=1, note=bad, tool=bad),
        joint_table(asset),
        selection(asset, bad),
        selection(asset, "door"),
    ):
        assert "<img" not in text
        assert "&lt;img" in text
    text = head(asset, unsaved=2, note="a note", tool="")
    assert text.index("is odd") < text.index("a note")
    assert "2 corrections not saved" in text
    assert "1 correction not saved" in head(asset, unsaved=1, note="", tool="")


def test_the_best_grasp_of_a_joint_stands_for_its_handle_and_what_is_wrong_is_left_out(tmp_path):
    asset = cabinet()
    joint, other = asset.joints[:2]
    handle = {
        "link": joint.child,
        "place": [0, 0, 1],
        "approach": [0, 1, 0],
        "closing": [0, 0, 1],
        "width": 0.02,
        "depth": 0.03,
    }
    record = {
        "joints": [{"name": joint.name, "handle": handle}, {"name": other.name, "handle": {**handle, "link": other.child}}]
    }
    (tmp_path / "asset.json").write_text(json.dumps(record))
    pose = {"pose": np.eye(4).tolist(), "prehensile": True, "width": 0.01}
    bad = {"pose": [[1, 2], [3, 4]], "prehensile": True, "width": 0.01}
    hand = {"finger": {"tip": 0.012}}
    joints = [{"joint": joint.name, "link": joint.child, "grasps": [pose]}, {"joint": "x", "link": "x", "grasps": [pose]}, 3]
    (tmp_path / "grasps.json").write_text(json.dumps({"gripper": hand, "joints": joints}))
    first, second = read_grippers(tmp_path, asset)
    assert (first.link, first.grasp, second.link, second.grasp) == (joint.child, True, other.child, False)
    assert np.allclose(first.T[:3, 3], joint.origin)
    assert np.allclose(gripper_lines(second, 0.1)[:2, 0].mean(0), (0, 0.03, 1))  # the tips, ahead of the handle's place
    assert [g["link"] for g in report_scene(asset, looks=False, grippers=(first, second))["grippers"]] == [1, 2]
    joints[0]["grasps"] = [bad]
    (tmp_path / "grasps.json").write_text(json.dumps({"gripper": hand, "joints": joints}))
    assert [g.grasp for g in read_grippers(tmp_path, asset)] == [False, False]
    assert read_grippers(tmp_path / "nothing", asset) == ()
