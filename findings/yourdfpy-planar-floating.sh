#!/usr/bin/env bash
# Guess: yourdfpy either moves links of planar and floating joints, or refuses values for them.
# Truth: such joints count as actuated, two coordinates for planar and six for floating, and update_cfg stores values for the planar
#   one, but the link stays where it is. A floating joint takes three values of its six, and its link does not move either.
# Version: yourdfpy 0.0.60
# Source: found by running; a comment in its forward kinematics says that only revolute and prismatic joints have transforms
# Who cares: viewers and tests built on yourdfpy (viser, among others): loose lids and pucks on a table stay at rest.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"${PYTHON:-python3}" -m venv venv
venv/bin/pip install -q --disable-pip-version-check yourdfpy==0.0.60
venv/bin/python - <<'PY'
from importlib.metadata import version

import numpy as np
import yourdfpy


def moved(kind, values):
    """Return the number of coordinates, what update_cfg stored, and where the link is."""
    with open("robot.urdf", "w") as file:
        ends = '<parent link="base"/><child link="lid"/><axis xyz="0 0 1"/>'
        file.write(f'<robot name="r"><link name="base"/><link name="lid"/><joint name="j" type="{kind}">{ends}</joint></robot>')
    robot = yourdfpy.URDF.load("robot.urdf")
    robot.update_cfg({"j": np.array(values)})
    return robot.num_dofs, robot.cfg.tolist(), robot.get_transform("lid", "base")[:3, 3].tolist()


print("yourdfpy", version("yourdfpy"))
found = {kind: moved(kind, values) for kind, values in (("planar", [0.1, 0.2]), ("floating", [0.1, 0.2, 0.3]))}
for kind, (count, stored, place) in found.items():
    print(f"  {kind}: {count} coordinates, stored {stored}, link at {place}")
stayed = all(place == [0, 0, 0] for _, _, place in found.values())
if not stayed or found["planar"][1] != [0.1, 0.2] or found["floating"][0] != 6:
    raise SystemExit("changed: see above")
PY
