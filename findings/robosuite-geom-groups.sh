#!/usr/bin/env bash
# Guess: robosuite's MujocoXMLObject takes any valid MJCF object, and tells collision shapes from visuals by contype.
# Truth: it goes by the number of the geom's group: 0 collides, 1 is seen, and geoms of all other groups are deleted without a
#   word. An MJCF with the usual groups of MuJoCo Menagerie (2 visual, 3 collision) becomes an object of nothing. It also needs a
#   body called "object" and three named sites; without them it raises an AttributeError of None.
# Version: robosuite 1.5.2, mujoco 4.0.0
# Source: robosuite.ai/docs/modeling/object_model.html (obj_type); the deletion and the errors by running
# Who cares: everyone who brings an object to robosuite, LIBERO or RoboCasa.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"${PYTHON:-python3}" -m venv venv
venv/bin/pip install -q --disable-pip-version-check robosuite==1.5.2 mujoco==4.0.0
venv/bin/python - 2> log <<'PY' || { cat log; exit 1; }
from importlib.metadata import version

from robosuite.models.objects import MujocoXMLObject

VISUAL = '<geom name="seen{0}" group="{0}" type="box" size=".1 .1 .1" contype="0" conaffinity="0"/>'
SOLID = '<geom name="solid{0}" group="{0}" type="box" size=".1 .1 .1"/>'
SITES = "".join(f'<site name="{name}_site" pos=".1 .1 .1"/>' for name in ("bottom", "top", "horizontal_radius"))


def loaded(name, body, geoms, sites=SITES):
    """Return the geoms that are left, or the error."""
    with open(f"{name}.xml", "w") as file:
        inner = f'<body name="{body}">{geoms}</body>'
        file.write(f'<mujoco model="m"><worldbody><body>{inner}{sites}</body></worldbody></mujoco>')
    try:
        made = MujocoXMLObject(f"{name}.xml", name="my", joints=None, obj_type="all", duplicate_collision_geoms=False)
        made.horizontal_radius
    except AttributeError as error:
        return str(error)
    return [geom.get("name") for geom in made.worldbody.iter("geom")]


menagerie, own = VISUAL.format(2) + SOLID.format(3), VISUAL.format(1) + SOLID.format(0)
found = {
    "groups 2 and 3": loaded("a", "object", menagerie),
    "groups 1 and 0": loaded("b", "object", own),
    "body of another name": loaded("c", "case", own),
    "no sites": loaded("d", "object", own, ""),
}
print("robosuite", version("robosuite"))
for name, result in found.items():
    print(f"  {name}: {result}")
empty, full, *errors = found.values()
if empty or sorted(full) != ["my_seen1", "my_solid0"] or not all("NoneType" in str(error) for error in errors):
    raise SystemExit("changed: see above")
PY
