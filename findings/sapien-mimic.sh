#!/usr/bin/env bash
# Guess: a URDF mimic joint in SAPIEN obeys the URDF: follower = multiplier * leader + offset, wherever both joints are.
# Truth: that holds if the follower hangs on the leader's child. For two joints of one parent the relation is turned over,
#   follower = (leader - offset) / multiplier; this shows only if the multiplier is not 1 or -1, or if there is an offset.
#   In all other places (a fixed link in between is enough) the mimic is dropped, without a warning.
# Version: sapien 3.0.3
# Source: github.com/haosulab/SAPIEN/pull/297 (the ratio, open), github.com/haosulab/SAPIEN/issues/236 (which places work)
# Who cares: objects whose parts move together (twin doors, gears, telescopes) in SAPIEN and ManiSkill.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"${PYTHON:-python3}" -m venv venv
venv/bin/pip install -q --disable-pip-version-check sapien==3.0.3
venv/bin/python -W ignore - <<'PY'
import numpy as np
import sapien

INERTIAL = '<inertial><mass value="1"/><inertia ixx=".1" iyy=".1" izz=".1" ixy="0" ixz="0" iyz="0"/></inertial>'


def link(name):
    return f'<link name="{name}">{INERTIAL}</link>'


def turn(name, parent, child, mimic=""):
    limit = '<limit lower="-3" upper="3" effort="9" velocity="9"/>'
    ends = f'<parent link="{parent}"/><child link="{child}"/><axis xyz="0 0 1"/>'
    return f'<joint name="{name}" type="revolute">{ends}{limit}{mimic}</joint>'


def follower_at(text):
    """Drive the leader to 0.5 rad, and return where the follower is."""
    with open("robot.urdf", "w") as file:
        file.write(f'<robot name="r">{text}</robot>')
    physics = sapien.physx.PhysxCpuSystem()
    physics.config.gravity = np.zeros(3)
    physics.timestep = 0.002
    scene = sapien.Scene([physics])
    robot = scene.create_urdf_loader().load("robot.urdf")
    joints = {joint.name: joint for joint in robot.active_joints}
    joints["leader"].set_drive_properties(1000, 100, 1e6, "force")
    joints["leader"].set_drive_target(0.5)
    for _ in range(3000):
        scene.step()
    return round(float(dict(zip(joints, robot.get_qpos()))["follower"]), 2)


plain, mimic = (f'<mimic joint="leader" multiplier="2" offset="{offset}"/>' for offset in (0, 0.2))
bodies = link("base") + link("a") + link("b")
weld = link("middle") + '<joint name="weld" type="fixed"><parent link="base"/><child link="middle"/></joint>'
leader = turn("leader", "base", "a")
found = {
    "URDF": 2 * 0.5 + 0.2,
    "follower on the leader's child, no offset": follower_at(bodies + leader + turn("follower", "a", "b", plain)),
    "two joints of one parent": follower_at(bodies + leader + turn("follower", "base", "b", mimic)),
    "behind a fixed joint": follower_at(bodies + weld + leader + turn("follower", "middle", "b", mimic)),
}
print("sapien", sapien.__version__, "with the leader at 0.5 rad, multiplier 2, offset 0.2:")
for where, angle in found.items():
    print(f"  {where}: follower at {angle}")
chain, siblings, fixed = list(found.values())[1:]
if abs(chain - 1.0) > 0.02 or abs(siblings - 0.15) > 0.02 or abs(fixed) > 0.02:
    raise SystemExit("changed: see above")
PY
