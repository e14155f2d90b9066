"""Test the warnings and refusals of generation, and its dry run."""

from dataclasses import replace
from functools import partial

import pytest
from generated import BOX, FAST, PROMPT, record
from meshy_wire import KEY, cuts, refuses

from anymesh import pipeline
from anymesh.applications.generate import explain_generation, generate
from anymesh.applications.generate.work import STILL, WorkFolder
from anymesh.errors import AnymeshError, BudgetError, InputError, ModelError, OptionError, OutputError
from anymesh.finishing.retexture import Remote
from anymesh.pipeline.atomic_folder import locked
from anymesh.types import JointType


def test_a_warning_tells_that_nothing_tells_the_size(program, tmp_path, quick) -> None:
    asset = generate("a contraption", tmp_path / "out", generator=program("--prompt {prompt} --out {out}"), **FAST)
    assert any("the size of the object is not known" in w for w in asset.warnings)
    assert record(tmp_path / "out")["warnings"] == [w for w in asset.warnings if "the size of the object" in w]
    assert STILL not in asset.warnings


def test_a_warning_tells_that_nothing_moves(program, tmp_path, quick, monkeypatch) -> None:
    def still(call):
        def stilled(*places: object, **options: object):
            asset = call(*places, **options)
            return replace(asset, joints=tuple(replace(j, type=JointType.FIXED, limits=None) for j in asset.joints))

        return stilled

    for stage in ("articulate", "finish"):
        monkeypatch.setattr(pipeline, stage, still(getattr(pipeline, stage)))
    asset = generate("a box", tmp_path / "out", generator=program("--prompt {prompt} --out {out}"), **FAST)
    assert asset.warnings[0] == STILL
    assert record(tmp_path / "out")["warnings"] == [STILL]


def test_looks_by_meshy_are_counted_in_and_limited(server, articulations, tmp_path, monkeypatch) -> None:
    monkeypatch.setattr("anymesh.finishing.finishing.Remote", partial(Remote, size=128, padding=1))
    with pytest.raises(BudgetError, match="would exceed --max-calls 0"):
        generate(PROMPT, tmp_path / "box", **FAST, texture="meshy:oak", max_calls=2)
    assert len(server.tasks) == 2
    generate(PROMPT, tmp_path / "box", **FAST, texture="meshy:oak", max_calls=1)
    assert [task["type"] for task in server.tasks.values()] == ["text-to-3d-preview", "text-to-3d-refine", "retexture"]
    found = record(tmp_path / "box")
    assert [task["kind"] for task in found["tasks"]] == ["text-to-3d-preview", "text-to-3d-refine", "retexture"]
    assert found["credits"] == 40
    assert found["options"]["texture"] == "meshy:oak"
    assert len(articulations) == 1


@pytest.mark.parametrize(
    ("what", "faults", "error", "told"),
    [
        ("create", [refuses(401, "no")], ModelError, "the key in MESHY_API_KEY is missing or refused"),
        ("create", [refuses(402, "no")], ModelError, "too few credits, a text-to-3D preview takes about 20"),
        ("create", [refuses(429, "wait", retry_after="3600")], ModelError, "asks to wait 3600 s"),
        ("look", [refuses(400, "oops")], ModelError, "HTTP 400, it says: oops"),
    ],
)
def test_a_service_that_refuses_leaves_nothing(server, quick, tmp_path, what, faults, error, told) -> None:
    server.fails(what, *faults)
    with pytest.raises(error, match=told):
        generate(PROMPT, tmp_path / "box", **FAST)
    assert not (tmp_path / "box").exists()
    assert quick == []


def test_a_result_that_is_no_mesh_is_fetched_again_unpaid(server, quick, tmp_path) -> None:
    good = server.model
    server.model = b"glTF" + (2).to_bytes(4, "little") + (20).to_bytes(4, "little") + b"12345678"
    with pytest.raises(ModelError, match=r"meshy's result is not a usable mesh: .*; a rerun downloads it again at no cost"):
        generate(PROMPT, tmp_path / "box", **FAST)
    server.model = good
    server.fails("file", cuts)
    generate(PROMPT, tmp_path / "box", **FAST, max_calls=0)
    assert server.count("create") == 2


