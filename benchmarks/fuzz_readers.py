"""Fuzzing of the readers: mutated real files, guided by coverage, in a child process with limits.

python -m benchmarks.fuzz_readers [--inputs 20000] [--seed 0] [--keep FOLDER]

Every input must end in a mesh or an InputError, within limits on memory and time, and nothing outside its folder may be opened
and no connection made (watched by the interpreter's audit hooks). What fails is kept in FOLDER. Inputs that reach lines of the
readers that none before reached become seeds of their own.
"""

from __future__ import annotations

import argparse
import os
import random
import sys
import tempfile
import time
import warnings
import zlib
from collections import Counter
from pathlib import Path
from types import FrameType
from typing import Any

ROOT = Path(__file__).parents[1]
sys.path[:0] = [str(ROOT / "tests" / "loading"), str(ROOT / "tests")]

from anymesh.isolation import ChildError, ChildLimits, ChildPool  # noqa: E402
from benchmarks.fuzz_mutations import mutations  # noqa: E402

MEMORY = 3 << 30  # [bytes] of address space for one input
SECONDS = 20.0  # for one input [s]
BATCH = 50
POOL = 400  # seeds that are kept
TRACED = 5  # of so many inputs one is traced, which takes ten times as long
Result = dict[str, Any]


def seeds() -> dict[str, bytes]:
    """Whole files of every format: the hand-written ones of the tests, textured ones, examples, generated scenes."""
    from mesh_files import all_files
    from naming_files import naming

    from benchmarks.fuzz_files import write_scene
    from benchmarks.fuzz_scenes import scene

    found = dict(all_files()) | {f"named_{n}": d for n, d in naming("checker.png").items()}
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
_lines: set[tuple[str, int]] = set()


def try_inputs(inputs: list[tuple[str, bytes]], every: int = TRACED) -> list[Result]:
    """Load each (name, content); runs in a child process. A result: outcome, message, what was opened outside, new lines.

    every: of so many inputs one is traced; 0: none.
    """
    global _watch
    import anymesh.loading.load as load

    warnings.simplefilter("ignore")
    _watch = _watch or Watch()
    with tempfile.TemporaryDirectory() as top:
        folder = _around(Path(top))
        return [_tried(load, folder / n, c, _watch, every > 0 and k % every == 0) for k, (n, c) in enumerate(inputs)]


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


def _tried(load: Any, path: Path, content: bytes, watch: Watch, traced: bool) -> Result:
    from anymesh.errors import InputError

    path.write_bytes(content)
    reached: set[tuple[str, int]] = set()
    home = str(Path(load.__file__).parent)

    def trace(frame: FrameType, event: str, _: Any) -> Any:
        if not frame.f_code.co_filename.startswith(home):
            return None
        reached.add((frame.f_code.co_filename, frame.f_lineno))
        return trace

    watch.folder, watch.outside, begin = os.path.realpath(path.parent), [], time.perf_counter()
    sys.settrace(trace if traced else None)
    try:
        load.load_mesh(path)
        outcome, message = "mesh", ""
    except InputError as error:
        outcome, message = "refused", str(error)
    except Exception as error:
        outcome, message = "uncaught", f"{type(error).__name__}: {error}"
    finally:
        sys.settrace(None)
        watch.folder = None
        path.unlink()
    new = reached - _lines
    _lines.update(new)
    if "\n" in message and outcome == "refused":
        outcome = "uncaught"  # a message is one line
    seconds = time.perf_counter() - begin
    return {"outcome": outcome, "message": message[:200], "outside": watch.outside, "new": len(new), "seconds": seconds}


class Fuzzer:
    """Draws inputs from a pool that grows. keep: a folder for what fails."""

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
                return [{"outcome": str(error.failure), "message": str(error), "outside": [], "new": 0, "seconds": 0.0}]
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
            elif result["new"] and len(self.pool) < POOL:
                self.pool.append((name, data))


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
