"""Test the pipeline as a function: its outputs, its reproducibility, and its unchanged input."""

import json
from dataclasses import fields
from pathlib import Path

import numpy as np
import pytest
from assets import CABINET, mesh_of

import anymesh
from anymesh.config import Config
from anymesh.errors import OptionError
from anymesh.evaluation.ground_truth import example_truths, prepared
from anymesh.pipeline import answering
from anymesh.pipeline.solving import Solver
from anymesh.types import Mesh

EXAMPLE = Path(__file__).parents[2] / "examples" / "meshes" / "tilted_drawer.glb"


def arrays(mesh: Mesh) -> dict[str, np.ndarray]:
    found = {f.name: getattr(mesh, f.name) for f in fields(mesh)}
    return {name: value.copy() for name, value in found.items() if isinstance(value, np.ndarray)}


def test_what_is_returned_is_what_is_written_and_the_file_stays_as_it_is(tmp_path) -> None:
    before = EXAMPLE.read_bytes(), EXAMPLE.stat().st_mtime_ns
    asset = anymesh.articulate(EXAMPLE, tmp_path / "out")
    assert (EXAMPLE.read_bytes(), EXAMPLE.stat().st_mtime_ns) == before
    record = json.loads((tmp_path / "out" / "asset.json").read_text())
    (joint,), (written,) = asset.joints, record["joints"]
    assert (joint.name, joint.type, joint.parent) == (written["name"], written["type"], written["parent"])
    assert joint.axis.tolist() == pytest.approx(written["axis"], abs=1e-9)
    assert [p["face_count"] for p in record["parts"]] == np.bincount(asset.segmentation.face_part).tolist()


def test_results_of_another_classifier_are_not_used_again(tmp_path, monkeypatch) -> None:
    digest = "0" * 64

    def computed() -> bool:
        """Return whether the second run computes the parts, with the shipped classifiers replaced by those of a digest."""
        steps: list[str] = []
        monkeypatch.setattr(answering, "_digest_of_classifiers", lambda: digest)
        anymesh.segment(EXAMPLE, tmp_path / "out", force=True, progress=lambda stage, step, *_: steps.append(step))
        return "contacts" in steps

    assert [computed(), computed()] == [True, False]
    digest = "1" * 64
    assert computed()
    monkeypatch.undo()
    assert len(answering._digest_of_classifiers()) == 64


def test_another_seed_finds_the_same_motion() -> None:
    subject = prepared(next(t for t in example_truths(EXAMPLE.parents[1]) if t.name == "storage_box"))
    one, other = (Solver(subject.mesh, Config(seed=s)).joints(subject.segmentation()).joints for s in (0, 1))
    for a, b in zip(one, other, strict=True):
        assert (a.type, a.parent, a.child) == (b.type, b.parent, b.child)
        assert abs(a.axis @ b.axis) > 0.999


def test_the_mesh_handed_in_is_not_changed() -> None:
    mesh, _ = mesh_of([piece for pieces in CABINET.values() for piece in pieces])
    before = arrays(mesh)
    parts = Solver(mesh).parts().segmentation
    labels = parts.face_part.copy()
    Solver(mesh).joints(parts)
    assert (parts.face_part == labels).all()
    after = arrays(mesh)
    assert before.keys() == after.keys()
    assert all(np.array_equal(before[name], after[name]) for name in before)


@pytest.mark.parametrize("call", [anymesh.articulate, anymesh.segment])
def test_a_negative_seed_is_refused_before_anything_is_read(call, tmp_path) -> None:
    with pytest.raises(OptionError, match=r"--seed: found -1; valid are integers from 0 up"):
        call(tmp_path / "none.glb", tmp_path / "out", seed=-1)
    with pytest.raises(OptionError, match="--seed"):
        anymesh.joints(tmp_path / "out", seed=-1)
    assert not list(tmp_path.iterdir())


def test_an_unknown_answerer_is_refused_before_anything_is_read(tmp_path) -> None:
    with pytest.raises(OptionError, match=r"found 'gpt'.*geometry"):
        anymesh.articulate(tmp_path / "none.glb", tmp_path / "out", answerer="gpt")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("options", "word"), [({"max_call": 3}, "max_call"), ({"answerer": "geometry", "parts_list": "door"}, "--parts-list")]
)
def test_options_that_are_not_valid_are_refused_before_anything_is_read(options, word: str, tmp_path) -> None:
    with pytest.raises(OptionError, match=word):
        anymesh.articulate(tmp_path / "none.glb", tmp_path / "out", **options)
    assert not list(tmp_path.iterdir())
