"""`anymesh eval`: every protocol on a small object, what is kept, what is refused, what is a failure."""

import json
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest
from assets import box, cabinet, joint, mesh_of

from anymesh.cli import run
from anymesh.errors import InputError, ModelError, OptionError, OutputError
from anymesh.evaluation import evaluating
from anymesh.evaluation.datasets.dataset import Dataset
from anymesh.evaluation.evaluate_sample import drive, executability
from anymesh.evaluation.evaluating import evaluate
from anymesh.evaluation.ground_truth import EvalSample, GroundTruth, TrueJoint, example_truths
from anymesh.evaluation.score import ObjectScore
from anymesh.types import Part, Segmentation

EXAMPLES = Path(__file__).parents[2] / "examples"
SET = f"examples:{EXAMPLES}"
TRUTHS = {t.name: t for t in example_truths(EXAMPLES)}
CABINET = cabinet()
MESH, LABELS = mesh_of(
    [box((0, 0, -0.2), (2, 0.4, -0.1)), box((0.1, 0, 0), (0.4, 0.4, 0.2)), box((0.7, 0, 0), (0.9, 0.4, 0.2))]
)
POST = joint("stop", "fixed", "base", "post", (0.7, 0, 0), (0, 0, 1), None)
PARTS = tuple(Part(n, n) for n in ("base", "slider", "post"))
SLIDE = joint("slide", "prismatic", "base", "slider", (0.1, 0, 0), (1, 0, 0), (0.0, 0.5))
NOTHING = ObjectScore("block", (), 0, 0, 0)
TRUE = TrueJoint(SLIDE.type, SLIDE.origin, SLIDE.axis, (0.0, 0.25), child="slider", parent="base")


@dataclass(frozen=True)
class Shelf(Dataset):
    """A data set of examples by their names; "broken" cannot be read."""

    names: tuple[str, ...]
    name: str = "shelf"

    def _names(self) -> list[str]:
        return list(self.names)

    def truth(self, name: str, folder: Path) -> GroundTruth:
        if name == "broken":
            raise InputError("broken has no faces")
        return TRUTHS[name]


@pytest.mark.parametrize("protocol", ["parts", "views", "end-to-end", "executability"])
def test_each_protocol_gets_a_box_right(protocol: str, tmp_path: Path) -> None:
    (record,) = evaluate(SET, tmp_path / "out", protocol=protocol, only=["storage_box"], jobs=1)
    (joint,) = record.score.joints
    assert not record.error
    assert joint.type_right
    assert joint.angle is not None
    assert joint.angle < 5
    assert joint.opens_right
    assert record.score.executable is (True if protocol == "executability" else None)
    report = (tmp_path / "out" / "report.md").read_text()
    assert f"| protocol | {protocol} |" in report
    rows = [json.loads(line) for line in (tmp_path / "out" / "joints.jsonl").read_text().splitlines()]
    assert [row["object"] for row in rows] == ["storage_box"]
    assert "<script src" not in (tmp_path / "out" / "report.html").read_text()


def test_a_spun_box_is_stood_up_if_its_up_direction_is_given(tmp_path: Path) -> None:
    (record,) = evaluate(SET, tmp_path, only=["storage_box"], changes=["spun"], up="given", jobs=1)
    (joint,) = record.score.joints
    assert joint.type_right
    assert (joint.angle or 0) < 1
    assert joint.opens_right
    assert "| up | given |" in (tmp_path / "report.md").read_text()
    with pytest.raises(OptionError, match="--up: found 'z'; valid are mesh, given, infer"):
        evaluate(SET, tmp_path / "other", up="z")


def test_a_change_and_an_oracle_have_their_rows(tmp_path: Path) -> None:
    records = evaluate(SET, tmp_path, protocol="parts", only=["valve"], changes=["none", "turned"], answerer="oracle",
                       viewpoints="4@15+30,1@50+30", jobs=1)  # fmt: skip
    assert [r.change for r in records] == ["none", "turned"]
    assert all(j.type_right and (j.angle or 0) < 1 for r in records for j in r.score.joints)


def test_it_goes_on_where_it_was_stopped_and_tries_failures_again(tmp_path: Path, monkeypatch) -> None:
    names = ["valve", "broken"]
    monkeypatch.setattr(evaluating, "open_dataset", lambda spec: Shelf(tuple(names)))
    asked: list[str] = []
    truth = Shelf.truth
    monkeypatch.setattr(Shelf, "truth", lambda self, name, folder: (asked.append(name), truth(self, name, folder))[1])
    first = evaluate("shelf", tmp_path, jobs=1)
    assert [r.error for r in first] == ["", "broken has no faces"]
    assert evaluate("shelf", tmp_path, jobs=1) == first
    assert asked == ["valve", "broken", "broken"]


def test_a_crash_is_this_objects_failure_and_a_silent_model_ends_it_all(tmp_path: Path, monkeypatch) -> None:
    def crash(*_: object, **__: object) -> None:
        raise ZeroDivisionError("by chance")

    monkeypatch.setattr(evaluating, "solve", crash)
    (record,) = evaluate(SET, tmp_path / "a", only=["valve"], jobs=1)
    assert "ZeroDivisionError" in record.error
    assert [j.type_found for j in record.score.joints] == [None]  # it counts as missing

    def silent(*_: object, **__: object) -> None:
        raise ModelError("no answer")

    monkeypatch.setattr(evaluating, "solve", silent)
    with pytest.raises(ModelError, match="no answer"):
        evaluate(SET, tmp_path / "b", only=["valve"], jobs=1)


