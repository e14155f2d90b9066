#!/usr/bin/env bash
# Guess: in MuJoCo a URDF joint whose limits are both 0, or which states none (URDF: they default to 0), cannot move.
# Truth: it has no limits at all. For limits that are stated a warning is printed, for missing ones nothing; both turn freely.
# Version: mujoco 4.0.0
# Source: MuJoCo's warning; wiki.ros.org/urdf/XML/joint for the default of 0
# Who cares: everyone who locks a joint by limits of 0, as tools do that freeze a robot's wheels or a door.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"${PYTHON:-python3}" -m venv venv
venv/bin/pip install -q --disable-pip-version-check mujoco==4.0.0
venv/bin/python - <<'PY'
import mujoco

INERTIAL = '<inertial><mass value="1"/><inertia ixx=".1" iyy=".1" izz=".1" ixy="0" ixz="0" iyz="0"/></inertial>'


def turned(limits):
    """Return the angle after 1 s under 1 N m, and whether the joint is limited."""
    model = mujoco.MjModel.from_xml_string(f"""<robot name="r"><link name="base"/><link name="door">{INERTIAL}</link>
        <joint name="hinge" type="revolute"><parent link="base"/><child link="door"/><axis xyz="0 0 1"/>
          <limit {limits} effort="9" velocity="9"/></joint></robot>""")
    data = mujoco.MjData(model)
    data.qfrc_applied[0] = 1
    while data.time < 1:
        mujoco.mj_step(model, data)
    return round(float(data.qpos[0]), 2), bool(model.jnt_limited[0])


print("mujoco", mujoco.__version__, "angle after 1 s under 1 N m, and whether the joint is limited:", flush=True)
found = {limits: turned(limits) for limits in ('lower="0" upper="0.01"', 'lower="0" upper="0"', "")}
for limits, result in found.items():
    print(f"  {limits or 'no limits stated'}: {result}")
narrow, equal, missing = found.values()
if narrow[0] > 0.1 or not narrow[1] or min(equal[0], missing[0]) < 4 or equal[1] or missing[1]:
    raise SystemExit("changed: see above")
PY
