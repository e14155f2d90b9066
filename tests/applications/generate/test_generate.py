"""Test generation end to end: each step runs once even if a run is interrupted, and its record holds no secrets."""

import json
import logging
import shutil
from dataclasses import replace
from functools import partial
from pathlib import Path

import pytest
from generated import BOX, FAST, PROMPT, record
from meshy_wire import KEY, SIGNATURE, cuts, refuses

import anymesh
from anymesh import finish, pipeline
from anymesh.applications.generate import explain_generation, generate
from anymesh.applications.generate import run as run_module
from anymesh.applications.generate.job import choose_size
from anymesh.applications.generate.protocol import Unit
from anymesh.applications.generate.work import STILL, WorkFolder
from anymesh.checking import check_asset
from anymesh.errors import AnymeshError, BudgetError, InputError, ModelError, OptionError, OutputError
from anymesh.finishing.retexture import Remote
from anymesh.pipeline.atomic_folder import locked
from anymesh.pipeline.run_folder import RunFolder
from anymesh.types import JointType

CABINET = BOX.with_name("cabinet_fused.glb")


def files(folder: Path) -> dict[str, bytes]:
    return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()}


def test_words_become_a_finished_asset(server, tmp_path, caplog) -> None:
    """All of it for real, but for the service: paid tasks, download, parts, joints, stage C, files."""
    caplog.set_level(logging.DEBUG)
    out, seen = tmp_path / "cabinet", []
    server.model = CABINET.read_bytes()
    asset = anymesh.generate("a Retro cabinet!", out, progress=lambda *told: seen.append(told))
    assert sorted(j.type for j in asset.joints) == ["prismatic"] * 3 + ["revolute"] * 2
    assert asset.name == "retro_cabinet"
    assert asset.source_face is not None
    assert (asset.source_face < 0).any()  # stage C gave it an inside
    assert check_asset(out).ok
    assert {"retro_cabinet.urdf", "retro_cabinet.xml", "model.sdf", "retro_cabinet.glb"} <= set(files(out))
    found = record(out)
    assert found["request"] == {"prompt": "a Retro cabinet!", "image": None}
    assert found["generator"] == {"name": "meshy", "model": "latest", "faces": 100_000}
    preview, refined = server.tasks
    assert found["tasks"] == [
        {"kind": "text-to-3d-preview", "id": preview, "credits": 20, "seed": 7},
        {"kind": "text-to-3d-refine", "id": refined, "credits": 10, "seed": 7},
    ]
    assert found["credits"] == 30
    assert (out / found["mesh"]["file"]).read_bytes() == server.model
    assert found["mesh"]["sha256"] == json.loads((out / "asset.json").read_text())["source"]["sha256"]
    assert found["versions"] == {"anymesh": anymesh.__version__}
    assert {stage for stage, *_ in seen} >= {"generate", "load", "segment", "joints", "finish", "export"}
    told = [caplog.text, repr(asset), *(content.decode("latin-1") for content in files(tmp_path).values())]
    for secret in (KEY, SIGNATURE, server.url):
        assert not [text for text in told if secret in text]


def test_a_second_call_does_nothing(server, quick, tmp_path) -> None:
    first = generate(PROMPT, tmp_path / "box", **FAST)
    asked, before = list(server.asked), files(tmp_path)
    again = generate(PROMPT, tmp_path / "box", **FAST)
    assert server.asked == asked
    assert len(quick) == 1
    assert files(tmp_path) == before
    assert [j.name for j in again.joints] == [j.name for j in first.joints]
    assert again.warnings == first.warnings


