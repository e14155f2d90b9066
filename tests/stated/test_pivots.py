"""Pivots of nodes: which tell about a hinge, and what stage B makes of them."""

from dataclasses import replace

import numpy as np
import pytest
from scenes_that_move import Moving, cabinet, read

from anymesh.articulation.estimate import PartMotions
from anymesh.geometry.boxes import box_in_frame
from anymesh.loading import load_mesh
from anymesh.loading.join import join
from anymesh.loading.load import place_mesh
from anymesh.motion.part_context import pivot_of
from anymesh.pipeline.solving import Solver, solve
from anymesh.segmentation.naming import parts_from_nodes
from anymesh.stated.pivots import at_hinge
from anymesh.types import Joint, JointType, Mesh, Node

CORNERS = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
DOOR = ((0.02, 0, 0.2), (0.48, 0.7, 0.22))  # between the corners, in the scene


def scene(pivot=(0.0, 0, 0), sides=DOOR, case=(0.25, 0, 0.1), **fields) -> Moving:
    """Return a case with a door; pivot, case: origins of the two nodes in the scene."""
    g = Moving()
    g.box(-np.array(case), np.array((0.5, 0.7, 0.2)) - case, "body_1", translation=list(case))
    g.box(np.subtract(sides[0], pivot), np.subtract(sides[1], pivot), "panel_1", translation=list(pivot), **fields)
    return g


def pivots(g: Moving, folder) -> list:
    return [None if n.pivot is None else np.round(n.pivot, 6).tolist() for n in read(g, folder)[0].nodes]


def joints(mesh: Mesh) -> tuple[Joint, ...]:
    """Return the joints of the nodes of a mesh with y up; the frame is that of the asset."""
    T = np.array([(1.0, 0, 0, 0), (0, 0, -1, 0), (0, 1, 0, 0), (0, 0, 0, 1)])
    mesh = mesh.transformed(T)
    return solve(mesh, parts_from_nodes(mesh))[1]


@pytest.mark.parametrize(
    ("half", "place", "tells"),
    [
        ((1, 1.25, 0.37), (0.85, -0.2, -1), True),  # a fridge's door
        ((0.65, 0.6, 0.2), (0, -0.95, -1), True),  # an oven's door
        ((0.85, 0.48, 0.72), (0, -0.66, -0.81), True),  # a chest's lid
        ((0.8, 1.5, 0.08), (-0.87, -1, 0), True),  # the leaf of a gate
        ((7.1, 0.45, 1.1), (1, 0, 0), True),  # the end of an arm
        ((1.3, 1.3, 0.3), (1, 0, 0), True),  # the rim of a round door
        ((0.03, 0.07, 0.07), (0, 0, 0), False),  # the middle of a wheel
        ((2, 2, 0.53), (0, 0, 1), False),  # the hub of a wheel at its side
        ((0.8, 0.72, 0.5), (0, -0.32, 0.11), False),  # the hub of a rotor
        ((0.8, 1.5, 0.08), (0, -1, 0), False),  # where a panel stands
        ((1, 0.5, 1), (0, 0, -1), False),  # the middle of a side of a block
        ((1, 0.5, 0.9), (1, -1, 1), False),  # the corner of a block
        ((1, 1, 1), (3, 0, 0), False),  # elsewhere
    ],
)
def test_a_pivot_tells_where_a_hinge_may_be(half, place, tells: bool) -> None:
    box = box_in_frame(CORNERS * half + np.array((5.0, 6, 7)), np.eye(3))
    assert at_hinge(box, np.multiply(half, place) + np.array((5.0, 6, 7)), np.array([0.0, 1, 0])) is tells


def test_only_a_pivot_of_its_own_is_kept(tmp_path) -> None:
    hinge = [0.48, 0.0, 0.2]
    assert pivots(scene(hinge), tmp_path) == [hinge, None]
    assert pivots(scene(), tmp_path) == [None, None]  # of the scene
    assert pivots(scene(hinge, case=hinge), tmp_path) == [None, None]  # of the larger node
    assert pivots(scene((0.48, 0, 0.2), ((0.02, 0, 0.2), (0.48, 0.7, 0.3)), case=(0.5, 0, 0)), tmp_path) == [None, None]