def test_what_is_wrong_is_told_before_anything_is_paid(server, tmp_path, monkeypatch) -> None:
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "mine.txt").write_text("")
    wrong: list[tuple[dict, type[AnymeshError], str]] = [
        ({"out": tmp_path / "full"}, OutputError, "is not empty"),
        ({"scale": "big"}, OptionError, "--scale: found 'big'"),
        ({"up": "w"}, OptionError, "--up: found 'w'"),
        ({"formats": "stl"}, OptionError, "'stl'"),
        ({"base": "loose"}, OptionError, "--base"),
        ({"texture": "paint"}, OptionError, "--texture"),
        ({"completer": "magic"}, OptionError, "--completer"),
        ({"answerer": "magic:x"}, OptionError, "--answerer"),
        ({"time_limit": -1.0}, OptionError, "--time-limit"),
        ({"max_calls": -1}, OptionError, "--max-calls must be 0 or more"),
        ({"max_calls": 1}, BudgetError, "take about 30 credits and would exceed --max-calls 1"),
        ({"prompt": " "}, OptionError, "empty prompt"),
        ({"prompt": "x" * 801}, OptionError, "1 to 800 characters"),
        ({"prompt": None}, OptionError, "neither a prompt nor --image nor --mesh"),
        ({"prompt": None, "image": tmp_path / "no.png"}, InputError, "found no picture"),
        ({"prompt": None, "mesh": tmp_path / "no.glb"}, InputError, "found no file"),
        ({"mesh": BOX, "image": BOX}, OptionError, "valid is one of them"),
        ({"root": tmp_path}, OptionError, "found no --mesh"),
        ({"colour": "red"}, OptionError, r"found the options \['colour'\]"),
    ]
    for options, error, told in wrong:
        with pytest.raises(error, match=told):
            generate(**{"prompt": PROMPT, "out": tmp_path / "box", **options})
    monkeypatch.delenv("MESHY_API_KEY")
    with pytest.raises(ModelError, match="no key for meshy"):
        generate(PROMPT, tmp_path / "box")
    assert server.tasks == {}
    assert not (tmp_path / "box").exists()


def test_two_runs_do_not_work_on_one_output(server, quick, tmp_path) -> None:
    folder = WorkFolder.of(tmp_path / "box").folder
    folder.mkdir()
    with locked(folder) as free:
        assert free
        with pytest.raises(OutputError, match="another run works in"):
            generate(PROMPT, tmp_path / "box", **FAST)
    assert server.asked == []


def test_a_dry_run_tells_each_step_and_touches_nothing(tmp_path, monkeypatch, server, quick) -> None:
    monkeypatch.delenv("MESHY_API_KEY")
    found = explain_generation(PROMPT, tmp_path / "box", texture="meshy")
    assert [step.credits for step in found.steps] == [20, 10, 0, 0, 0, 10, 0]
    assert found.credits == 40
    assert "2026-10-05" in found.steps[0].source
    assert found.size == "as the generator estimates it, where that suits the kind (a box is about 0.4 m long)"
    assert list(tmp_path.iterdir()) == []
    with pytest.raises(OptionError, match="1 to 800"):
        explain_generation("x" * 801, tmp_path / "box")
    monkeypatch.setenv("MESHY_API_KEY", KEY)
    generate(PROMPT, tmp_path / "box", **FAST)
    asked = list(server.asked)
    [done] = explain_generation(PROMPT, tmp_path / "box", **FAST).steps
    assert done.what == "return box as it is: it was finished by the same call"
    held = explain_generation(PROMPT, tmp_path / "box", **FAST, seed=3)
    assert "would stop immediately" in held.warnings[0]
    assert explain_generation(PROMPT, tmp_path / "box", **FAST, seed=3, force=True, regenerate=True).credits == 30
    assert held.steps[0].what.startswith("use the mesh that an earlier run made")
    assert held.credits == 0
    assert server.asked == asked
