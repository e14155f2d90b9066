#!/usr/bin/env bash
# Guess: in MuJoCo a joint stays where it is while the load is less than its frictionloss.
# Truth: it creeps. By default, a lid of 5 kg whose friction is twice the torque of its weight sinks from 60 to 54 degrees in 5 s, at
#   any time step and any frictionloss: friction is a soft constraint. With solreffriction=".004 1" and
#   solimpfriction=".999 .999 .001" it stays.
# Version: mujoco 4.0.0
# Source: found by running; mujoco.readthedocs.io, chapter Computation, on soft constraints
# Who cares: everyone with a laptop, a lid or a robot arm that friction holds.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"${PYTHON:-python3}" -m venv venv
venv/bin/pip install -q --disable-pip-version-check mujoco==4.0.0
venv/bin/python - <<'PY'
import math

import mujoco

FIRM = 'solreffriction=".004 1" solimpfriction=".999 .999 .001"'


def sunk(ratio, more):
    """Return by how many degrees a lid sinks in 5 s. ratio: of its friction to the torque of its weight at 60 degrees."""
    friction = ratio * 5 * 9.81 * 0.2 * math.cos(math.radians(60))
    model = mujoco.MjModel.from_xml_string(f"""<mujoco><option integrator="implicitfast"/><worldbody><body>
      <joint name="lid" axis="0 -1 0" frictionloss="{friction}" {more}/>
      <inertial pos=".2 0 0" mass="5" diaginertia=".07 .07 .07"/></body></worldbody></mujoco>""")
    data = mujoco.MjData(model)
    data.qpos[0] = math.radians(60)
    while data.time < 5:
        mujoco.mj_step(model, data)
    return round(60 - math.degrees(data.qpos[0]), 2)


soft, softer, firm = sunk(2, ""), sunk(1.3, ""), sunk(1.3, FIRM)
print("mujoco", mujoco.__version__, f"sunk in 5 s: {soft} degrees at twice, {softer} at 1.3 times the torque; firm: {firm}")
raise SystemExit(not (5 < soft < 7 and 5 < softer < 7 and firm < 0.1))
PY
