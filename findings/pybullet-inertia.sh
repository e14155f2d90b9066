#!/usr/bin/env bash
# Guess: loadURDF uses the mass and the inertia that the file states.
# Truth: only the mass. By default the inertia is computed from the collision shape; a link without collision shape gets nearly
#   none. The flag URDF_USE_INERTIA_FROM_FILE reads it from the file.
# Version: pybullet 3.2.7
# Source: github.com/bulletphysics/bullet3/pull/1671, and the flag's description in the PyBullet quickstart guide
# Who cares: everyone who has computed believable inertias; hollow doors and drawers turn like solid blocks.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"${PYTHON:-python3}" -m venv venv
venv/bin/pip install -q --disable-pip-version-check pybullet==3.2.7 numpy==2.4.6
venv/bin/python - <<'PY'
from importlib.metadata import version

import pybullet

LIMIT = '<limit lower="-3" upper="3" effort="9" velocity="9"/>'
pybullet.connect(pybullet.DIRECT)


def inertia(name, collision, flags):
    """Return the link's inertia about z as read back and as felt in one step under a torque of 1 N m."""
    with open(f"{name}.urdf", "w") as file:
        file.write(f"""<robot name="r"><link name="base"/><link name="door">{collision}
            <inertial><mass value="1"/><inertia ixx=".1" iyy=".1" izz=".15" ixy="0" ixz="0" iyz="0"/></inertial></link>
            <joint name="hinge" type="revolute"><parent link="base"/><child link="door"/><axis xyz="0 0 1"/>{LIMIT}</joint>
            </robot>""")
    pybullet.resetSimulation()
    robot = pybullet.loadURDF(f"{name}.urdf", useFixedBase=True, flags=flags)
    pybullet.setJointMotorControl2(robot, 0, pybullet.VELOCITY_CONTROL, force=0)
    pybullet.setJointMotorControl2(robot, 0, pybullet.TORQUE_CONTROL, force=1)
    pybullet.stepSimulation()
    return pybullet.getDynamicsInfo(robot, 0)[2][2], 1 / 240 / pybullet.getJointState(robot, 0)[1]


box = '<collision><geometry><box size="1 1 1"/></geometry></collision>'
found = {
    "box of 1 m": inertia("a", box, 0),
    "no collision shape": inertia("b", "", 0),
    "box, URDF_USE_INERTIA_FROM_FILE": inertia("c", box, pybullet.URDF_USE_INERTIA_FROM_FILE),
}
print("pybullet", version("pybullet"), "file: inertia about z 0.15")
for name, (read, felt) in found.items():
    print(f"  {name}: read back {read:.3g}, felt {felt:.3g}")
solid, bare, told = (read for read, _ in found.values())
if abs(solid - 1 / 6) > 1e-3 or bare > 1e-5 or abs(told - 0.15) > 1e-6:
    raise SystemExit("changed: see above")
PY
