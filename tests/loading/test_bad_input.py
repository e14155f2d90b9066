"""Test that any file content gives a mesh or an InputError of one line, and that references stay within the folder."""

from __future__ import annotations

import json
import random
import resource
import struct
import warnings
import zlib

import numpy as np
import pytest
from mesh_files import FACES, POINTS, Gltf, all_files, assert_refused, dae, plain_gltf, ply_header, put, rows, stl_binary

from anymesh.errors import InputError
from anymesh.isolation import ChildLimits, ChildPool
from anymesh.loading import load_mesh
from benchmarks import fuzz_readers

FILES = all_files()
HUGE = 2_000_000_000
HEAD = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n"


def test_what_is_no_file(tmp_path) -> None:
    assert_refused(tmp_path / "none.glb", "found no file")
    (tmp_path / "folder.glb").mkdir()
    assert_refused(tmp_path / "folder.glb", "it is a folder; valid is one mesh file")


@pytest.mark.parametrize("ending", [".glb", ".gltf", ".obj", ".ply", ".stl", ".off", ".dae"])
def test_empty_files(tmp_path, ending) -> None:
    assert_refused(put(tmp_path, f"empty{ending}", b""), "0 bytes")
    assert_refused(put(tmp_path, f"blank{ending}", b" \n" * 60), ending[1:].upper())


@pytest.mark.parametrize("name", ["box.qqq", "box", "box.glb.txt"])
def test_an_unknown_ending_names_the_valid_ones(tmp_path, name) -> None:
    assert_refused(put(tmp_path, name, FILES["box.glb"]), "valid are .glb, .gltf, .obj, .ply, .stl, .off, .dae")


ENDINGS = [".glb", ".gltf", ".obj", ".ply", ".stl", ".off", ".dae"]
WRONG = [(name, ending) for name in FILES for ending in ENDINGS if not name.endswith(ending)]


@pytest.mark.parametrize(("name", "ending"), WRONG)
def test_the_content_of_another_format_is_said_to_be_one(tmp_path, name, ending) -> None:
    assert_refused(put(tmp_path, f"wrong{ending}", FILES[name]), f"no {ending[1:].upper()} file", "extension")


def gltf_of(mode: int) -> bytes:
    g = plain_gltf()
    g.doc["meshes"][0]["primitives"][0]["mode"] = mode
    return g.glb()


