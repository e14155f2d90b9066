#!/usr/bin/env bash
# Guess: Pinocchio's configuration has one number per movable joint, in the order of the URDF.
# Truth: the joints of one link are sorted by name (letter by letter, so drawer_10 comes before drawer_2), and a continuous
#   joint takes two numbers, cosine and sine, so later joints move up. Use model.getJointId(name) and joints[id].idx_q.
# Version: pin 4.1.0
# Source: github.com/stack-of-tasks/pinocchio/issues/379 (urdfdom sorts); the two numbers are in Pinocchio's list of joint models
# Who cares: everyone who passes joint values from asset.json, MuJoCo or Drake (all in the file's order) to Pinocchio.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"${PYTHON:-python3}" -m venv venv
venv/bin/pip install -q --disable-pip-version-check pin==4.1.0
venv/bin/python - <<'PY'
import pinocchio

INERTIAL = '<inertial><mass value="1"/><inertia ixx=".1" iyy=".1" izz=".1" ixy="0" ixz="0" iyz="0"/></inertial>'
LIMIT = '<limit lower="0" upper="1" effort="9" velocity="9"/>'
names = {"knob": "continuous", "drawer_2": "prismatic", "drawer_10": "prismatic"}
text = f'<robot name="desk"><link name="base">{INERTIAL}</link>'
for name, kind in names.items():
    text += f'<link name="{name}_link">{INERTIAL}</link><joint name="{name}" type="{kind}">'
    text += f'<parent link="base"/><child link="{name}_link"/><axis xyz="0 0 1"/>{LIMIT}</joint>'
model = pinocchio.buildModelFromXML(text + "</robot>")
order = list(model.names)[1:]
sizes = [model.joints[model.getJointId(name)].nq for name in order]
print("pinocchio", pinocchio.__version__)
print("  file:", list(names), "Pinocchio:", order, "numbers:", sizes)
if order != sorted(names) or sizes != [1, 1, 2]:
    raise SystemExit("changed: see above")
PY
