"""Test the joints that the physics extensions of glTF state."""

import numpy as np
import pytest
from scenes_that_move import Moving, read, turns
from test_animated import PIVOT, assert_hinge, only

from anymesh.types import JointType

KHR, OMI, BODY = "KHR_physics_rigid_bodies", "OMI_physics_joint", "OMI_physics_body"
FREE_Y = [{"linearAxes": [0, 1, 2], "min": 0, "max": 0}, {"angularAxes": [0, 2], "min": 0, "max": 0}]
HINGE = [*FREE_Y, {"angularAxes": [1], "min": -0.2, "max": 1.5}]
WELD = [{"linearAxes": [0, 1, 2], "angularAxes": [0, 1, 2], "min": 0, "max": 0}]


def slider(**limit):
    return [
        {"angularAxes": [0, 1, 2], "min": 0, "max": 0},
        {"linearAxes": [0, 1], "min": 0, "max": 0},
        {"linearAxes": [2], **limit},
    ]


class Joined(Moving):
    """Builder of bodies and the joints between them."""

    def body(self, low, high, name, kind=KHR, **fields) -> int:
        content = {KHR: {"motion": {"mass": 1}}} if kind == KHR else {BODY: {"motion": {"type": "dynamic"}}}
        return self.box(low, high, name, extensions=content, **fields)

    def join(self, a: int | None, b: int | None, limits, at=PIVOT, kind=KHR, rotation=(0, 0, 0, 1)) -> None:
        """Join two bodies, or the world; the joint's node lies in a, and the other in b, both at a place of the scene."""
        top = self.doc.setdefault("extensions", {}).setdefault(kind, {"physicsJoints": []})
        top["physicsJoints"].append({"limits": limits})
        ends = []
        for body, turn in ((a, (0, 0, 0, 1)), (b, rotation)):
            start = np.zeros(3) if body is None else np.array(self.doc["nodes"][body].get("translation", (0, 0, 0)))
            end = self.node(root=body is None, translation=(np.array(at) - start).tolist(), rotation=list(turn))
            if body is not None:
                self.doc["nodes"][body].setdefault("children", []).append(end)
            ends.append(end)
        joint = {"connectedNode": ends[1], "joint": len(top["physicsJoints"]) - 1}
        self.doc["nodes"][ends[0]]["extensions"] = {kind: {"joint": joint} if kind == KHR else joint}


def cabinet(kind: str = KHR) -> tuple[Joined, int]:
    g = Joined()
    g.box((-0.25, 0, -0.2), (0.25, 0.7, 0.2), "Case")
    return g, g.body((-0.5, 0, 0), (0, 0.7, 0.02), "Door", kind=kind, translation=list(PIVOT))


@pytest.mark.parametrize("kind", [KHR, OMI])
def test_a_hinge_between_the_world_and_a_door(tmp_path, kind):
    g, door = cabinet(kind)
    g.join(None, door, HINGE, kind=kind)
    mesh, warnings = read(g, tmp_path)
    joint = only(mesh)
    assert_hinge(joint, (0, 1, 0), PIVOT, np.rad2deg((-0.2, 1.5)))
    assert (joint.name, joint.reason, joint.parent) == ("Door", f"from {kind}", None)
    assert {node.name: node.joint for node in mesh.nodes} == {"Case": -1, "Door": 0}
    assert not warnings


def test_limits_are_of_the_connected_node_relative_to_the_joints(tmp_path):
    g, door = cabinet()
    g.join(door, None, HINGE)
    assert_hinge(only(read(g, tmp_path)[0]), (0, -1, 0), PIVOT, np.rad2deg((-0.2, 1.5)))


def test_limits_are_counted_from_the_pose_at_rest(tmp_path):
    g, door = cabinet()
    g.join(None, door, HINGE, rotation=turns([30])[0])
    assert_hinge(only(read(g, tmp_path)[0]), (0, 1, 0), PIVOT, np.rad2deg((-0.2, 1.5)) - 30)


def test_a_slider_a_wheel_and_a_slider_of_unknown_range(tmp_path):
    g, door = cabinet()
    g.join(None, door, slider(min=-0.1, max=0.4))
    joint = only(read(g, tmp_path)[0])
    assert (joint.type, joint.limits) == (JointType.PRISMATIC, (-0.1, 0.4))
    np.testing.assert_allclose(joint.axis, (0, 0, 1), atol=1e-9)
    g, door = cabinet()
    g.join(None, door, FREE_Y)
    assert only(read(g, tmp_path)[0]).type is JointType.CONTINUOUS
    g, door = cabinet()
    g.join(None, door, slider(min=0))
    joint = only(read(g, tmp_path)[0])
    assert (joint.limits, joint.range_known) == (None, False)


def test_a_tree_of_bodies_hangs_on_the_largest_if_none_is_static(tmp_path):
    g = Joined()
    case = g.body((-0.25, 0, -0.2), (0.25, 0.7, 0.2), "Case")
    door = g.body((-0.5, 0, 0), (0, 0.7, 0.02), "Door", translation=list(PIVOT))
    knob = g.body((-0.46, 0.3, 0.02), (-0.42, 0.34, 0.05), "Knob", translation=list(PIVOT))
    plate = g.body((-0.46, 0.3, 0.02), (-0.42, 0.4, 0.021), "Plate", translation=list(PIVOT))
    g.join(door, case, HINGE)
    g.join(door, knob, FREE_Y)
    g.join(door, plate, WELD)
    mesh, _ = read(g, tmp_path)
    assert [(j.name, j.parent) for j in mesh.joints] == [("Door", None), ("Knob", 0)]
    assert {node.name: node.joint for node in mesh.nodes} == {"Case": -1, "Door": 0, "Plate": 0, "Knob": 1}


def test_joints_of_the_first_version_name_their_constraints(tmp_path):
    g, door = cabinet(OMI)
    case = next(k for k, node in enumerate(g.doc["nodes"]) if node["name"] == "Case")
    g.doc["nodes"][case]["extensions"] = {BODY: {"type": "static"}}
    constraints = [
        {"linearAxes": [0, 1, 2]},
        {"angularAxes": [0, 1, 2]},
        {"angularAxes": [1], "lowerLimit": 0, "upperLimit": 1.2},
    ]
    g.doc["extensions"] = {OMI: {"constraints": constraints}}
    g.node(translation=list(PIVOT), extensions={OMI: {"constraints": [0, 1, 2], "nodeA": case, "nodeB": door}})
    assert_hinge(only(read(g, tmp_path)[0]), (0, 1, 0), PIVOT, (0, np.rad2deg(1.2)))


def test_a_physics_joint_counts_before_an_animation(tmp_path):
    g, door = cabinet()
    g.join(None, door, HINGE)
    g.turn(door, [0, 30])
    assert only(read(g, tmp_path)[0]).limits == pytest.approx((-0.2, 1.5))


def test_what_is_no_joint_of_a_tree_is_counted(tmp_path):
    g, door = cabinet()
    g.join(None, door, [{"linearAxes": [0, 1, 2], "min": 0, "max": 0}])  # a ball
    assert "1 physics joints that move along several axes" in read(g, tmp_path)[1][0]
    g, door = cabinet()
    g.join(None, door, HINGE)
    g.join(None, door, HINGE, at=(0.25, 0.7, 0.2))
    mesh, warnings = read(g, tmp_path)
    assert len(mesh.joints) == 1
    assert "1 joints that close a loop" in warnings[0]
    g.doc["extensions"][KHR]["physicsJoints"] = []
    assert "2 broken physics joints" in read(g, tmp_path)[1][0]
