"""Small files in the formats of the data sets, and what holds for every truth."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
from assets import box, checker

from anymesh.evaluation.ground_truth import GroundTruth, TrueJoint
from anymesh.loading import load_mesh
from anymesh.types import JointType, Mesh


def loaded(truth: GroundTruth) -> Mesh:
    """The truth's mesh, once it is one nameless node and fits the labels and joints."""
    mesh = load_mesh(truth.mesh).mesh
    assert len(mesh.faces) == len(truth.labels)
    assert set(truth.labels) == set(range(len(truth.parts)))
    assert [n.name for n in mesh.nodes] == ["object"]
    assert {m.name for m in mesh.materials} <= {"material"}
    assert [j.child for j in truth.joints] == [p.name for p in truth.parts[1:]]
    assert {j.parent for j in truth.joints} <= {p.name for p in truth.parts}
    for joint in truth.joints:
        assert np.isclose(np.linalg.norm(joint.axis), 1)
        if joint.limits is not None:
            assert joint.limits[0] < joint.limits[1]
            assert joint.limits[0] + joint.limits[1] >= 0
    return mesh


def part_box(truth: GroundTruth, name: str) -> np.ndarray:
    """(2, 3): the box of a part in the file's coordinates (Y up)."""
    number = next(k for k, p in enumerate(truth.parts) if p.name == name)
    corners = loaded(truth).triangles[truth.labels == number].reshape(-1, 3)
    return np.array([corners.min(0), corners.max(0)])


def displaced(joint: TrueJoint, points: np.ndarray, position: float) -> np.ndarray:
    """Points of the part where the joint is at a position, its parent at rest."""
    if joint.type is JointType.PRISMATIC:
        return points + position * joint.axis
    relative = points - joint.origin
    c, s = np.cos(position), np.sin(position)
    along = (relative @ joint.axis)[:, None] * joint.axis
    return joint.origin + along + c * (relative - along) + s * np.cross(joint.axis, relative)


def write_obj(path: Path, low, high, *, material: str = "") -> None:
    """A box; material: the lines before its faces, and of the material library beside it."""
    vertices, faces = box(low, high)
    lines = [f"v {x} {y} {z}" for x, y, z in vertices]
    if material:
        lines = ["mtllib look.mtl", *lines, "vt 0 0", "vt 1 0", "vt 1 1", "usemtl look"]
        path.with_name("look.mtl").write_text(material)
    corner = "{}/1 {}/2 {}/3" if material else "{} {} {}"
    lines += [f"f {corner.format(*(face + 1))}" for face in faces]
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("\n".join(lines) + "\n")


CABINET = """<?xml version="1.0" ?>
<robot name="partnet_1">
	<link name="base"/>
	<link name="link_0">
		<visual name="door-1"><origin xyz="0.5 0 -0.3"/>
			<geometry><mesh filename="textured_objs/original-1.obj"/></geometry></visual>
		<visual name="handle-2"><origin xyz="0.5 0 -0.3"/>
			<geometry><mesh filename="textured_objs/original-2.obj"/></geometry></visual>
	</link>
	<joint name="joint_0" type="revolute"><origin xyz="-0.5 0 0.3"/><axis xyz="0 -1 0"/>
		<child link="link_0"/><parent link="link_2"/><limit lower="0" upper="1.5"/></joint>
	<link name="link_1">
		<visual name="drawer-3"><origin xyz="0 0 0"/>
			<geometry><mesh filename="textured_objs/original-3.obj"/></geometry></visual>
	</link>
	<joint name="joint_1" type="prismatic"><origin xyz="0 0 0"/><axis xyz="0 0 1"/>
		<child link="link_1"/><parent link="link_2"/><limit lower="0" upper="0.4"/></joint>
	<link name="link_1_helper"/>
	<joint name="joint_3" type="prismatic"><origin xyz="0 0.9 0"/><axis xyz="0 1 0"/>
		<child link="link_1_helper"/><parent link="link_2"/><limit lower="0" upper="0.05"/></joint>
	<link name="link_3">
		<visual name="knob-5"><origin xyz="0 -0.9 0"/>
			<geometry><mesh filename="textured_objs/original-5.obj"/></geometry></visual>
	</link>
	<joint name="joint_4" type="continuous"><origin xyz="0 0 0"/><axis xyz="0 1 0"/>
		<child link="link_3"/><parent link="link_1_helper"/></joint>
	<link name="link_2">
		<visual name="frame-4"><origin xyz="0 0 0"/>
			<geometry><mesh filename="textured_objs/original-4.obj"/></geometry></visual>
	</link>
	<joint name="joint_2" type="fixed"><origin rpy="1.570796326794897 0 -1.570796326794897" xyz="0 0 0"/>
		<child link="link_2"/><parent link="base"/></joint>
</robot>
"""
SEMANTICS = "link_0 hinge door\nlink_1 slider drawer\nlink_2 heavy furniture_body\nlink_3 slider+ knob\n"


def write_partnet(folder: Path, number: str, category: str, *, semantics: str = SEMANTICS) -> None:
    """An object in PartNet-Mobility's format: a door, a drawer, a knob that slides and turns, a textured frame."""
    place = folder / number
    objs = place / "textured_objs"
    write_obj(objs / "original-1.obj", (-0.5, 0.0, 0.3), (0.5, 0.5, 0.34))
    write_obj(objs / "original-2.obj", (0.4, 0.2, 0.34), (0.42, 0.3, 0.4))
    write_obj(objs / "original-3.obj", (-0.48, 0.55, -0.2), (0.48, 0.8, 0.34))
    write_obj(objs / "original-5.obj", (-0.05, 0.9, -0.05), (0.05, 0.95, 0.05))
    look = "newmtl look\nKd 1 1 1\nmap_Kd ../images/texture_0.png\n"
    write_obj(objs / "original-4.obj", (-0.5, 0.0, -0.3), (0.5, 0.9, 0.3), material=look)
    (place / "images").mkdir()
    (place / "images" / "texture_0.png").write_bytes(checker())
    (place / "mobility.urdf").write_text(CABINET)
    (place / "semantics.txt").write_text(semantics)
    (place / "meta.json").write_text(json.dumps({"model_cat": category, "anno_id": number}))
    (place / "mobility_v2.json").write_text(json.dumps([{"id": 0, "name": "door", "joint": "hinge"}]))