def test_other_options_use_the_mesh_that_is_paid(server, quick, tmp_path) -> None:
    out = tmp_path / "box"
    generate(PROMPT, out, **FAST)
    with pytest.raises(OutputError, match="--force replaces"):
        generate(PROMPT, out, **FAST, seed=1)
    generate(PROMPT, out, **FAST, seed=1, force=True, max_calls=0)
    assert server.count("create") == 2
    shutil.rmtree(WorkFolder.of(out).folder)  # then the output still has it
    generate(PROMPT, out, **FAST, seed=2, force=True, max_calls=0)
    assert server.count("create") == 2
    assert record(out)["credits"] == 30
    assert len(quick) == 3


def test_another_mesh_is_paid_for_where_it_is_asked_for(server, quick, tmp_path) -> None:
    out = tmp_path / "box"
    generate(PROMPT, out, **FAST)
    with pytest.raises(OutputError, match="--force replaces"):
        generate(PROMPT, out, **FAST, regenerate=True)
    generate(PROMPT, out, **FAST, regenerate=True, force=True)
    assert server.count("create") == 4
    assert record(out)["tasks"][0]["id"] == list(server.tasks)[2]


def test_another_mesh_that_was_cut_short_is_gone_on_with(server, quick, tmp_path) -> None:
    out, how = tmp_path / "box", {**FAST, "regenerate": True, "force": True}
    generate(PROMPT, out, **FAST)

    def kills(told: str, item: str, done: int, total: int) -> None:
        if told == "finish":
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        generate(PROMPT, out, **how, progress=kills)
    generate(PROMPT, out, **how)
    assert server.count("create") == 4
    assert record(out)["tasks"][0]["id"] == list(server.tasks)[2]
    generate(PROMPT, out, **how, max_calls=2)
    assert server.count("create") == 6


@pytest.mark.parametrize("stage", ["generate", "finish"])
def test_a_run_that_was_killed_is_gone_on_with(server, quick, tmp_path, stage) -> None:
    server.steps = [{"status": "PENDING"}] if stage == "generate" else []

    def kills(told: str, item: str, done: int, total: int) -> None:
        if told == stage and (stage == "finish" or "pending" in item):
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        generate(PROMPT, tmp_path / "box", **FAST, progress=kills)
    assert not (tmp_path / "box").exists()
    server.steps = []
    generate(PROMPT, tmp_path / "box", **FAST)
    assert server.count("create") == 2
    assert len(quick) == 1
    assert not WorkFolder.of(tmp_path / "box").articulated.exists()


def test_a_picture_is_sent_and_named(server, quick, tmp_path) -> None:
    picture = tmp_path / "My Fridge (2).png"
    picture.write_bytes(b"\x89PNG\r\n\x1a\n picture")
    generate(None, tmp_path / "out", image=picture, generator="meshy:untextured", **FAST)
    [task] = server.tasks.values()
    assert task["sent"] == picture.read_bytes()
    assert task["should_texture"] is False
    found = record(tmp_path / "out")
    assert found["request"]["image"]["name"] == picture.name
    assert found["mesh"]["file"] == "generated/My_Fridge_2.glb"
    assert found["credits"] == 20
    assert quick[0]["category"] == "fridge"
    picture.write_bytes(b"\x89PNG\r\n\x1a\n another")
    generate(None, tmp_path / "out", image=picture, generator="meshy:untextured", **FAST, force=True)
    assert len(server.tasks) == 2


def test_a_program_makes_the_mesh_once(quick, program, tmp_path) -> None:
    name = program(f"--prompt {{prompt}} --out {{out}} --seed {{seed}} --notes {tmp_path}/notes.json")
    generate("a microwave", tmp_path / "out", generator=name, **FAST, seed=4)
    assert record(tmp_path / "out")["generator"]["seed"] == 4
    assert record(tmp_path / "out")["credits"] == 0
    assert quick[0]["scale"] == "0.5:longest"
    (tmp_path / "notes.json").unlink()
    generate("a microwave", tmp_path / "out", generator=name, **FAST, seed=4, force=True)
    assert not (tmp_path / "notes.json").exists()
    generate("a microwave", tmp_path / "out", generator=name, **FAST, seed=5, force=True)
    assert (tmp_path / "notes.json").exists()