def test_corners_of_all_boxes_say_nothing(tmp_path) -> None:
    g = Moving()
    for k in range(4):
        g.box((0, 0, 0), (0.4, 0.02 + 0.01 * k, 0.3), f"board_{k}", translation=[1.0, 0.1 + 0.1 * k, 1.0])
    assert pivots(g, tmp_path) == [None] * 4


def test_a_pivot_moves_with_its_mesh(tmp_path) -> None:
    mesh, _ = read(scene((0.48, 0, 0.2)), tmp_path)
    T = np.array([(0.0, -2, 0, 1), (2, 0, 0, 2), (0, 0, -2, 3), (0, 0, 0, 1)])
    for moved in (mesh.transformed(T), join([mesh.transformed(T), mesh]), mesh.transformed(T).subset(mesh.face_node == 0)):
        assert moved.nodes[0].pivot == pytest.approx(T[:3] @ (0.48, 0, 0.2, 1))
    assert mesh.without_joints().nodes[0].pivot is None
    assert load_mesh(tmp_path / "scene.glb", animation="ignore").mesh.face_pivot is None


@pytest.mark.parametrize("x", [0.02, 0.48])
def test_a_hinge_is_on_the_side_of_the_pivot(tmp_path, x: float) -> None:
    (joint,) = joints(read(scene((x, 0, 0.2)), tmp_path)[0])
    assert (joint.type, abs(joint.axis[2])) == (JointType.REVOLUTE, pytest.approx(1))
    assert joint.origin[:2] == pytest.approx((x, -0.2), abs=1e-3)
    assert "with the file's pivot of its node on this axis" in joint.reason


def test_leaves_turn_about_their_outer_sides(tmp_path) -> None:
    g = scene((0.02, 0, 0.2), (DOOR[0], (0.249, 0.7, 0.22)))
    g.box((-0.229, 0, 0), (0, 0.7, 0.02), "panel_2", translation=[0.48, 0, 0.2])
    assert sorted(j.origin[0] for j in joints(read(g, tmp_path)[0])) == pytest.approx([0.02, 0.48], abs=1e-3)


def test_a_pivot_that_says_nothing_changes_nothing(tmp_path) -> None:
    plain, middle = read(scene(), tmp_path)[0], read(scene((0.25, 0.35, 0.21)), tmp_path)[0]
    assert plain.nodes == middle.nodes
    assert np.allclose(plain.vertices, middle.vertices)
    sides = replace(plain, nodes=(Node("panel_1", pivot=(0.48, 0.0, 0.2)), Node("body_1")))
    motions = [_motions(mesh) for mesh in (plain, sides)]
    assert [sum(c.at_pivot for c in m.motions.candidates) > 0 for m in motions] == [False, True]
    assert motions[0].context.pivot is None


def _motions(mesh: Mesh) -> PartMotions:
    return Solver(mesh).geometry.motions(parts_from_nodes(mesh))[0]


def test_an_animation_decides_over_a_pivot(tmp_path) -> None:
    g, door = cabinet()
    g.slide(door, (0.0, 0.2), rest=(0.25, 0, 0.2))
    (joint,) = joints(read(g, tmp_path)[0])
    assert (joint.type, joint.reason) == (JointType.PRISMATIC, 'from the animation "Open"')


def test_a_part_of_several_nodes_has_the_pivot_of_the_largest(tmp_path) -> None:
    g = scene((0.48, 0, 0.2))
    g.box((0.05, 0.3, 0.22), (0.06, 0.4, 0.23), "knob")
    mesh = place_mesh(read(g, tmp_path)[0] and load_mesh(tmp_path / "scene.glb")).mesh
    parts = parts_from_nodes(mesh)
    together = replace(parts, face_part=np.minimum(parts.face_part, 1), parts=parts.parts[:2])
    whole = Solver(mesh).geometry.shape_for(together)
    labels = together.face_part[whole.source]
    assert pivot_of(whole, labels == 1) == pytest.approx(next(n.pivot for n in mesh.nodes if n.name == "panel_1"))
    assert pivot_of(whole, labels >= 0) is None
