"""From a mesh to an asset with a model behind a real HTTP server: calls, cache, budget, replay, bad answers, secrets."""

import json
from collections.abc import Iterator
from pathlib import Path

import jsonschema
import pytest
from dialects import _openai, _openai_content
from made import smaller
from model_wire import SECRET, Service

from anymesh.cli import run
from anymesh.config import Config
from anymesh.evaluation.ground_truth import GroundTruth, example_truths, prepared
from anymesh.evaluation.oracle import SimulatedVlm, oracle
from anymesh.export.asset_json import schema
from anymesh.loading import load_mesh, place_mesh
from anymesh.pipeline.solving import Solver
from anymesh.prompted.models.reliability import keep_probe
from anymesh.prompted.stages import _other_category

EXAMPLES = Path(__file__).parents[2] / "examples"
NAME = "storage_box"
Said = dict[str, tuple[str, str]]  # question -> its kind and the answer


@pytest.fixture(autouse=True, scope="module")
def quick() -> Iterator[None]:
    with smaller(240, 8_000):
        yield


def perfect(truth: GroundTruth) -> Said:
    """What a perfect model says to each question about an object."""
    placed = place_mesh(load_mesh(truth.mesh))
    solver = Solver(placed.mesh, Config(), lambda instead: SimulatedVlm(oracle(prepared(truth)), instead))
    recognized = solver.answers.recognize()
    segmented = solver.parts("auto", recognized.recognition)
    jointed = solver.joints(segmented.segmentation, recognized.recognition, grounded=True)
    exchanges = (*recognized.exchanges, *segmented.exchanges, *jointed.exchanges)
    return {e.text: (e.kind, e.answer) for e in exchanges}


@pytest.fixture(scope="module")
def said(quick: None) -> Said:
    return perfect(next(t for t in example_truths(EXAMPLES) if t.name == NAME))


class Model:
    """A model behind a server: says what it is told to say, and counts what it was asked."""

    def __init__(self, said: Said) -> None:
        self.said, self.asked, self.instead = said, [], {}
        self.service = Service()

    def answer(self, handler) -> None:
        texts = [c for c in _openai_content(self.service.seen[-1]) if isinstance(c, str)]
        text = next(t for t in texts if any(t.startswith(known) for known in self.said))
        kind, right = next(found for known, found in self.said.items() if text.startswith(known))
        self.asked.append((kind, text))
        body = json.dumps(_openai(self.instead.get(kind, right), "stop")).encode()
        handler.send_response(200)
        handler.send_header("content-type", "application/json")
        handler.send_header("content-length", str(len(body)))
        handler.end_headers()
        handler.wfile.write(body)
        self.service.turns.append(self.answer)


