#!/usr/bin/env bash
# Guess: dry friction of a joint (frictionloss) holds it under a torque that is smaller.
# Truth: it is a soft constraint, so the joint creeps at a speed in proportion to torque over inertia: a knob turns
#   more than a whole turn in a second. Stiff `solreffriction` and `solimpfriction` hold it; a URDF
#   cannot state them, nor does Newton take them without its own registration of attributes.
# Version: mujoco 4.0.0
# Source: MuJoCo's documentation of solver parameters ("friction loss"); the size of it by running
# Who cares: knobs, buttons and small wheels that should stay as they were set
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"${PYTHON:-python3}" -m venv venv
venv/bin/pip install -q --disable-pip-version-check mujoco==4.0.0
venv/bin/python - <<'PY'
import mujoco

KNOB = """<mujoco><option integrator="implicitfast"/><worldbody><body>
  <inertial pos="0 0 0" mass=".014" diaginertia="3e-6 3e-6 3e-6"/><joint axis="0 0 1" frictionloss=".05" {}/>
</body></worldbody></mujoco>"""
found = {}
for name, words in (("default", ""), ("stiff", 'solreffriction=".004 1" solimpfriction=".9999 .9999 .001 .5 2"')):
    model = mujoco.MjModel.from_xml_string(KNOB.format(words))
    data = mujoco.MjData(model)
    data.qfrc_applied[0] = 0.025
    while data.time < 1:
        mujoco.mj_step(model, data)
    found[name] = float(data.qpos[0])
    print("mujoco", mujoco.__version__, f"{name}: friction 0.05 N m, after 1 s under 0.025 N m at {found[name]:.3f} rad (right: 0)")
if found["default"] < 6 or found["stiff"] > 0.01:
    raise SystemExit("changed: see above")
PY
