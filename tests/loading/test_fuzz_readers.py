"""Test a short fuzzing run of the readers, and decompression bombs.

`python -m benchmarks.fuzz_readers` does thousands of runs.
"""

from __future__ import annotations

import struct
import zlib

import pytest
from mesh_files import all_files, dae, plain_gltf, put

from anymesh.isolation import ChildLimits, ChildPool
from benchmarks import fuzz_readers


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
def test_bombs_take_little_memory_and_time(child, tmp_path, name) -> None:
    path = put(tmp_path, name, BOMBS[name]())
    (result,) = child.run("benchmarks.fuzz_readers", "try_inputs", {"inputs": [(name, path.read_bytes())]})
    assert result["outcome"] in ("mesh", "refused"), result
    assert result["outside"] == []
    assert result["outcome"] == "refused" or name in ("picture.glb", "instances.glb")
