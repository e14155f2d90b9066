#!/usr/bin/env bash
# Guess: a flat mesh (a label, a pane, a sheet of paper) is fine in MuJoCo as a visual that collides with nothing.
# Truth: a flat visual is refused unless its mesh states inertia="shell", which a URDF cannot say; a single triangle is refused
#   always, since a mesh needs four vertices. A flat mesh that collides is refused in any case.
# Version: mujoco 4.0.0
# Source: the compiler's errors; mujoco.readthedocs.io/en/stable/XMLreference.html#asset-mesh-inertia
# Who cares: everyone who keeps an artist's visuals in URDF (discardvisual="false"): flat ones need a thickness or a second side.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"${PYTHON:-python3}" -m venv venv
venv/bin/pip install -q --disable-pip-version-check mujoco==4.0.0
venv/bin/python - <<'PY'
import mujoco

SQUARE = 'vertex="0 0 0 1 0 0 1 1 0 0 1 0" face="0 1 2 0 2 3"'
TRIANGLE = 'vertex="0 0 0 1 0 0 0 1 0" face="0 1 2"'
OBJ = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n"
URDF = """<robot name="r"><mujoco><compiler discardvisual="false"/></mujoco><link name="base"/><link name="door">
    <inertial><mass value="1"/><inertia ixx=".1" iyy=".1" izz=".1" ixy="0" ixz="0" iyz="0"/></inertial>
    <visual><geometry><mesh filename="pane.obj"/></geometry></visual></link>
    <joint name="hinge" type="continuous"><parent link="base"/><child link="door"/><axis xyz="0 0 1"/></joint></robot>"""


def compiled(text, assets=None):
    try:
        mujoco.MjModel.from_xml_string(text, assets or {})
    except ValueError as error:
        return "refused: " + str(error).split("\n")[0].removeprefix("Error: ")
    return "accepted"


def mjcf(mesh, visual):
    contact = 'contype="0" conaffinity="0"' if visual else ""
    geoms = f'<geom type="box" size=".1 .1 .1"/><geom type="mesh" mesh="pane" {contact}/>'
    return f'<mujoco><asset><mesh name="pane" {mesh}/></asset><worldbody><body>{geoms}</body></worldbody></mujoco>'


found = {
    "MJCF, square, visual": compiled(mjcf(SQUARE, True)),
    "MJCF, square, visual, shell": compiled(mjcf(SQUARE + ' inertia="shell"', True)),
    "MJCF, triangle, visual, shell": compiled(mjcf(TRIANGLE + ' inertia="shell"', True)),
    "MJCF, square, colliding, shell": compiled(mjcf(SQUARE + ' inertia="shell"', False)),
    "URDF, square, visual": compiled(URDF, {"pane.obj": OBJ}),
}
print("mujoco", mujoco.__version__)
for name, result in found.items():
    print(f"  {name}: {result}")
if [result == "accepted" for result in found.values()] != [False, True, False, False, False]:
    raise SystemExit("changed: see above")
PY
