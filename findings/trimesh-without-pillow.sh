#!/usr/bin/env bash
# Guess: trimesh raises or warns if it cannot decode a texture.
# Truth: without Pillow, which trimesh does not install by itself, the textures of a GLB are None, with no warning even at
#   -W error; if the scene is exported again, its pictures are gone.
# Version: trimesh 5.2.0
# Source: trimesh.org/install.html lists Pillow as optional; the silence by running
# Who cares: whoever loads our GLB with `pip install trimesh`, and finds grey doors.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"${PYTHON:-python3}" -m venv venv
venv/bin/pip install -q --disable-pip-version-check trimesh==5.2.0
cat > texture.py <<'PY'
import json
import struct
import zlib

import trimesh


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


header = struct.pack(">IIBBBBB", 1, 1, 8, 2, 0, 0, 0)
png = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(b"\0\xff\0\0")) + chunk(b"IEND", b"")
corners = struct.pack("<15f", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1)
data = corners + png + b"\0" * (-len(png) % 4)
views = [{"byteLength": 36}, {"byteOffset": 36, "byteLength": 24}, {"byteOffset": 60, "byteLength": len(png)}]
floats = {"componentType": 5126, "count": 3}
document = {
    "asset": {"version": "2.0"},
    "scene": 0,
    "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"material": 0, "attributes": {"POSITION": 0, "TEXCOORD_0": 1}}]}],
    "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
    "textures": [{"source": 0}],
    "images": [{"bufferView": 2, "mimeType": "image/png"}],
    "accessors": [
        {"bufferView": 0, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0], **floats},
        {"bufferView": 1, "type": "VEC2", **floats},
    ],
    "bufferViews": [{"buffer": 0, **view} for view in views],
    "buffers": [{"byteLength": len(data)}],
}
text = json.dumps(document).encode()
text += b" " * (-len(text) % 4)
with open("panel.glb", "wb") as file:
    file.write(struct.pack("<4sIII4s", b"glTF", 2, 28 + len(text) + len(data), len(text), b"JSON") + text)
    file.write(struct.pack("<I4s", len(data), b"BIN\0") + data)
scene = trimesh.load_scene("panel.glb")
(mesh,) = scene.geometry.values()
again = scene.export(file_type="glb")
images = json.loads(again[20 : 20 + struct.unpack("<I", again[12:16])[0]]).get("images", [])
print(f"texture {'read' if mesh.visual.material.baseColorTexture else None}, images written again: {len(images)}")
PY
without=$(venv/bin/python -W error texture.py)
venv/bin/pip install -q --disable-pip-version-check pillow==13.0.0
with=$(venv/bin/python -W error texture.py)
echo "trimesh 5.2.0 without Pillow: $without"
echo "with Pillow 13.0.0: $with"
if [ "$without/$with" != "texture None, images written again: 0/texture read, images written again: 1" ]; then
  echo "changed: see above"
  exit 1
fi