def test_a_mesh_file_is_taken_as_it_is(quick, tmp_path) -> None:
    mesh = tmp_path / "box.glb"
    shutil.copyfile(BOX, mesh)
    asset = generate(None, tmp_path / "out", mesh=mesh, **FAST)
    assert quick[0]["mesh"] == mesh
    assert asset.warnings == ()
    found = record(tmp_path / "out")
    assert (found["mesh"]["file"], found["tasks"]) == ("box.glb", [])
    assert not (tmp_path / "out" / "generated").exists()
    assert sorted(p.name for p in tmp_path.iterdir()) == ["box.glb", "out"]
    generate(None, tmp_path / "out", mesh=mesh, **FAST)
    assert len(quick) == 1
    mesh.write_bytes((BOX.parent / "laptop.glb").read_bytes())
    with pytest.raises(OutputError, match="--force replaces"):
        generate(None, tmp_path / "out", mesh=mesh, **FAST)


def test_where_it_came_from_survives_an_export_and_corrections(articulations, program, tmp_path) -> None:
    out = tmp_path / "out"
    generate("a box", out, generator=program("--prompt {prompt} --out {out}"), **FAST)
    before = files(out)
    pipeline.export_asset(out, formats="urdf,mjcf")
    origin = {name for name in before if name.startswith("generat")}
    assert origin == {"generation.json", "generated/box.glb"}
    assert {name: content for name, content in files(out).items() if name in origin} == {n: before[n] for n in origin}
    with RunFolder.revise(out):
        pass
    assert origin <= set(files(out))
    finish(out, tmp_path / "again", **FAST)
    assert origin <= set(files(tmp_path / "again"))


@pytest.mark.parametrize("unit", Unit)
def test_what_is_given_counts(unit) -> None:
    size = choose_size("0.9:z", None, "a retro fridge", "retro_fridge", unit)
    assert (size.scale, size.category, size.warning) == ("0.9:z", "a retro fridge", "")


@pytest.mark.parametrize(("unit", "scale"), [(Unit.ARBITRARY, "1.75:longest"), (Unit.ESTIMATED, "auto"), (Unit.STATED, "auto")])
def test_a_known_kind_has_its_usual_size(unit, scale) -> None:
    size = choose_size("auto", None, "a retro fridge", "retro_fridge", unit)
    assert (size.scale, size.category, size.warning) == (scale, "a retro fridge", "")
    assert "a fridge is about 1.75 m long" in size.reason


def test_the_category_counts_for_more_than_the_prompt_and_that_for_more_than_the_name() -> None:
    assert choose_size("auto", "laptop", "a fridge", "stove", Unit.ARBITRARY).scale == "0.36:longest"
    assert choose_size("auto", None, None, "my_stove_2", Unit.ARBITRARY) == choose_size(
        "auto", "stove", None, "x", Unit.ARBITRARY
    )


def test_a_file_s_unit_counts_for_more_than_its_name() -> None:
    size = choose_size("auto", None, None, "box", Unit.STATED)
    assert (size.scale, size.category, size.warning) == ("auto", None, "")


@pytest.mark.parametrize(("unit", "warned"), [(Unit.ARBITRARY, True), (Unit.STATED, True), (Unit.ESTIMATED, False)])
def test_where_nothing_tells_the_size_a_warning_says_so(unit, warned) -> None:
    size = choose_size("auto", None, "a toy fridge", "toy_fridge", unit)
    assert size.scale == "auto"
    assert ("give --scale METRES:AXIS" in size.warning) is warned


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

    for module, stage in ((pipeline, "articulate"), (run_module, "finish")):
        monkeypatch.setattr(module, stage, still(getattr(module, stage)))
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
        ("create", [refuses(402, "no")], ModelError, "too few credits, a text-to-3D preview takes about 20"),
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
