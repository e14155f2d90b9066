"""Fuzzing of the readers: mutated files of every format, in a child process with limits.

python -m benchmarks.fuzz_readers [--inputs 20000] [--seed 0] [--keep FOLDER]

Every input must end in a mesh or an InputError, within limits on memory and time, and nothing outside its folder may be opened
and no connection made (watched by the interpreter's audit hooks). What fails is kept in FOLDER.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import re
import struct
import sys
import tempfile
import time
import warnings
import zlib
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

from anymesh.errors import InputError
from anymesh.isolation import ChildError, ChildLimits, ChildPool
from anymesh.loading import load_mesh
from benchmarks import ROOT
from benchmarks.fuzz_scenes import scene, write_scene

sys.path += [str(ROOT / "tests" / "loading"), str(ROOT / "tests")]  # the hand-written files of the tests

MEMORY = 3 << 30  # [bytes] of address space for one input
SECONDS = 20.0  # [s] of processor time for one input
BATCH = 50
Result = dict[str, Any]
NUMBERS = ["0", "-1", "1e308", "nan", "-inf", "99999999999999999999", "2147483648", "4294967295", "0x10", "1e-400", "", "1.5"]
VALUES: list[Any] = [None, True, -1, 0, 2**31, 2**63, 1e308, "x", [], {}, [[]], {"a": 1}, 3.5, [0] * 50, "\x00"]
REFERENCES = [
    "../secret.bin", "/etc/passwd", "a/../../secret.bin", "file:///etc/passwd", "http://127.0.0.1:9/x", "https://example.org/x",
    "\\\\server\\x", "C:\\secret.bin", "%2e%2e/secret.bin", "..%2fsecret.bin", "link.bin", "x" * 5000, "\x00", "data:,", "",
    "data:application/octet-stream;base64,AAAA", "package://../secret.bin", "FILE:/etc/passwd", "box.bin/../../secret.bin", ".",
    "/dev/zero", "/proc/self/mem", "//etc/passwd", "~/.ssh/id_rsa", "$HOME/x", "fifo.bin",
]  # fmt: skip
KEYS = ("uri", "map_Kd", "mtllib", "init_from", "TextureFile")
Mutation = Callable[[bytes, random.Random], bytes]


def bytes_changed(data: bytes, rng: random.Random) -> bytes:
    """A few bytes changed, cut out, doubled, or the end missing."""
    made = bytearray(data)
    for _ in range(rng.randint(1, 6)):
        at = rng.randrange(max(len(made), 1))
        match rng.randrange(5):
            case 0:
                made[at : at + 1] = [rng.randrange(256)]
            case 1:
                del made[at : at + rng.choice([1, 2, 4, 8, 100])]
            case 2:
                made[at:at] = made[at : at + rng.choice([1, 4, 40, 400])]
            case 3:
                made[at : at + 4] = struct.pack("<I", rng.choice([0, 1, 2**16, 2**31 - 1, 2**32 - 1]))
            case _:
                made = made[: max(at, 1)] if rng.random() < 0.2 else made
    return bytes(made)


def number_changed(data: bytes, rng: random.Random) -> bytes:
    """Numbers in text that became others."""
    found = list(re.finditer(rb"-?\d+(\.\d+)?(e[+-]?\d+)?", data[:200_000]))
    made = data
    for one in sorted(rng.sample(found, min(len(found), rng.randint(1, 3))), key=lambda m: -m.start()):
        made = made[: one.start()] + rng.choice(NUMBERS).encode() + made[one.end() :]
    return made


def lines_shuffled(data: bytes, rng: random.Random) -> bytes:
    """Lines doubled many times, swapped, joined, or very long."""
    lines = data.split(b"\n")
    at = rng.randrange(len(lines))
    match rng.randrange(5):
        case 0:
            lines[at:at] = [lines[at]] * rng.choice([2, 100, 5000])
        case 1:
            other = rng.randrange(len(lines))
            lines[at], lines[other] = lines[other], lines[at]
        case 2:
            lines[at] = lines[at] + b" " + b" ".join([lines[at][-20:]] * rng.choice([5, 5000]))
        case 3:
            lines[at : at + 2] = [b" ".join(lines[at : at + 2])]
        case _:
            lines[at] = b"x" * rng.choice([10, 1_000_000])
    return b"\n".join(lines)


def reference_changed(data: bytes, rng: random.Random) -> bytes:
    """A name of a file that leads elsewhere."""
    new = rng.choice(REFERENCES).encode()
    pattern = rng.choice([rb'("uri":\s*")[^"]*', rb"(mtllib |map_Kd )[^\n]*", rb"(<init_from>)[^<]*", rb"(TextureFile )[^\n]*"])
    return re.sub(pattern, lambda m: m[1] + new, data)


def tree_changed(data: bytes, rng: random.Random) -> bytes:
    """A value in the JSON of a glTF or GLB that became another; parents in circles; deep and wide trees of nodes."""
    text, rest = _split(data)
    try:
        tree = json.loads(text)
        nodes = tree.get("nodes", [])
        match rng.randrange(6):
            case 0:
                for _ in range(rng.randint(1, 3)):
                    _change(tree, rng)
            case 1 if nodes:
                rng.choice(nodes)["children"] = [rng.randrange(len(nodes) + 1) for _ in range(rng.randint(1, 4))]
            case 2 if nodes:
                start, deep = len(nodes), rng.choice([10, 300, 3000, 20_000])
                nodes += [{"children": [start + k + 1]} for k in range(deep - 1)] + [{"mesh": 0}]
                tree["scenes"] = [{"nodes": [start]}]
            case 3:
                _set(tree, "uri", rng.choice(REFERENCES))
            case 4:
                _set(tree, rng.choice(["count", "byteLength", "byteOffset", "byteStride", "bufferView"]), rng.choice(VALUES))
            case _:
                nodes += [{"mesh": 0} for _ in range(rng.choice([10, 1000]))]
                tree["scenes"] = [{"nodes": list(range(len(nodes)))}]
    except (ValueError, AttributeError, TypeError):
        return bytes_changed(data, rng)
    return _joined(json.dumps(tree).encode(), rest)


def _change(tree: Any, rng: random.Random) -> None:
    here = tree
    while isinstance(here, dict | list) and here:
        key: Any = rng.choice(list(here)) if isinstance(here, dict) else rng.randrange(len(here))
        inner = here[key]
        if not isinstance(inner, dict | list) or not inner or rng.random() < 0.15:
            if rng.random() < 0.2:
                del here[key]
            else:
                here[key] = rng.choice(VALUES)
            return
        here = inner


def _set(tree: Any, key: str, value: Any) -> None:
    if isinstance(tree, dict):
        for name in tree:
            if name == key:
                tree[name] = value
            else:
                _set(tree[name], key, value)
    elif isinstance(tree, list):
        for inner in tree:
            _set(inner, key, value)


def _split(data: bytes) -> tuple[bytes, bytes | None]:
    """The JSON, and of a GLB what comes after it."""
    if data[:4] != b"glTF" or len(data) < 20:
        return data, None
    size = struct.unpack_from("<I", data, 12)[0]
    return data[20 : 20 + size], data[20 + size :]


def _joined(text: bytes, rest: bytes | None) -> bytes:
    if rest is None:
        return text
    text += b" " * (-len(text) % 4)
    return struct.pack("<4sIII4s", b"glTF", 2, 20 + len(text) + len(rest), len(text), b"JSON") + text + rest


def xml_changed(data: bytes, rng: random.Random) -> bytes:
    """Entity bombs, references to outside, deep and circular nodes, counts that lie."""
    node = b'<node id="n">'
    match rng.randrange(7):
        case 0:
            lines = "".join(f'<!ENTITY e{k + 1} "{f"&e{k};" * 10}">' for k in range(12))
            return data.replace(b"?>\n", f'?>\n<!DOCTYPE x [<!ENTITY e0 "lol">{lines}]>\n'.encode(), 1).replace(
                b"red", b"&e12;"
            )
        case 1:
            outside = b'?>\n<!DOCTYPE x [<!ENTITY e SYSTEM "file:///etc/passwd">]>\n'
            return data.replace(b"?>\n", outside, 1).replace(b"red", b"&e;")
        case 2:
            deep = rng.choice([50, 500, 3000])
            return data.replace(node, b"<node>" * deep + node).replace(
                b"</visual_scene>", b"</node>" * deep + b"</visual_scene>"
            )
        case 3:
            return data.replace(node, node + b'<instance_node url="#n"/>')
        case 4:
            wide = rng.choice([10, 500])
            return data.replace(b"</node>", b'<instance_geometry url="#g"/>' * wide + b"</node>")
        case 5:
            return re.sub(rb'(count|stride|offset)="\d+"', lambda m: m[1] + b'="' + rng.choice(NUMBERS).encode() + b'"', data)
        case _:
            return re.sub(
                rb"#\w+", lambda m: m[0] if rng.random() < 0.9 else b"#" + rng.choice([b"g", b"v", b"n", b"", b"p"]), data
            )


def mutations(ending: str) -> list[Mutation]:
    """The mutations that suit a format."""
    common: list[Mutation] = [bytes_changed, reference_changed]
    match ending:
        case ".glb":
            return [*common, tree_changed, tree_changed]
        case ".gltf":
            return [*common, tree_changed, tree_changed, number_changed]
        case ".dae":
            return [*common, xml_changed, xml_changed, number_changed, lines_shuffled]
        case _:
            return [*common, number_changed, lines_shuffled]


def seeds() -> dict[str, bytes]:
    """Whole files of every format: the hand-written ones of the tests, textured ones, examples, generated scenes."""
    from mesh_files import all_files, draco, meshopt, naming

    found = (
        all_files()
        | {"draco.glb": draco(), "meshopt.glb": meshopt()}
        | {f"named_{n}": d for n, d in naming("checker.png").items()}
    )
    for path in sorted((ROOT / "examples" / "meshes").glob("*.glb"), key=lambda p: p.stat().st_size)[:4]:
        found[path.name] = path.read_bytes()
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(24):
            path = write_scene(scene(seed), Path(folder, str(seed)))
            if path.stat().st_size < 300_000:
                found[f"scene_{seed}{path.suffix}"] = path.read_bytes()
    return found


class Watch:
    """Notes files that are opened outside a folder, and connections, while it is on; the interpreter calls it."""

    def __init__(self) -> None:
        self.folder: str | None = None
        self.outside: list[str] = []
        homes = [sys.prefix, sys.base_prefix, *sys.path, str(ROOT / "src"), "/dev/null"]
        self._allowed = tuple(os.path.realpath(p) for p in homes if p)
        sys.addaudithook(self._hook)

    def _hook(self, event: str, values: tuple[Any, ...]) -> None:
        if self.folder is None:
            return
        if event.startswith(("socket.connect", "urllib", "socket.getaddrinfo", "subprocess", "os.system", "os.exec")):
            self.outside.append(event)
        if event == "open" and isinstance(values[0], str | bytes):
            place = os.path.realpath(os.fsdecode(values[0]))
            if not place.startswith((self.folder + os.sep, *self._allowed)):
                self.outside.append(place)


_watch: Watch | None = None


def try_inputs(inputs: list[tuple[str, bytes]]) -> list[Result]:
    """Load each (name, content); runs in a child process. A result: outcome, message, seconds, what was opened outside."""
    global _watch
    warnings.simplefilter("ignore")
    _watch = _watch or Watch()
    with tempfile.TemporaryDirectory() as top:
        folder = _around(Path(top))
        return [_tried(folder / name, content, _watch) for name, content in inputs]


def _around(top: Path) -> Path:
    """The folder of an input, with files beside it that it may read, and one above it that it may not."""
    from mesh_files import MTL, plain_gltf
    from PIL import Image

    folder = top / "in"
    folder.mkdir()
    (top / "secret.bin").write_bytes(plain_gltf().bin)
    (folder / "link.bin").symlink_to(top / "secret.bin")
    os.mkfifo(folder / "fifo.bin")  # to read it would wait for ever
    (folder / "box.bin").write_bytes(plain_gltf().bin)
    (folder / "box.mtl").write_bytes(MTL)
    (folder / "other.mtl").write_bytes(b"newmtl red\nmap_Kd ../secret.bin\nmap_Ke checker.png\n")
    Image.new("RGB", (2, 2), "red").save(folder / "checker.png")
    return folder


def _tried(path: Path, content: bytes, watch: Watch) -> Result:
    path.write_bytes(content)
    watch.folder, watch.outside, begin = os.path.realpath(path.parent), [], time.process_time()
    try:
        load_mesh(path)
        outcome, message = "mesh", ""
    except InputError as error:
        message = str(error)
        outcome = "uncaught" if "\n" in message else "refused"  # a message is one line
    except Exception as error:
        outcome, message = "uncaught", f"{type(error).__name__}: {error}"
    finally:
        watch.folder = None
        path.unlink()
    seconds = time.process_time() - begin
    return {"outcome": outcome, "message": message[:200], "outside": watch.outside, "seconds": seconds}


class Fuzzer:
    """Draws inputs and counts their outcomes. keep: a folder for what fails."""

    def __init__(self, seed: int, keep: Path | None = None) -> None:
        self.rng, self.keep = random.Random(seed), keep
        self.pool = list(seeds().items())
        self.counts: Counter[str] = Counter()
        self.failures: list[tuple[str, str]] = []
        self.slowest = 0.0

    def draw(self) -> tuple[str, bytes]:
        """An input: a seed with one to three mutations."""
        name, data = self.rng.choice(self.pool)
        ending = Path(name).suffix
        for _ in range(self.rng.choice([1, 1, 2, 3])):
            data = self.rng.choice(mutations(ending))(data, self.rng)[: 8 << 20]
        return f"x{ending}", data

    def run(self, inputs: int) -> None:
        """Try so many inputs."""
        limits = ChildLimits(seconds=SECONDS * BATCH, memory=MEMORY, wall=SECONDS * BATCH)
        with ChildPool(1, limits) as pool:
            for first in range(0, inputs, BATCH):
                batch = [self.draw() for _ in range(min(BATCH, inputs - first))]
                self._note(batch, self._results(pool, batch))

    def _results(self, pool: ChildPool, batch: list[tuple[str, bytes]]) -> list[Result]:
        """The results of a batch; of one that ends its process, those of each input alone."""
        try:
            return pool.run("benchmarks.fuzz_readers", "try_inputs", {"inputs": batch})
        except ChildError as error:
            if len(batch) == 1:
                return [{"outcome": str(error.failure), "message": str(error), "outside": [], "seconds": 0.0}]
        return [result for one in batch for result in self._results(pool, [one])]

    def _note(self, batch: list[tuple[str, bytes]], results: list[Result]) -> None:
        for (name, data), result in zip(batch, results, strict=True):
            outcome = "outside" if result["outside"] else "over time" if result["seconds"] > SECONDS else result["outcome"]
            self.counts[outcome] += 1
            self.slowest = max(self.slowest, result["seconds"])
            if outcome not in ("mesh", "refused"):
                self.failures.append((name, f"{outcome}: {result['message']} {result['outside'][:3]}"))
                if self.keep is not None:
                    self.keep.mkdir(parents=True, exist_ok=True)
                    (self.keep / f"{outcome.replace(' ', '_')}-{zlib.crc32(data):08x}{Path(name).suffix}").write_bytes(data)


def main() -> None:
    parser = argparse.ArgumentParser(description="Fuzzing of the readers.")
    parser.add_argument("--inputs", type=int, default=20_000)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--keep", type=Path, default=Path("fuzz_failures"), help="folder for inputs that fail")
    how = parser.parse_args()
    fuzzer, begin = Fuzzer(how.seed, how.keep), time.monotonic()
    fuzzer.run(how.inputs)
    print(f"{sum(fuzzer.counts.values())} inputs in {time.monotonic() - begin:.0f} s: {dict(fuzzer.counts)}")
    print(f"slowest {fuzzer.slowest:.1f} s, {len(fuzzer.pool)} seeds, {len(fuzzer.failures)} failures")
    for name, failure in fuzzer.failures[:50]:
        print(f"  {name} {failure}")
    sys.exit(bool(fuzzer.failures))


if __name__ == "__main__":
    main()
