#!/usr/bin/env bash
# Guess: a USD mesh at /cabinet/door/visual comes into Blender as an object "visual" below an object "door".
# Truth: an Xform with one visible mesh and the mesh become one object, which has the name of the mesh: with the usual names, the
#   links become visual, visual.001, visual.002, and the name of the link is nowhere. A collision mesh of purpose guide beside
#   the visual changes nothing, since it is left out. merge_parent_xform=False (in the dialog: Merge parent Xform) keeps both.
# Version: bpy 5.0.1 (Python 3.11 only)
# Source: docs.blender.org/api, bpy.ops.wm.usd_import, merge_parent_xform
# Who cares: artists who open simulation-ready USD in Blender: name the mesh after its link.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"${PYTHON:-python3}" -m venv venv
venv/bin/pip install -q --disable-pip-version-check bpy==5.0.1
venv/bin/python - <<'PY'
import bpy

MESH = """
{{
    {attribute}
    int[] faceVertexCounts = [3]
    int[] faceVertexIndices = [0, 1, 2]
    point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
}}
"""
GUIDE = 'uniform token purpose = "guide"'


def imported(names, **options):
    text = '#usda 1.0\n(\n    defaultPrim = "cabinet"\n    upAxis = "Z"\n    metersPerUnit = 1\n)\ndef Xform "cabinet"\n{\n'
    for link, mesh in names.items():
        shapes = f'def Mesh "{mesh}"' + MESH.format(attribute="") + 'def Mesh "hull"' + MESH.format(attribute=GUIDE)
        text += f'def Xform "{link}"\n{{\n{shapes}}}\n'
    with open("cabinet.usda", "w") as file:
        file.write(text + "}\n")
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.usd_import(filepath="cabinet.usda", **options)
    return sorted(thing.name for thing in bpy.data.objects)


same = {"door": "visual", "drawer": "visual"}
merged = imported(same)
kept = imported(same, merge_parent_xform=False)
named = imported({"door": "door_visual", "drawer": "drawer_visual"})
print("bpy", bpy.app.version_string)
print("  meshes called visual:", merged)
print("  the same, merge_parent_xform=False:", kept)
print("  meshes called after their links:", named)
as_told = merged == ["cabinet", "visual", "visual.001"] and {"door", "drawer"} <= set(kept)
if not as_told or named != ["cabinet", "door_visual", "drawer_visual"]:
    raise SystemExit("changed: see above")
PY
