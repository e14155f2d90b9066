"""Files that refer to another file, each in its own way."""

from pathlib import Path

from mesh_files import all_files, dae, obj, plain_gltf, put
from PIL import Image

from anymesh.loading import LoadedMesh

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
