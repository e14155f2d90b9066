#!/usr/bin/env bash
# Guess: loadSDF follows the attribute relative_to of a pose, which SDFormat has had since 1.7, or refuses the file.
# Truth: the attribute is ignored, so the pose counts from the model. The part lands elsewhere, and nothing is said about it.
# Version: pybullet 3.2.7
# Source: found by running; the attribute: sdformat.org, "Specifying pose in SDFormat"
# Who cares: everyone who loads a current SDFormat model in PyBullet; its URDF is placed correctly.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"${PYTHON:-python3}" -m venv venv
venv/bin/pip install -q --disable-pip-version-check pybullet==3.2.7 numpy==2.4.6
venv/bin/python - <<'PY'
from importlib.metadata import version

import pybullet

INERTIAL = "<inertial><mass>1</mass><inertia><ixx>.1</ixx><iyy>.1</iyy><izz>.1</izz></inertia></inertial>"
pybullet.connect(pybullet.DIRECT)


def door_from_case(name, pose):
    """Return the door's place as seen from the case, which stands at x = 1."""
    with open(f"{name}.sdf", "w") as file:
        file.write(f"""<sdf version="1.9"><model name="cabinet">
            <link name="case"><pose>1 0 0 0 0 0</pose>{INERTIAL}</link>
            <link name="door">{pose}{INERTIAL}</link>
            <joint name="hinge" type="revolute"><parent>case</parent><child>door</child>
              <axis><xyz>0 0 1</xyz><limit><lower>0</lower><upper>1</upper></limit></axis></joint></model></sdf>""")
    (model,) = pybullet.loadSDF(f"{name}.sdf")
    case, _ = pybullet.getBasePositionAndOrientation(model)
    return [round(a - b, 3) for a, b in zip(pybullet.getLinkState(model, 0)[4], case)]


absolute = door_from_case("absolute", "<pose>1 0 .5 0 0 0</pose>")
relative = door_from_case("relative", '<pose relative_to="case">0 0 .5 0 0 0</pose>')
print("pybullet", version("pybullet"), "the door is 0.5 above the case, which is at x = 1")
print(f"  pose from the model: {absolute}, relative_to the case: {relative}")
if absolute != [0, 0, 0.5] or relative != [-1, 0, 0.5]:
    raise SystemExit("changed: see above")
PY
