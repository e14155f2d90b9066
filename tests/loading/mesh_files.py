"""One solid in every format, written by hand: a box from (1, 2, 3) to (2, 4, 6) in the coordinates of the file."""

from __future__ import annotations

import base64
import json
import struct
from pathlib import Path

import DracoPy
import numpy as np
import pytest
from assets import CUBE, CUBE_FACES
from PIL import Image

from anymesh.errors import InputError
from anymesh.loading import LoadedMesh, load_mesh

LOW, HIGH = np.array([1.0, 2, 3]), np.array([2.0, 4, 6])
POINTS = LOW + CUBE * (HIGH - LOW)
FACES = CUBE_FACES
UV = CUBE[:, :2] * 0.5 + 0.25
RED = (1.0, 0.0, 0.0, 1.0)
MESHOPT = Path(__file__).parents[1] / "formats" / "meshopt.json"
TYPES = {"f": 5126, "H": 5123, "B": 5121, "I": 5125}
WIDTHS = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}


class Gltf:
    """Builder of a glTF document from arrays, with GLB or glTF output."""

    def __init__(self) -> None:
        self.bin = b""
        self.doc: dict = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}], "nodes": [], "meshes": []}
        self.doc |= {"accessors": [], "bufferViews": []}

    def view(self, data: bytes, **more) -> int:
        self.doc["bufferViews"].append({"buffer": 0, "byteOffset": len(self.bin), "byteLength": len(data), **more})
        self.bin += data + b"\0" * (-len(data) % 4)
        return len(self.doc["bufferViews"]) - 1

    def array(self, values, kind: str = "f", **more) -> int:
        values = np.asarray(values, "<" + {"H": "u2", "B": "u1", "I": "u4", "f": "f4"}[kind])
        width = 1 if values.ndim == 1 else values.shape[1]
        entry = {"bufferView": self.view(values.tobytes()), "componentType": TYPES[kind], "count": len(values)}
        self.doc["accessors"].append(entry | {"type": WIDTHS[width]} | more)
        return len(self.doc["accessors"]) - 1

    def solid(self, faces=FACES, **attributes) -> dict:
        found = {"attributes": {"POSITION": self.array(POINTS), **attributes}}
        return found | {"indices": self.array(np.reshape(faces, -1), "H")}

    def mesh(self, *primitives, name: str = "box") -> int:
        self.doc["meshes"].append({"name": name, "primitives": list(primitives)})
        return len(self.doc["meshes"]) - 1

    def node(self, *, root: bool = True, **fields) -> int:
        self.doc["nodes"].append(fields)
        number = len(self.doc["nodes"]) - 1
        if root:
            self.doc["scenes"][0]["nodes"].append(number)
        return number

    def glb(self) -> bytes:
        text = json.dumps({**self.doc, "buffers": [{"byteLength": len(self.bin)}]}).encode()
        text += b" " * (-len(text) % 4)
        body = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(self.bin), b"BIN\0") + self.bin
        return struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body

    def gltf(self, uri: str = "box.bin") -> bytes:
        return json.dumps({**self.doc, "buffers": [{"uri": uri, "byteLength": len(self.bin)}]}).encode()


def plain_gltf() -> Gltf:
    g = Gltf()
    g.node(mesh=g.mesh(g.solid()), name="box")
    return g


def draco(data: bytes | None = None) -> bytes:
    g = Gltf()
    g.doc["accessors"] = [
        {"count": 8, "type": "VEC3", "componentType": 5126},
        {"count": 36, "type": "SCALAR", "componentType": 5123},
    ]
    packed = g.view(data or DracoPy.encode(POINTS, FACES, quantization_bits=16, preserve_order=True))
    extension = {"KHR_draco_mesh_compression": {"bufferView": packed, "attributes": {"POSITION": 0}}}
    g.node(mesh=g.mesh({"attributes": {"POSITION": 0}, "indices": 1, "extensions": extension}))
    g.doc["extensionsRequired"] = ["KHR_draco_mesh_compression"]
    return g.glb()


