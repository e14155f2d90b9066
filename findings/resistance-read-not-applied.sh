#!/usr/bin/env bash
# Guess: an engine that reads friction and damping of a URDF joint, and gives them back when asked, applies them.
# Truth: PyBullet applies the damping only. Pinocchio's forward dynamics applies neither. In Newton it depends on the solver:
#   SolverMuJoCo applies both, SolverFeatherstone the damping only, SolverXPBD neither. None of them says so.
# Version: pybullet 3.2.7, pin 4.1.0, newton 1.8.0 (mujoco 3.17.0)
# Source: github.com/stack-of-tasks/pinocchio/issues/1291; Newton's table of supported features of its solvers; PyBullet by running
# Who cares: everyone who tunes how hard a drawer is to pull: the same file coasts two to twelve times as far.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"${PYTHON:-python3}" -m venv venv
venv/bin/pip install -q --disable-pip-version-check pybullet==3.2.7 pin==4.1.0 'newton[sim]==1.8.0'
cat > door.urdf <<'XML'
<robot name="cabinet">
  <link name="base">
    <inertial><mass value="1"/><inertia ixx=".1" iyy=".1" izz=".1" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <link name="door">
    <inertial><mass value="1"/><inertia ixx=".1" iyy=".1" izz=".1" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <joint name="hinge" type="revolute">
    <parent link="base"/><child link="door"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" effort="9" velocity="9"/>
    <dynamics damping="0.5" friction="0.3"/>
  </joint>
</robot>
XML
echo "angle after 1 s from 1 rad/s: 0.08 with damping and friction, 0.20 with damping alone, 1.00 with neither"
venv/bin/python - <<'PY'
from importlib.metadata import version

import pybullet

pybullet.connect(pybullet.DIRECT)
robot = pybullet.loadURDF("door.urdf", useFixedBase=True, flags=pybullet.URDF_USE_INERTIA_FROM_FILE)
pybullet.setJointMotorControl2(robot, 0, pybullet.VELOCITY_CONTROL, force=0)
pybullet.resetJointState(robot, 0, 0.0, 1.0)
for _ in range(240):
    pybullet.stepSimulation()
read, angle = pybullet.getJointInfo(robot, 0)[6:8], pybullet.getJointState(robot, 0)[0]
print("pybullet", version("pybullet"), f"reads {read}, angle {angle:.2f}")
if read != (0.5, 0.3) or abs(angle - 0.2) > 0.01:
    raise SystemExit("changed: see above")
PY
venv/bin/python - <<'PY'
import numpy as np
import pinocchio

model = pinocchio.buildModelFromUrdf("door.urdf")
read = (float(model.damping[0]), float(model.upperDryFrictionLimit[0]))
slows = pinocchio.aba(model, model.createData(), np.zeros(1), np.ones(1), np.zeros(1))[0]
print("pinocchio", pinocchio.__version__, f"reads {read}, acceleration at 1 rad/s without torque {slows:.2f}")
if not np.allclose(read, (0.5, 0.3)) or slows != 0:
    raise SystemExit("changed: see above")
PY
venv/bin/python - 2> /dev/null <<'PY'
import newton
import warp

warp.config.quiet = True
found = {}
for name in ("SolverMuJoCo", "SolverFeatherstone", "SolverXPBD"):
    builder = newton.ModelBuilder(gravity=(0, 0, 0))
    builder.add_urdf("door.urdf", floating=False)
    model = builder.finalize(device="cpu")
    solver = getattr(newton.solvers, name)(model, **({"use_mujoco_cpu": True} if name == "SolverMuJoCo" else {}))
    now, after, control = model.state(), model.state(), model.control()
    now.joint_qd.fill_(1.0)
    newton.eval_fk(model, now.joint_q, now.joint_qd, now)
    for _ in range(500):
        solver.step(now, after, control, None, 0.002)
        now, after = after, now
    newton.eval_ik(model, now, now.joint_q, now.joint_qd)
    found[name] = float(now.joint_q.numpy()[0])
    read = (builder.joint_damping[0], builder.joint_friction[0])
    print("newton", newton.__version__, name, f"reads {read}, angle {found[name]:.2f}")
if any(abs(a - b) > 0.02 for a, b in zip(found.values(), (0.082, 0.2, 1.0))):
    print("changed: see above")
    raise SystemExit(1)
PY