EMPTY_SCENE = plain_gltf()
EMPTY_SCENE.doc["scenes"][0]["nodes"] = []
WITHOUT_TRIANGLES = {
    "points.glb": (gltf_of(0), "points"),
    "lines.glb": (gltf_of(1), "lines"),
    "none.glb": (EMPTY_SCENE.glb(), "no mesh in its scene"),
    "bare.gltf": (b'{"asset": {"version": "2.0"}}', "no mesh"),
    "points.obj": (rows("v ", POINTS).encode(), "8 points"),
    "lines.obj": ((rows("v ", POINTS) + "l 1 2 3\n").encode(), "no triangle"),
    "points.ply": (ply_header("ascii", faces=0) + rows("", POINTS).encode(), "8 points"),
    "only.ply": (ply_header("ascii").split(b"element face")[0] + b"end_header\n" + rows("", POINTS).encode(), "no faces"),
    "none.stl": (b"\0" * 84, "no triangle"),
    "points.off": (("OFF\n8 0 0\n" + rows("", POINTS)).encode(), "8 points"),
    "none.dae": (dae(nodes='<node id="n"/>'), "no triangles"),
    "zero.dae": (dae() + b"\0<", "found a zero byte"),
    "flat.obj": (b"v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "degenerate"),
    "dot.obj": (b"v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n", "no extent"),
    "far.obj": (b"v 0 0 0\nv 1e20 0 0\nv 0 1 0\nf 1 2 3\n", "1e+20"),
}  # fmt: skip


@pytest.mark.parametrize("name", WITHOUT_TRIANGLES)
def test_files_without_a_usable_triangle(tmp_path, name) -> None:
    data, told = WITHOUT_TRIANGLES[name]
    assert_refused(put(tmp_path, name, data), told)


@pytest.mark.parametrize("name", [name for name in FILES if name != "box.gltf"])  # its numbers are in the other file
@pytest.mark.parametrize("value", ["nan", "inf", "-inf"])
def test_corners_that_are_not_finite(tmp_path, name, value) -> None:
    data = FILES[name]
    low, bad = struct.pack("<f", 3.0), struct.pack("<f", float(value))
    swaps = [(b" 3.0", f" {value}".encode()), (low[::-1], bad[::-1]) if name == "big.ply" else (low, bad)]
    old, new = next((a, b) for a, b in swaps if a in data)
    path = put(tmp_path, name, data.replace(old, new))
    if name == "box.glb":
        assert "triangles whose positions are missing or not finite" in load_mesh(path).warnings[0]
    else:
        assert_refused(path, "finite")


@pytest.mark.parametrize("name", FILES)
def test_truncated_anywhere(tmp_path, name) -> None:
    data = FILES[name]
    whole = 12 if name == "box.obj" else None
    for part in (0.05, 0.3, 0.6, 0.9, 0.97):
        path = put(tmp_path, name, data[: int(len(data) * part)])
        if whole and part > 0.5:  # an OBJ does not state its end
            try:
                assert 0 < len(load_mesh(path).mesh.faces) < whole
            except InputError:
                continue
        else:
            assert_refused(path)


def test_a_buffer_that_is_short_or_missing(tmp_path) -> None:
    path = put(tmp_path, "box.gltf", FILES["box.gltf"])
    (tmp_path / "box.bin").write_bytes(plain_gltf().bin[:50])
    assert_refused(path, "truncated", "found 50")
    (tmp_path / "box.bin").unlink()
    assert_refused(path, "box.bin", "missing")


@pytest.mark.parametrize("index", ["0", "9", "-9", "x", "1.5", "99999999999999999999"])
def test_an_index_that_no_vertex_has(tmp_path, index) -> None:
    assert_refused(put(tmp_path, "x.obj", (rows("v ", POINTS) + f"f 1 2 {index}\n").encode()))
    for name in ("box.off", "ascii.ply") if index != "0" else ():
        path = put(tmp_path, name, FILES[name].replace(b"\n3 0 1", f"\n3 {index} 1".encode()))
        if index in ("9", "-9"):
            loaded = load_mesh(path)
            assert len(loaded.mesh.faces) == len(FACES) - 1
            assert f"such as vertex {index}; valid are 0 to 7" in loaded.warnings[0]
        else:
            assert_refused(path)
    if index == "9":
        g = Gltf()
        g.node(mesh=g.mesh(g.solid(FACES + 2)))
        assert "triangles whose positions are missing" in load_mesh(put(tmp_path, "x.glb", g.glb())).warnings[0]
        none = Gltf()
        none.node(mesh=none.mesh(none.solid(FACES + 8)))
        assert_refused(put(tmp_path, "x.glb", none.glb()), "a face refers to vertex", "valid are 0 to 7")


def absurd() -> dict[str, bytes]:
    views = plain_gltf()
    views.doc["accessors"][0]["count"] = HUGE
    empty = plain_gltf()
    del empty.doc["accessors"][0]["bufferView"]
    empty.doc["accessors"][0]["count"] = HUGE
    stride = plain_gltf()
    stride.doc["accessors"][0]["count"] = 30_000_000
    stride.doc["bufferViews"][0]["byteStride"] = 0
    return {
        "views.glb": views.glb(),
        "empty.glb": empty.glb(),
        "stride.glb": stride.glb(),
        "chunk.glb": FILES["box.glb"][:12] + struct.pack("<I", HUGE) + FILES["box.glb"][16:],
        "ascii.ply": FILES["ascii.ply"].replace(b"vertex 8", b"vertex 2000000000"),
        "faces.ply": FILES["little.ply"].replace(b"face 12", b"face 2000000000"),
        "list.ply": FILES["ascii.ply"].replace(b"\n3 0 1", b"\n2000000000 0 1"),
        "box.off": FILES["box.off"].replace(b"8 12 0", b"2000000000 2000000000 0"),
        "face.off": FILES["box.off"].replace(b"\n3 0 1", b"\n2000000000 0 1"),
        "binary.stl": stl_binary()[:80] + struct.pack("<I", HUGE) + stl_binary()[84:],
    }


@pytest.mark.parametrize("name", absurd())
def test_a_header_that_claims_billions_takes_no_memory(tmp_path, name) -> None:
    path = put(tmp_path, name, absurd()[name])
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    assert_refused(path)
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 200_000  # [KiB]


def test_what_cannot_be_read_is_named(tmp_path) -> None:
    old, circle = plain_gltf(), plain_gltf()
    old.doc["asset"]["version"] = "1.0"
    assert_refused(put(tmp_path, "old.glb", old.glb()), "version 1.0", "valid is 2")
    circle.doc["nodes"][0]["children"] = [0]
    assert_refused(put(tmp_path, "circle.glb", circle.glb()), "valid is a tree")
    bomb = b'<?xml version="1.0"?><!DOCTYPE x [<!ENTITY a "aaaa">]><COLLADA>&a;</COLLADA>'
    assert_refused(put(tmp_path, "bomb.dae", bomb), "document type")
    deep = b'{"meshes": ' + b"[" * 100_000 + b"]" * 100_000 + b"}"
    assert_refused(put(tmp_path, "deep.gltf", deep))


def test_names_with_spaces_and_texture_indices_out_of_range(tmp_path) -> None:
    loaded = load_mesh(put(tmp_path, "my file.obj", HEAD.replace("3/1", "3/7").encode()))
    assert "1 corners have a texture coordinate that does not exist (valid are 1 to 1)" in loaded.warnings[0]
    assert len(load_mesh(put(tmp_path, "my file.obj", HEAD.encode())).mesh.faces) == 1


def test_mutated_files_end_in_a_mesh_or_an_input_error_and_open_nothing_outside() -> None:
    fuzzer = fuzz_readers.Fuzzer(seed=7)
    fuzzer.run(100)
    assert fuzzer.failures == []
    assert fuzzer.counts["mesh"] > 10
    assert fuzzer.counts["refused"] > 10


def test_the_watch_sees_what_leaves_the_folder(tmp_path) -> None:
    (tmp_path / "inside").mkdir()
    (tmp_path / "secret").write_text("x")
    watch = fuzz_readers.Watch()
    watch.folder = str(tmp_path / "inside")
    (tmp_path / "secret").read_text()
    watch.folder = None
    assert watch.outside == [str((tmp_path / "secret").resolve())]


def png_bomb(side: int) -> bytes:
    """Return a few kilobytes that are a picture of side x side pixels."""

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    packed = zlib.compressobj(9)
    rows = b"".join(packed.compress(bytes(1 + 3 * side)) for _ in range(side)) + packed.flush()
    header = struct.pack(">IIBBBBB", side, side, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", rows) + chunk(b"IEND", b"")


def textured(png: bytes) -> bytes:
    g = plain_gltf()
    view = g.view(png)
    g.doc["images"] = [{"bufferView": view, "mimeType": "image/png"}]
    g.doc["textures"] = [{"source": 0}]
    g.doc["materials"] = [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]
    g.doc["meshes"][0]["primitives"][0]["material"] = 0
    return g.glb()


def billion_laughs() -> bytes:
    entities = "".join(f'<!ENTITY e{k + 1} "{f"&e{k};" * 10}">' for k in range(9))
    head = f'<!DOCTYPE COLLADA [<!ENTITY e0 "lol">{entities}]>\n<COLLADA'
    return dae().replace(b"<COLLADA", head.encode(), 1).replace(b'name="red"', b'name="&e9;"')


def disguised_laughs(encoding: str) -> bytes:
    """Return entities in an encoding whose bytes are not ASCII, which pass the check of the first bytes."""
    text = billion_laughs().decode().replace("utf-8", encoding)
    if encoding == "utf-16":
        return text.replace("?>", f"?><!--{b'<COLLADA'.decode('utf-16-le')}-->", 1).encode("utf-16")
    head, rest = text.split("\n", 1)
    return head.encode() + b"<!--<COLLADA-->" + rest.encode(encoding)


def deep_nodes(depth: int) -> bytes:
    opened = b"<node>" * depth + b'<node id="n">'
    return dae().replace(b'<node id="n">', opened).replace(b"</visual_scene>", b"</node>" * depth + b"</visual_scene>")


def many_instances(count: int) -> bytes:
    g = plain_gltf()
    for _ in range(count):
        g.node(mesh=0)
    return g.glb()


BOMBS = {
    "picture.glb": lambda: textured(png_bomb(8000)),
    "laughs.dae": billion_laughs,
    "deep.dae": lambda: deep_nodes(5000),
    "circle.dae": lambda: dae().replace(b'<node id="n">', b'<node id="n"><instance_node url="#n"/>'),
    "instances.glb": lambda: many_instances(5000),
    "utf16.dae": lambda: disguised_laughs("utf-16"),
    "ebcdic.dae": lambda: disguised_laughs("cp037"),
    "counts.ply": lambda: all_files()["little.ply"].replace(b"face 12", b"face 99999999999"),
}


@pytest.fixture(scope="module")
def child():
    with ChildPool(1, ChildLimits(seconds=20.0, memory=3 << 30)) as pool:
        yield pool


@pytest.mark.parametrize("name", BOMBS)
def test_bombs_are_refused_within_the_limits_of_a_child(child, tmp_path, name) -> None:
    path = put(tmp_path, name, BOMBS[name]())
    (result,) = child.run("benchmarks.fuzz_readers", "try_inputs", {"inputs": [(name, path.read_bytes())]})
    assert result["outcome"] in ("mesh", "refused"), result
    assert result["outside"] == []
    assert result["outcome"] == "refused" or name in ("picture.glb", "instances.glb")


def spoiled(data: bytes, rng: random.Random) -> bytes:
    """Return data with a few bytes changed, removed, duplicated, or with the end missing."""
    data = bytearray(data)
    for _ in range(rng.randint(1, 4)):
        at = rng.randrange(max(len(data), 1))
        match rng.randrange(6):
            case 0 | 1:
                data[at : at + 1] = [rng.randrange(256)]
            case 2:
                data[at : at + 1] = [rng.choice(b'0123456789-.e /\n"{}[]<>nul')]
            case 3:
                del data[at : at + rng.randint(1, 9)]
            case 4:
                data[at:at] = data[at : at + rng.randint(1, 40)]
            case _:
                data = data[: max(at, 1)]
    return bytes(data)


def misspelt(data: bytes, rng: random.Random) -> bytes:
    """Return data with a few letters and digits replaced by others, so that the syntax of text stays valid."""
    data = bytearray(data)
    places = [k for k, c in enumerate(data) if chr(c).isalnum()]
    for at in rng.sample(places, rng.randint(1, 3)):
        data[at] = rng.choice(b"0123456789" if chr(data[at]).isdigit() else b"abcdefinstxyz")
    return bytes(data)


@pytest.mark.parametrize("name", [*FILES, "scene.gltf"])
def test_spoiled_files_give_a_mesh_or_an_input_error(tmp_path, name) -> None:
    data = FILES.get(name) or json.dumps(json.loads(FILES["box.gltf"]) | {"materials": [{}], "images": [{}]}).encode()
    rng = random.Random(name)
    good = 0
    for k in range(200):
        path = put(tmp_path, name, (misspelt if k % 2 else spoiled)(data, rng))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            try:
                mesh = load_mesh(path).mesh
            except InputError:
                continue
        good += 1
        assert np.isfinite(mesh.triangles).all()
        assert mesh.diagonal > 0
    assert good > 0 or name == "scene.gltf"
