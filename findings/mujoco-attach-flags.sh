#!/usr/bin/env bash
# Guess: MjSpec.attach takes over the child's <option>, or warns where child and parent differ.
# Truth: the parent's options stay. It warns of a time step, integrator or gravity that differ, but not of <flag>: a child that
#   turns off filterparent, so that its door collides with its case, loses that without a word.
# Version: mujoco 4.0.0
# Source: mujoco.readthedocs.io/en/stable/programming/modeledit.html, "Attachment"; the flags by running
# Who cares: everyone who attaches an asset to a scene: set the options of the scene, flags above all.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"${PYTHON:-python3}" -m venv venv
venv/bin/pip install -q --disable-pip-version-check mujoco==4.0.0
venv/bin/python - 2> /dev/null <<'PY'
import warnings

import mujoco

CHILD = """<mujoco model="cabinet"><option {}>{}</option><worldbody><body name="case"><freejoint/><geom type="box" size=".5 .5 .5"/>
    <body pos=".5 0 0"><joint axis="0 0 1"/><geom type="box" size=".1 .4 .4"/></body></body></worldbody></mujoco>"""


def contacts(model):
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return data.ncon


def attached(option, flag):
    """Return the number of contacts alone and attached, the attached time step, and the warnings."""
    child = mujoco.MjSpec.from_string(CHILD.format(option, flag))
    parent = mujoco.MjSpec.from_string('<mujoco><worldbody><frame name="here"/></worldbody></mujoco>')
    alone = contacts(mujoco.MjModel.from_xml_string(child.to_xml()))
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        parent.attach(child, frame="here", prefix="cabinet_")
        model = parent.compile()
    return alone, contacts(model), model.opt.timestep, [str(warning.message).split("\n")[1] for warning in caught]


step = attached('timestep="0.001"', "")
flag = attached("", '<flag filterparent="disable"/>')
print("mujoco", mujoco.__version__)
print(f"  child with a time step of 0.001: attached {step[2]}, warnings {step[3]}")
print(f"  child without filterparent: {flag[0]} contacts alone, {flag[1]} attached, warnings {flag[3]}")
if step[2] != 0.002 or len(step[3]) != 1 or flag[0] == 0 or flag[1] != 0 or flag[3]:
    print("changed: see above")
    raise SystemExit(1)
PY