@pytest.mark.slow
def test_processes_and_this_one_find_the_same(tmp_path: Path) -> None:
    def found(jobs: int) -> list[object]:
        records = evaluate(SET, tmp_path / str(jobs), only=["valve", "laptop"], jobs=jobs)
        return [r.score for r in records]

    assert found(1) == found(2)


@pytest.mark.parametrize(
    ("options", "told"),
    [
        ({"protocol": "guess"}, "valid are parts, views"),
        ({"changes": ["melted"]}, "valid are none, turned"),
        ({"changes": []}, "valid are none"),
        ({"only": ["sofa"]}, "found sofa"),
        ({"split": "ID"}, "split"),
        ({"views": 0}, "--views must be 1 or more"),
        ({"answerer": "oracle:2"}, "from 0 to 1"),
        ({"answerer": "oracle:x"}, "from 0 to 1"),
    ],
)
def test_what_is_not_valid_is_told_before_anything_is_written(options, told: str, tmp_path: Path) -> None:
    with pytest.raises(OptionError, match=told):
        evaluate(SET, tmp_path / "out", **options)
    assert not (tmp_path / "out").exists()


def test_other_settings_and_other_folders_are_refused(tmp_path: Path) -> None:
    evaluate(SET, tmp_path / "out", only=["table"], jobs=1)
    with pytest.raises(OutputError, match=r"seed: 0 \(now 1\)"):
        evaluate(SET, tmp_path / "out", only=["table"], seed=1, jobs=1)
    evaluate(SET, tmp_path / "out", only=["table"], seed=1, force=True, jobs=1)
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "thesis.txt").write_text("x")
    with pytest.raises(OutputError, match="not an evaluation of anymesh"):
        evaluate(SET, tmp_path / "mine", only=["table"], force=True)
    assert (tmp_path / "mine" / "thesis.txt").read_text() == "x"


def test_the_command_line_tells_figures_or_json(tmp_path: Path, capsys) -> None:
    assert run(["eval", SET, "-o", str(tmp_path / "out"), "--only", "valve", "--jobs", "1", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["results"]["none"]["type_right"] == 1
    assert run(["eval", SET, "-o", str(tmp_path / "out"), "--only", "valve", "--jobs", "1"]) == 0
    assert "report.html" in capsys.readouterr().out
    assert run(["eval", "toys", "-o", str(tmp_path / "x")]) == 2
    assert "valid are examples" in capsys.readouterr().err


def test_the_command_line_names_objects_that_failed(tmp_path: Path, capsys, monkeypatch) -> None:
    names = tuple(f"broken{'?' * k}" for k in range(7))
    monkeypatch.setattr(Shelf, "truth", lambda self, name, folder: (_ for _ in ()).throw(InputError(f"{name} has no faces")))
    monkeypatch.setattr(evaluating, "open_dataset", lambda spec: Shelf(names))
    assert run(["eval", "shelf", "-o", str(tmp_path / "out"), "--jobs", "1"]) == 0
    told = capsys.readouterr().out
    assert "warning: broken???: broken??? has no faces\n" in told
    assert "warning: 2 more objects failed; the report lists all of them\n" in told
    assert run(["eval", "shelf", "-o", str(tmp_path / "out"), "--jobs", "1", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["errors"] == {name: f"{name} has no faces" for name in names}


pytest.importorskip("mujoco")


def sample(*joints: TrueJoint) -> EvalSample:
    return EvalSample(GroundTruth("block", Path("x"), PARTS, LABELS, joints), MESH, LABELS, np.eye(4))


def test_a_good_asset_has_no_faults() -> None:
    assert drive(CABINET.mesh, CABINET.segmentation, CABINET.joints) == ()


def test_a_joint_that_runs_into_another_part_is_told_by_name() -> None:
    found = executability(sample(TRUE), Segmentation(LABELS, PARTS), (SLIDE, POST), NOTHING)
    assert found.executable is False
    assert any(f.startswith("slide: ") and "'post'" in f for f in found.faults)
    free = replace(SLIDE, limits=(0.0, 0.25))
    found = executability(sample(TRUE), Segmentation(LABELS, PARTS), (free, POST), NOTHING)
    assert (found.executable, found.faults) == (True, ())


def test_nothing_that_moves_is_executable_only_where_nothing_should() -> None:
    whole, rigid = Segmentation(np.zeros_like(LABELS), PARTS[:1]), Segmentation(LABELS, PARTS)
    fixed = replace(POST, name="also", child="slider")
    for segmentation, joints in ((whole, ()), (rigid, (POST, fixed))):
        missing = executability(sample(TRUE), segmentation, joints, NOTHING)
        assert missing.executable is False
        assert len(missing.faults) == 1
        assert executability(sample(), segmentation, joints, NOTHING).executable is True


def test_the_rest_of_the_score_is_kept() -> None:
    given = ObjectScore("x", (), 3, 2, 1)
    assert (
        replace(executability(sample(), Segmentation(LABELS, PARTS), (POST, SLIDE), given), executable=None, faults=()) == given
    )
