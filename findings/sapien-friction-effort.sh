#!/usr/bin/env bash
# Guess: SAPIEN's URDF loader reads friction, damping, effort and velocity of a joint alike.
# Truth: damping arrives; every joint has a friction of 0.05 and a velocity limit of 100, whatever the file says, and no limit of
#   effort.
# Version: sapien 3.0.3
# Source: found by running; joints can be set after loading (set_friction, set_drive_properties with a force limit).
# Who cares: users of SAPIEN and ManiSkill who expect a stiff drawer to be stiff, or a weak motor to be weak.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"${PYTHON:-python3}" -m venv venv
venv/bin/pip install -q --disable-pip-version-check sapien==3.0.3
cat > robot.urdf <<'XML'
<robot name="r">
  <link name="base"/>
  <link name="drawer">
    <inertial><mass value="1"/><inertia ixx=".1" iyy=".1" izz=".1" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <joint name="slide" type="prismatic">
    <parent link="base"/><child link="drawer"/><axis xyz="1 0 0"/>
    <limit lower="0" upper=".4" effort="7" velocity="2"/>
    <dynamics damping=".5" friction="3"/>
  </joint>
</robot>
XML
venv/bin/python -W ignore - <<'PY'
import sapien

scene = sapien.Scene([sapien.physx.PhysxCpuSystem()])
(slide,) = scene.create_urdf_loader().load("robot.urdf").active_joints
found = {"damping": slide.damping, "friction": slide.friction, "effort": slide.force_limit}
found["velocity"] = slide.max_velocity
print("sapien", sapien.__version__, "file: damping 0.5, friction 3, effort 7, velocity 2")
print("  read:", ", ".join(f"{name} {value:.3g}" for name, value in found.items()))
as_told = abs(found["damping"] - 0.5) < 1e-6 and abs(found["friction"] - 0.05) < 1e-6
if not as_told or found["effort"] < 1e30 or found["velocity"] != 100:
    raise SystemExit("changed: see above")
PY
