"""Hostile scenes of benchmarks/fuzz.py: every mesh ends in an asset or in one of our errors."""

import threading
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from anymesh.errors import InputError
from anymesh.geometry.topology import components
from anymesh.loading import load_mesh
from benchmarks import fuzz_pool
from benchmarks.fuzz_arrangements import chandelier
from benchmarks.fuzz_files import write_scene
from benchmarks.fuzz_inputs import scene_cases
from benchmarks.fuzz_report import report
from benchmarks.fuzz_scenes import Scene, fixture, scene

SECONDS = 60.0  # that generated scenes may take
LIMIT = 120.0  # [s] for one of them, on a busy machine
MEMORY = 6 * 1024**3  # [bytes]
BEADS = 60  # of the chandelier here; the benchmark takes 2,000
STAND_IN = """
import json, os, signal, sys, time
for line in sys.stdin:
    what = json.loads(line)["scene"]
    if what == "crash":
        os.kill(os.getpid(), signal.SIGSEGV)
    if what == "hang":
        time.sleep(60)
    if what == "eat":
        eaten = bytearray(2**28)
        time.sleep(60)
    print(json.dumps({"outcome": "asset", "seconds": 0.0}), flush=True)
"""


@pytest.fixture(scope="module")
def worker(tmp_path_factory: pytest.TempPathFactory) -> Iterator[fuzz_pool.Worker]:
    made = fuzz_pool.Worker(tmp_path_factory.mktemp("fuzz"), MEMORY)
    yield made
    made.close()


def run(worker: fuzz_pool.Worker, folder: Path, limit: float = LIMIT, **case: object) -> fuzz_pool.Result:
    found = worker.run({"work": str(folder / "case"), **case}, limit, threading.Event())
    assert found is not None
    return found


def test_scenes_of_fixed_seeds_end_in_an_asset_or_an_error_of_ours(worker: fuzz_pool.Worker, tmp_path: Path) -> None:
    end, tried = time.monotonic() + SECONDS, 0
    for case in scene_cases(first=1, count=60):
        if time.monotonic() > end:
            break
        found = run(worker, tmp_path, **case)
        assert found["outcome"] in ("asset", "error"), f"{case['key']}: {found}"
        assert not found["warnings"], f"{case['key']}: {found['warnings']}"
        assert found.get("same", True), f"{case['key']}: another run writes other bytes"
        tried += 1
    assert tried


SMALL = ["bars through a board", "lamp of thin tubes", "turned legs"]


@pytest.mark.parametrize("name", SMALL)
def test_a_known_class_of_failure_ends_in_an_asset(name: str, worker: fuzz_pool.Worker, tmp_path: Path) -> None:
    found = run(worker, tmp_path, scene=name, parts="nodes", finish=False, limit=60.0)
    assert found["outcome"] == "asset", found


FOUND = {  # seeds and what failed there once
    341: "labels",  # a part that is a point
    343: "labels",  # a part of needles whose area is lost in float32
    430: "nodes",  # a box that is 6e-8 m thick
}


@pytest.mark.parametrize("seed", FOUND)
def test_a_scene_that_failed_once_ends_in_an_asset(seed: int, worker: fuzz_pool.Worker, tmp_path: Path) -> None:
    case = next(c for c in scene_cases(first=seed, count=1) if c["parts"] == FOUND[seed])
    found = run(worker, tmp_path, **case)
    assert found["outcome"] == "asset", found


def test_hundreds_of_small_components_end_in_an_asset(worker: fuzz_pool.Worker, tmp_path: Path) -> None:
    small = Scene("beads", "glb", tuple(chandelier(BEADS)))
    found = run(worker, tmp_path, mesh=str(write_scene(small, tmp_path)), parts="nodes", finish=False)
    assert found["outcome"] == "asset", found


def test_fixtures_have_the_properties_that_they_are_named_for(tmp_path: Path) -> None:
    lamp = load_mesh(write_scene(fixture("lamp of thin tubes"), tmp_path)).mesh
    assert not components(lamp.vertices, lamp.faces).solid.all()
    stool = load_mesh(write_scene(fixture("turned legs"), tmp_path)).mesh
    assert 3000 < len(stool.faces) < 5500
    found = components(stool.vertices, stool.faces)
    assert found.solid[found.label[-1]]  # of a leg: only closed solids are cut exactly
    beads = load_mesh(write_scene(fixture("chandelier"), tmp_path)).mesh
    assert len(beads.faces) > 100_000
    assert components(beads.vertices, beads.faces).count >= 2000
    bars = load_mesh(write_scene(fixture("bars through a board"), tmp_path)).mesh
    sides = np.sort(bars.faces[bars.face_node == [n.name for n in bars.nodes].index("bar_0")], axis=1)
    assert (np.unique(sides, axis=0, return_counts=True)[1] == 2).all()


def test_the_same_seed_makes_the_same_file(tmp_path: Path) -> None:
    for seed in range(40):
        files = [write_scene(scene(seed), tmp_path / place) for place in ("a", "b")]
        assert files[0].read_bytes() == files[1].read_bytes()
    assert write_scene(scene(1), tmp_path).read_bytes() != write_scene(scene(2), tmp_path).read_bytes()


def test_a_scene_is_a_mesh_or_is_refused(tmp_path: Path) -> None:
    formats, refused = set(), 0
    for seed in range(150):
        path = write_scene(scene(seed), tmp_path)
        formats.add(path.suffix)
        try:
            load_mesh(path)
        except InputError:
            refused += 1
    assert formats == {".glb", ".obj", ".ply", ".stl", ".off"}
    assert 0 < refused < 15


def test_a_worker_that_dies_is_recorded_and_replaced(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    script = tmp_path / "worker.py"
    script.write_text(STAND_IN)
    monkeypatch.setattr(fuzz_pool, "WORKER", script)
    monkeypatch.setattr(fuzz_pool, "GRACE", 0.1)
    cases = [{"key": k, "scene": k} for k in ("crash", "fine", "hang", "eat", "fine again")]
    found: dict[str, dict] = {}

    def done(case: dict, result: dict) -> None:
        found[case["key"]] = result

    fuzz_pool.run_all(cases, tmp_path, workers=1, limit=3.0, memory=2**27, done=done)
    told = {key: result["outcome"] for key, result in found.items()}
    assert told == {
        "crash": "crash",
        "fine": "asset",
        "hang": "over time limit",
        "eat": "over memory limit",
        "fine again": "asset",
    }
    assert found["crash"]["kind"] == "SIGSEGV"


def test_the_report_counts_outcomes_and_groups_causes() -> None:
    asset = {"outcome": "asset", "seconds": 1.0, "faces": 12, "contract": [], "same": True, "warnings": []}
    fault = {"outcome": "unexpected", "kind": "ValueError", "where": "a.py:f 3", "message": "", "seconds": 2.0}
    text = report({"scene 1 auto": asset, "scene 2 auto": fault, "scene 3 auto": fault}, "command", 60)
    assert "| generated scenes | 3 | 1 | 0 | 2 | 0 | 0 | 0 |" in text
    assert "| 2 | ValueError in `a.py:f 3` | scene 2 auto, scene 3 auto |" in text
    assert "1 of 1 assets of the sample keep it" in text
