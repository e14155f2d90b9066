"""An articulated URDF as an object with known joints: its visuals as one mesh without names, and the truth about it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import trimesh
from yourdfpy import URDF

from anymesh.evaluation.truth import TrueJoint, Truth
from anymesh.types import JointType, Part

Y_UP = np.array([[1.0, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]])  # from URDF's Z-up to glTF's Y-up
MOVING = {"revolute", "continuous", "prismatic"}


def flatten_urdf(urdf: Path, mesh: Path) -> Truth:
    """Writes the visuals at rest as one nameless GLB at `mesh`; returns its truth in that file's coordinates.

    Links that do not move against each other are one part; links without a visual are left out, so that where the root link
    has none, the first link stands for it. An axis is turned so that positive goes towards the larger limit.
    """
    robot = URDF.load(str(urdf), mesh_dir=str(urdf.parent), build_scene_graph=True, load_meshes=True)
    carrier = {j.child: j for j in robot.joint_map.values()}

    def body(link: str) -> str:
        while link in carrier and carrier[link].type not in MOVING:
            link = carrier[link].parent
        return link

    graph = robot.scene.graph
    pieces: list[trimesh.Trimesh] = []
    owners: list[str] = []
    for node in sorted(graph.nodes_geometry):
        T, geometry = graph[node]
        link = node
        while link not in robot.link_map:
            link = graph.transforms.parents[link]
        piece = robot.scene.geometry[geometry]
        pieces.append(trimesh.Trimesh(trimesh.transform_points(piece.vertices, Y_UP @ T), piece.faces, process=False))
        owners.append(body(link))
    base = body(robot.base_link)
    names = sorted(set(owners), key=lambda name: (name != base, name))
    mesh.parent.mkdir(parents=True, exist_ok=True)
    trimesh.util.concatenate(pieces).export(mesh)
    labels = np.repeat([names.index(o) for o in owners], [len(p.faces) for p in pieces])
    joints = tuple(_joint(robot, carrier[name], body(carrier[name].parent)) for name in names[1:])
    return Truth(urdf.stem, mesh, tuple(Part(_plain(n), "part") for n in names), labels.astype(np.int64), joints)


def _plain(name: str) -> str:
    return name.replace("/", "_")


def _joint(robot: URDF, joint, parent: str) -> TrueJoint:
    T = Y_UP @ robot.get_transform(joint.child)
    axis = T[:3, :3] @ np.asarray(joint.axis, float)
    limits = None if joint.type == "continuous" else (float(joint.limit.lower), float(joint.limit.upper))
    if limits is not None and -limits[0] > limits[1]:
        axis, limits = -axis, (-limits[1], -limits[0])
    return TrueJoint(_plain(joint.child), _plain(parent), JointType(joint.type), T[:3, 3], axis / np.linalg.norm(axis), limits)