def meshopt(name: str = "EXT_meshopt_compression", broken: bool = False) -> bytes:
    """Return the box as a GLB with meshopt data, written by its own encoder."""
    g, encoded = Gltf(), json.loads(MESHOPT.read_text())
    for key, count, stride, mode in (("positions", 8, 12, "ATTRIBUTES"), ("triangles", 36, 2, "TRIANGLES")):
        data = base64.b64decode(encoded[key])
        view = dict(g.doc["bufferViews"][g.view(data[:-1] if broken else data)])
        packed = {**view, "count": count, "byteStride": stride, "mode": mode}
        g.doc["bufferViews"][-1] = {"buffer": 1, "byteLength": count * stride, "extensions": {name: packed}}
    g.doc["accessors"] = [{"bufferView": 0, "count": 8, "type": "VEC3", "componentType": 5126},
                          {"bufferView": 1, "count": 36, "type": "SCALAR", "componentType": 5123}]  # fmt: skip
    g.node(mesh=g.mesh({"attributes": {"POSITION": 0}, "indices": 1}))
    return g.glb()


def triples(faces=FACES, before: str = "f ", first: int = 1) -> str:
    return "".join(f"{before}{a + first} {b + first} {c + first}\n" for a, b, c in faces)


def rows(prefix: str, values) -> str:
    return "".join(f"{prefix}{' '.join(repr(float(x)) for x in row)}\n" for row in values)


def obj() -> bytes:
    corners = "".join("f " + " ".join(f"{i + 1}/{i + 1}" for i in face) + "\n" for face in FACES)
    return ("mtllib box.mtl\n" + rows("v ", POINTS) + rows("vt ", UV) + "o box\nusemtl red\n" + corners).encode()


MTL = b"newmtl red\nKd 1 0 0\n"


def ply_header(style: str, extra: str = "", faces: int = len(FACES)) -> bytes:
    return (
        f"ply\nformat {style} 1.0\ncomment made by hand\nelement vertex {len(POINTS)}\nproperty float x\nproperty float y\n"
        f"property float z\n{extra}element face {faces}\nproperty list uchar int vertex_indices\nend_header\n"
    ).encode()


def ply_ascii() -> bytes:
    return ply_header("ascii") + (rows("", POINTS) + triples(before="3 ", first=0)).encode()


def ply_binary(order: str = "<") -> bytes:
    style = "binary_little_endian" if order == "<" else "binary_big_endian"
    faces = np.array([(3, f) for f in FACES], np.dtype([("n", "u1"), ("i", order + "i4", 3)]))
    return ply_header(style) + POINTS.astype(order + "f4").tobytes() + faces.tobytes()


def stl_binary() -> bytes:
    triangles = np.zeros(len(FACES), np.dtype([("n", "<f4", 3), ("v", "<f4", (3, 3)), ("a", "<u2")]))
    triangles["v"] = POINTS[FACES]
    return b"\0" * 80 + struct.pack("<I", len(FACES)) + triangles.tobytes()


def stl_ascii() -> bytes:
    facet = "facet normal 0 0 0\n outer loop\n{} endloop\nendfacet\n"
    return ("solid vertex box\n" + "".join(facet.format(rows("  vertex ", t)) for t in POINTS[FACES]) + "endsolid\n").encode()


def off() -> bytes:
    polygons = triples(before="3 ", first=0)
    return (f"OFF\n# a comment\n{len(POINTS)} {len(FACES)} 0\n" + rows("", POINTS) + polygons).encode()


