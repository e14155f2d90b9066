#!/usr/bin/env bash
# Guess: trimesh converts vertex colours between the linear values of glTF and the sRGB bytes of PLY and its own arrays.
# Truth: it copies the numbers. A grey that glTF states as 0.5 becomes the byte 128 in PLY (right: 188), so GLB to PLY is too dark,
#   and PLY to GLB too bright.
# Version: trimesh 5.2.0
# Source: github.com/KhronosGroup/glTF/issues/1638 (COLOR_0 is linear); the copy by running
# Who cares: whoever converts coloured scans or parts between GLB and PLY or OBJ with trimesh, and compares colours.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"${PYTHON:-python3}" -m venv venv
venv/bin/pip install -q --disable-pip-version-check trimesh==5.2.0
venv/bin/python - <<'PY'
import json
import struct

import trimesh

floats = {"componentType": 5126, "count": 3}
data = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0) + struct.pack("<12f", *[0.5, 0.5, 0.5, 1] * 3)
document = {
    "asset": {"version": "2.0"},
    "scene": 0,
    "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "COLOR_0": 1}}]}],
    "accessors": [
        {"bufferView": 0, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0], **floats},
        {"bufferView": 1, "type": "VEC4", **floats},
    ],
    "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 48}],
    "buffers": [{"byteLength": len(data)}],
}
text = json.dumps(document).encode()
text += b" " * (-len(text) % 4)
with open("grey.glb", "wb") as file:
    file.write(struct.pack("<4sIII4s", b"glTF", 2, 28 + len(text) + len(data), len(text), b"JSON") + text)
    file.write(struct.pack("<I4s", len(data), b"BIN\0") + data)
ply = trimesh.load_scene("grey.glb").to_geometry().export(file_type="ply", encoding="ascii").decode()
byte = int(ply.split("end_header")[1].split()[3])
linear = 0.5
right = round(255 * (1.055 * linear ** (1 / 2.4) - 0.055))
print("trimesh", trimesh.__version__, f"linear 0.5 in GLB becomes {byte} in PLY, right: {right}")
if byte != 128:
    raise SystemExit("changed: see above")
PY
