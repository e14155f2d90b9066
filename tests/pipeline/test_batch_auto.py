"""Test that a batch resolves `auto` to the answerer that its assets name."""

import hashlib
import json
from pathlib import Path
from typing import Any

from anymesh.pipeline import batch
from anymesh.prompted.answerers import answering

MESH = Path(__file__).parents[2] / "examples" / "meshes" / "microwave.glb"


def test_a_second_run_with_auto_keeps_what_the_first_one_wrote(monkeypatch, tmp_path: Path) -> None:
    made: list[str] = []

    def articulate(path: Path, target: Path, *, answerer: str, **options: Any) -> None:
        made.append(answerer)
        target.mkdir()
        record = {"answerer": answerer, "source": {"sha256": hashlib.sha256(path.read_bytes()).hexdigest()}}
        (target / "asset.json").write_text(json.dumps(record))

    monkeypatch.setattr(batch.pipeline, "articulate", articulate)
    monkeypatch.setattr(answering, "probe_servers", list)  # no local model responds
    for _ in range(2):
        (outcome,) = batch.articulate_many([MESH], tmp_path, answerer="auto")
        assert outcome.state == "done"
    assert made == ["geometry"]