def dae(up: str = "Z_UP", unit: str = '<unit meter="1"/>', nodes: str = "", look: str = "<color>1 0 0 1</color>") -> bytes:
    nodes = nodes or f'<node id="n">{DAE_INSTANCE}</node>'
    points, index = " ".join(map(str, POINTS.reshape(-1))), " ".join(map(str, FACES.reshape(-1)))
    image = '<library_images><image id="pic"><init_from>checker.png</init_from></image></library_images>'
    params = """<newparam sid="s"><surface type="2D"><init_from>pic</init_from></surface></newparam>
<newparam sid="p"><sampler2D><source>s</source></sampler2D></newparam>"""
    if "texture" not in look:
        image = params = ""
    return f"""<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset>{unit}<up_axis>{up}</up_axis></asset>
{image}<library_effects><effect id="fx"><profile_COMMON>{params}
<technique sid="t"><lambert><diffuse>{look}</diffuse></lambert></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="m" name="red"><instance_effect url="#fx"/></material></library_materials>
<library_geometries><geometry id="g" name="g"><mesh><source id="p"><float_array id="pa" count="24">{points}</float_array>
<technique_common><accessor source="#pa" count="8" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="12" material="ms"><input semantic="VERTEX" source="#v" offset="0"/><p>{index}</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s">{nodes}</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>""".encode()


DAE_INSTANCE = (
    '<instance_geometry url="#g"><bind_material><technique_common><instance_material symbol="ms" target="#m"/>'
    "</technique_common></bind_material></instance_geometry>"
)


def all_files() -> dict[str, bytes]:
    """Return file contents by name; the folder also needs box.mtl and box.bin."""
    return {
        "box.glb": plain_gltf().glb(),
        "box.gltf": plain_gltf().gltf(),
        "box.obj": obj(),
        "ascii.ply": ply_ascii(),
        "little.ply": ply_binary("<"),
        "big.ply": ply_binary(">"),
        "binary.stl": stl_binary(),
        "ascii.stl": stl_ascii(),
        "box.off": off(),
        "box.dae": dae(),
    }


def put(folder, name: str, data: bytes):
    """Write a file and those that the files above refer to; return its path."""
    (folder / "box.mtl").write_bytes(MTL)
    (folder / "box.bin").write_bytes(plain_gltf().bin)
    (folder / name).write_bytes(data)
    return folder / name


def assert_refused(path, *told: str) -> str:
    """Return the message of the InputError, which is one line and contains the given words."""
    with pytest.raises(InputError) as caught:
        load_mesh(path)
    message = str(caught.value)
    assert "\n" not in message
    assert path.name in message
    for words in told:
        assert words in message, message
    return message


FILES = all_files()
TEXTURED = ["image.glb", "picture.obj", "picture.ply", "picture.dae"]


def naming(uri: str) -> dict[str, bytes]:
    """Return files that refer to another file, each in its own way; picture.obj through other.mtl."""
    g = plain_gltf()
    g.doc["images"] = [{"uri": uri}]
    g.doc["textures"] = [{"source": 0}]
    g.doc["materials"] = [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]
    g.doc["meshes"][0]["primitives"][0]["material"] = 0
    picture = dae(look='<texture texture="p" texcoord="c"/>').replace(b"checker.png", uri.encode())
    return {
        "buffer.gltf": plain_gltf().gltf(uri),
        "image.glb": g.glb(),
        "library.obj": obj().replace(b"box.mtl", uri.encode()),
        "picture.obj": obj().replace(b"box.mtl", b"other.mtl"),
        "picture.ply": FILES["ascii.ply"].replace(b"made by hand", b"TextureFile " + uri.encode()),
        "picture.dae": picture,
    }


def write_png(path: Path) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    Image.new("RGB", (2, 2), "red").save(path)
    return path


def put_naming(folder: Path, name: str, uri: str) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "other.mtl").write_bytes(f"newmtl red\nKd 1 0 0\nmap_Kd {uri}\nmap_Ke {uri}\n".encode())
    return put(folder, name, naming(uri)[name])


def textures(loaded: LoadedMesh) -> int:
    assert len(loaded.mesh.faces) == 12
    return sum("base_color" in material.textures for material in loaded.mesh.materials)
