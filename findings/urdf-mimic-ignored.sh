#!/usr/bin/env bash
# Guess: an engine that reads a URDF with a mimic joint either couples the joints or says that it does not.
# Truth: PyBullet and Pinocchio read such a file without a word and leave the follower free. In PyBullet the coupling has to be
#   added as a gear constraint; Pinocchio couples with buildModelFromUrdf(..., mimic=True), which is not the default, and has
#   one coordinate less then.
# Version: pybullet 3.2.7, pin 4.1.0
# Source: found by running; the argument is in Pinocchio's documentation of its URDF parser.
# Who cares: mechanisms (a pair of doors on one lever, scissor legs) that fall apart without an error.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"${PYTHON:-python3}" -m venv venv
venv/bin/pip install -q --disable-pip-version-check pybullet==3.2.7 pin==4.1.0
venv/bin/python - > doors.urdf <<'PY'
inertial = '<inertial><mass value="1"/><inertia ixx=".1" iyy=".1" izz=".1" ixy="0" ixz="0" iyz="0"/></inertial>'
print('<robot name="doors">')
for name in ("base", "a", "b"):
    print(f'<link name="{name}">{inertial}</link>')
for name, child, mimic in (("left", "a", ""), ("right", "b", '<mimic joint="left" multiplier="-1" offset="0"/>')):
    print(f'<joint name="{name}" type="revolute"><parent link="base"/><child link="{child}"/><axis xyz="0 0 1"/>')
    print(f'<limit lower="-2" upper="2" effort="9" velocity="9"/>{mimic}</joint>')
print("</robot>")
PY
venv/bin/python - <<'PY'
from importlib.metadata import version

import pybullet

pybullet.connect(pybullet.DIRECT)
robot = pybullet.loadURDF("doors.urdf", useFixedBase=True)
pybullet.setJointMotorControl2(robot, 1, pybullet.VELOCITY_CONTROL, force=0)
for _ in range(480):
    pybullet.setJointMotorControl2(robot, 0, pybullet.POSITION_CONTROL, 0.5, force=9)
    pybullet.stepSimulation()
left, right = (pybullet.getJointState(robot, k)[0] for k in (0, 1))
print("pybullet", version("pybullet"), f"left driven to {left:.2f}, right, which should be at -0.50, at {right:.2f}")
if abs(left - 0.5) > 0.01 or abs(right) > 1e-6:
    raise SystemExit("changed: see above")
PY
venv/bin/python - <<'PY'
import pinocchio

free, coupled = (pinocchio.buildModelFromUrdf("doors.urdf", mimic=mimic) for mimic in (False, True))
default = pinocchio.buildModelFromUrdf("doors.urdf")
print("pinocchio", pinocchio.__version__, f"coordinates: {default.nq} by default, {coupled.nq} with mimic=True")
if (default.nq, free.nq, coupled.nq) != (2, 2, 1):
    raise SystemExit("changed: see above")
PY
