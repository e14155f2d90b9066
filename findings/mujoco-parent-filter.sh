#!/usr/bin/env bash
# Guess: MuJoCo leaves out contacts between a body and its parent, as its documentation says of filterparent.
# Truth: not if the parent cannot move: a body without a joint in the world counts as a part of the world, and the world collides
#   with everything. So a door that overlaps its case is pushed out when the cabinet is fixed, and not when it is free.
# Version: mujoco 4.0.0
# Source: mujoco.readthedocs.io/en/stable/computation/index.html, "Collision detection", selection
# Who cares: assets with a fixed base (every URDF in MuJoCo has one): pairs that touch need an <exclude>.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"${PYTHON:-python3}" -m venv venv
venv/bin/pip install -q --disable-pip-version-check mujoco==4.0.0
venv/bin/python - <<'PY'
import mujoco


def contacts(root):
    model = mujoco.MjModel.from_xml_string(f"""<mujoco><worldbody>
        <body name="case">{root}<geom type="box" size=".5 .5 .5"/>
          <body name="door" pos=".5 0 0"><joint axis="0 0 1"/><geom type="box" size=".1 .4 .4"/></body>
        </body></worldbody></mujoco>""")
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return data.ncon


free, fixed = contacts("<freejoint/>"), contacts("")
print("mujoco", mujoco.__version__, f"contacts of a door with its case: {free} if the case is free, {fixed} if it is fixed")
if free != 0 or fixed == 0:
    raise SystemExit("changed: see above")
PY