@pytest.fixture
def model(said: Said, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Iterator[Model]:
    monkeypatch.setenv("ANYMESH_API_KEY", SECRET)
    monkeypatch.setenv("ANYMESH_CACHE", str(tmp_path / "cache"))
    monkeypatch.chdir(tmp_path)
    found = Model(said)
    found.service.turns.append(found.answer)
    server = found.service.start()
    yield found
    server.shutdown()
    server.server_close()


def articulate(model: Model, out: str, *more: str) -> int:
    name = f"openai-compatible:{model.service.url}/v1#m"
    return run(["articulate", str(EXAMPLES / "meshes" / f"{NAME}.glb"), "-o", out, "--answerer", name, "-q", *more])


def record(out: str) -> dict:
    found = json.loads(Path(out, "asset.json").read_text())
    jsonschema.validate(found, schema())
    return found


def test_a_model_makes_the_asset_in_few_calls_that_are_counted_and_kept(model: Model, capfd, caplog) -> None:
    with caplog.at_level(0):
        assert articulate(model, "out") == 0
    found = record("out")
    (joint,) = found["joints"]
    assert (joint["type"], joint["child"]) == ("revolute", "lid")
    assert found["answerer"] == f"openai-compatible:{model.service.url}/v1#m"
    assert found["usage"]["calls"] == len(model.asked) == len(model.said) <= 8
    assert found["usage"]["input_tokens"] == 700 * len(model.asked)
    assert found["warnings"] == []
    kept = sorted(p.name for p in Path("out/transcript").glob("*.json"))
    assert [name.split("_")[1] for name in kept] == [f"{kind}.json" for kind, _ in model.asked]
    assert Path("out/transcript/index.html").stat().st_size > 2000
    shown = capfd.readouterr()
    assert SECRET not in shown.out + shown.err + caplog.text
    files = [p for p in Path().rglob("*") if p.is_file()]
    assert any("cache" in p.parts for p in files)
    assert not [p for p in files if SECRET.encode() in p.read_bytes()]


@pytest.mark.slow
def test_a_second_run_asks_nothing_and_a_recording_needs_no_server(model: Model) -> None:
    assert articulate(model, "out") == 0
    first, calls = record("out"), len(model.asked)
    assert articulate(model, "again") == 0
    assert len(model.asked) == calls
    again = record("again")
    assert again["usage"]["cached_calls"] == again["usage"]["calls"] == calls
    mesh = str(EXAMPLES / "meshes" / f"{NAME}.glb")
    assert run(["articulate", mesh, "-o", "replayed", "--answerer", "replay:out/transcript", "-q"]) == 0
    assert len(model.asked) == calls
    assert again["joints"] == record("replayed")["joints"] == first["joints"]


def test_a_budget_stops_before_the_next_call_and_the_next_run_goes_on(model: Model, capfd) -> None:
    assert articulate(model, "out", "--max-calls", "1") == 7
    assert len(model.asked) == 1
    told = capfd.readouterr().err
    assert "--max-calls" in told
    assert "out.transcript/index.html" in told
    assert [p.name for p in sorted(Path("out.transcript").glob("*.json"))] == ["001_recognize.json"]
    assert not Path("out").exists()
    assert articulate(model, "out") == 0
    assert not Path("out.transcript").exists()
    assert len(model.asked) == len(model.said)


@pytest.mark.slow
def test_a_kept_probe_of_the_model_lowers_the_written_confidence_and_is_told(model: Model) -> None:
    assert articulate(model, "out") == 0
    name = f"openai-compatible:{model.service.url}/v1#m"
    keep_probe(name, "many", [("recognize", 0, 3, 0.0), ("marks", 2, 7, 0.0), ("motions", 0, 4, 0.1), ("kinds", 1, 4, 0.25)])
    assert articulate(model, "again") == 0
    before, now = record("out"), record("again")
    for kind in ("parts", "joints"):
        assert now[kind][-1]["confidence"] < before[kind][-1]["confidence"]
    assert "2 of 7 marks right" in now["parts"][-1]["reason"]
    assert "0 of 4 motions" in now["joints"][-1]["reason"]


@pytest.mark.slow
def test_stages_one_by_one_ask_what_the_whole_job_asks(model: Model) -> None:
    assert articulate(model, "whole", "--cache", "off") == 0
    name = f"openai-compatible:{model.service.url}/v1#m"
    mesh = str(EXAMPLES / "meshes" / f"{NAME}.glb")
    assert run(["segment", mesh, "-o", "steps", "--answerer", name, "--cache", "off", "-q"]) == 0
    assert run(["joints", "steps", "--answerer", name, "--cache", "off", "-q"]) == 0
    assert run(["export", "steps", "-q"]) == 0
    assert len(model.asked) == 2 * len(model.said)
    assert record("steps")["joints"] == record("whole")["joints"]


@pytest.mark.parametrize(
    ("kind", "bad"),
    [
        pytest.param("recognize", "I cannot help with that.", marks=pytest.mark.slow),
        ("marks", '{"parts": [{"label": "lid", "instance": 1, "marks": [9999]}]}'),  # as a texture told it to
        pytest.param("motions", 'Here it is: {"parts": []}', marks=pytest.mark.slow),
    ],
)
def test_what_a_model_cannot_answer_geometry_answers_and_the_asset_says_so(model: Model, kind: str, bad: str) -> None:
    model.instead[kind] = bad
    assert articulate(model, "out", "--cache", "off") == 0
    found = record("out")
    assert [k for k, _ in model.asked].count(kind) == 2
    first, second = (text for k, text in model.asked if k == kind)
    assert second.startswith(first)
    assert "not valid" in second
    assert any(repr(kind) in w and "geometry answered" in w for w in found["warnings"])
    assert [j["type"] for j in found["joints"]] == ["revolute"]


@pytest.mark.slow
def test_what_geometry_answered_is_asked_again_when_the_model_has_recovered(model: Model) -> None:
    right = dict(model.said.values())
    model.instead["kinds"] = "no"
    assert articulate(model, "out", "--cache", "off") == 0
    assert any("geometry answered" in w for w in record("out")["warnings"])
    before = [kind for kind, _ in model.asked]
    model.instead["kinds"] = right["kinds"]
    assert articulate(model, "out", "--cache", "off", "--force") == 0
    assert record("out")["warnings"] == []
    assert [kind for kind, _ in model.asked][len(before) :] == ["kinds", "points", "motions"]  # stage A stands


@pytest.mark.slow
def test_a_model_that_answers_nonsense_is_given_up_for_the_rest_of_the_run(model: Model) -> None:
    model.instead.update(dict.fromkeys(dict(model.said.values()), "la la la"))
    assert articulate(model, "out", "--cache", "off") == 0
    assert len(model.asked) == 3
    found = record("out")
    assert [w for w in found["warnings"] if "given up" in w and "3 invalid answers in a row" in w] == [
        w for w in found["warnings"] if "given up" in w
    ]
    assert sum("given up" in w for w in found["warnings"]) == 1
    assert found["usage"]["calls"] == 3
    assert len(list(Path("out/transcript").glob("*.json"))) == 3
    assert "not asked" in Path("out/transcript/index.html").read_text()


def test_weights_that_cannot_be_had_are_missed_before_anything_is_asked(model: Model, capfd) -> None:
    assert articulate(model, "out", "--proposer", "sam:nowhere") == 2
    assert "--proposer sam: found 'nowhere'" in capfd.readouterr().err
    assert articulate(model, "out", "--proposer", "foo") == 2
    assert articulate(model, "out", "--views", "8@100") == 2
    assert "--viewpoints: found '8@100'" in capfd.readouterr().err
    assert model.asked == []
    assert not Path("out").exists()


def test_a_fault_leaves_what_was_asked_until_then(model: Model, capfd) -> None:
    first, answer = model.service.turns[0], model.answer

    def fails(handler) -> None:
        if len(model.asked) == 1:
            model.service.turns[:] = [(404, {}, b"{}")] * 9
            handler.send_response(404)
            handler.send_header("content-length", "0")
            handler.end_headers()
        else:
            answer(handler)
            model.service.turns[:] = [fails]

    assert first == answer
    model.service.turns[:] = [fails]
    assert articulate(model, "out") == 6
    told = capfd.readouterr().err
    assert told.count("\n") == 2
    assert [p.name for p in Path("out.transcript").glob("*.json")] == ["001_recognize.json"]


def test_no_answer_at_all_ends_with_one_line_and_leaves_nothing(model: Model, capfd) -> None:
    model.service.turns[:] = [(401, {}, json.dumps({"error": {"message": f"bad key {SECRET}"}}).encode())] * 9
    assert articulate(model, "out") == 6
    told = capfd.readouterr().err
    assert told.count("\n") == 1
    assert SECRET not in told
    assert not Path("out").exists()


@pytest.mark.parametrize(
    ("given", "answered", "warns"),
    [("fridge", "refrigerator", False), ("fridge", "washing machine", True), ("gizmo", "lamp", False), (None, "lamp", False)],
)
def test_a_given_category_of_another_kind_than_the_answered_one_gives_a_warning(given, answered, warns: bool) -> None:
    found = _other_category(given, answered)
    assert [f"--category {given} was given, but the answer is {answered!r}" in w for w in found] == [True] * warns
