"""Questions as folders: the whole road with answers written by hand, faults, other objects, changed input."""

import io
import json
import shutil
import threading
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from asked import ASKED, PICTURE, parts
from made import smaller
from PIL import Image, ImageDraw

from anymesh import pipeline
from anymesh.cli import run
from anymesh.errors import InputError, OpenQuestionError, OptionError
from anymesh.evaluation.evaluating import evaluate
from anymesh.evaluation.ground_truth import example_truths, prepared
from anymesh.evaluation.oracle import oracle
from anymesh.prompted.answerers.file_answerer import answer_text, open_in, record_answers
from anymesh.prompted.answerers.question_files import QuestionStore, example_answer, explain_schema, find_questions
from anymesh.prompted.answerers.recordings import Replay
from anymesh.prompted.models.vision import Request
from anymesh.prompted.questions.asking import BadAnswerError, a_list, an_object, check_schema, one_of
from anymesh.prompted.questions.saved_question import answer_object, pack_question, unpack_question
from anymesh.rendering.marks import font
from anymesh.rendering.render import encode
from anymesh.types import Picture

EXAMPLES = Path(__file__).parents[2] / "examples"
MESH = EXAMPLES / "meshes" / "storage_box.glb"


@pytest.fixture(autouse=True, scope="module")
def quick() -> Iterator[None]:
    with smaller(240, 8_000):
        yield


@pytest.fixture
def work(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    shutil.copy(MESH, tmp_path / "box.glb")
    return tmp_path


@pytest.fixture(scope="module")
def known():
    """Return a function that answers a question from its folder alone, with the true answer."""
    answerer = oracle(prepared(next(t for t in example_truths(EXAMPLES) if t.name == "storage_box")))

    def answer(folder: Path) -> str:
        (found,) = [q for q in find_questions(folder) if q.path == folder]
        question = unpack_question((folder / "check.npz").read_bytes(), found.pictures())
        return json.dumps(answer_object(question, answerer.ask(question)))

    return answer


def waiting(capsys: pytest.CaptureFixture[str], *more: str) -> dict:
    capsys.readouterr()
    code = run(["articulate", "box.glb", "-o", "out", "--answerer", "files:q", "--json", *more])
    found = json.loads(capsys.readouterr().out)
    assert code == found.get("exit_code", 0)
    return found


@pytest.mark.slow
def test_questions_are_answered_one_after_another_and_the_recording_replays(work: Path, known, capsys) -> None:
    kinds = []
    while "questions" in (found := waiting(capsys)):
        assert found["exit_code"] == 9
        assert not Path("out").exists()
        (folder,) = map(Path, found["questions"])
        kinds.append(folder.name)
        names = {p.name for p in folder.iterdir()}
        assert {"question.md", "schema.json", "question.json", "sheet.png", "01.png"} <= names
        words = (folder / "question.md").read_text()
        assert all(f"]({name})" in words for name in names if name.endswith(".png"))
        assert run(["answer", "q", known(folder), "-q"]) == 0
    assert kinds == [f"{k:02d}-{kind.partition('-')[2]}" for k, kind in enumerate(kinds, 1)]
    assert len(kinds) >= 4
    (joint,) = found["joints"]
    assert (joint["type"], joint["child"], found["warnings"]) == ("revolute", "lid", [])
    assert found["usage"]["calls"] == len(kinds)
    assert (found["usage"]["cost_usd"], found["usage"]["cached_calls"]) == (0, 0)
    replayed = pipeline.articulate("box.glb", "replayed", answerer="replay:q")
    assert replayed.joints[0].axis.tolist() == joint["axis"]
    keys = {json.loads(p.read_text())["key"] for p in Path("out/transcript").glob("*.json")}
    assert keys == {q.key for q in find_questions(Path("q"))}


def test_a_refused_answer_says_why_and_stays_open(work: Path, known, capsys) -> None:
    (folder,) = map(Path, waiting(capsys)["questions"])
    right = known(folder)
    wrong = json.dumps({**json.loads(right), "longest_side_m": 9000})
    (folder / "answer.json").write_text(wrong)
    assert waiting(capsys)["questions"] == [str(folder)]
    assert "must lie in 0.002..200" in (folder / "refused.md").read_text()
    with pytest.raises(OptionError, match="longest_side_m"):
        record_answers([(Path("q"), wrong)])
    for bad in ("{", "no", "[]", '{"category": "box"}'):
        with pytest.raises(OptionError, match="not a valid answer"):
            record_answers([(Path("q"), bad)])
    assert [q.path for q in open_in(Path("q"))] == [folder]
    record_answers([(Path("q"), right)])
    assert not (folder / "refused.md").exists()
    assert open_in(Path("q")) == []


@pytest.mark.slow
def test_a_changed_mesh_asks_anew_and_an_other_object_is_refused(work: Path, known, capsys) -> None:
    (folder,) = map(Path, waiting(capsys)["questions"])
    record_answers([(folder, known(folder))])
    shutil.copy(EXAMPLES / "meshes" / "laptop.glb", "box.glb")
    (other,) = map(Path, waiting(capsys)["questions"])
    assert (other.name, other != folder) == ("02-recognize", True)
    shutil.copy(MESH, "box.glb")
    (views,) = map(Path, waiting(capsys)["questions"])
    assert views.name.startswith("03-")
    assert [q.path for q in open_in(Path("q"))] == [views]  # the laptop's question is asked no longer
    shutil.copy(MESH, "lamp.glb")
    with pytest.raises(OptionError, match=r"about '\S+/box.glb', and this run is about '\S+/lamp.glb'"):
        pipeline.articulate("lamp.glb", "out2", answerer="files:q")


def segment_until_done(known) -> list[str]:
    """The kinds of questions that were asked."""
    asked = []
    while True:
        try:
            pipeline.segment("box.glb", "out", answerer="files:q", force=True)
            return asked
        except OpenQuestionError as error:
            (folder,) = error.folders
            asked.append(folder.name)
            record_answers([(folder, known(folder))])


@pytest.mark.slow
def test_another_answer_to_a_finished_stage_makes_it_and_what_follows_anew(work: Path, known) -> None:
    asked = segment_until_done(known)
    assert segment_until_done(known) == []  # nothing has changed
    found = json.loads(Path("q", asked[0], "answer.json").read_text())
    found["parts"][0]["label"] = "hatch"
    record_answers([(Path("q", asked[0]), json.dumps(found))])
    with pytest.raises(OpenQuestionError) as stopped:
        pipeline.segment("box.glb", "out", answerer="files:q", force=True)
    assert "hatch" in (stopped.value.folders[0] / "question.md").read_text()


@pytest.mark.slow
def test_a_question_is_left_to_geometry(work: Path, capsys) -> None:
    (folder,) = map(Path, waiting(capsys)["questions"])
    assert run(["answer", str(folder), "geometry", "-q"]) == 0
    assert waiting(capsys)["questions"] != [str(folder)]


def test_waiting_goes_on_when_the_answer_comes(work: Path, known, monkeypatch: pytest.MonkeyPatch) -> None:
    done = threading.Event()

    def answers() -> None:
        while not done.is_set():
            for question in find_questions(Path("q")):
                if question.answer() is None:
                    question.write_answer(known(question.path))
            time.sleep(0.05)

    helper = threading.Thread(target=answers)
    helper.start()
    asset = pipeline.articulate("box.glb", "out", answerer="files:q", wait=True, formats="urdf")
    done.set()
    helper.join()
    assert [(j.child, j.type) for j in asset.joints] == [("lid", "revolute")]
    keys = {json.loads(p.read_text())["key"] for p in Path("out/transcript").glob("*.json")}
    assert keys == {q.key for q in find_questions(Path("q"))}
    replayed = Replay(Path("q"))
    assert replayed.name == "files"


def test_a_batch_leaves_the_questions_of_all_open(work: Path, known, capsys) -> None:
    Path("meshes").mkdir()
    shutil.copy(MESH, "meshes/one.glb")
    shutil.copy(MESH, "meshes/two.glb")
    Path("meshes/broken.glb").write_bytes(b"no mesh")
    command = ["articulate", "meshes", "-o", "out", "--batch", "--answerer", "files:q", "--json"]
    assert run(command) == 9
    told = json.loads(capsys.readouterr().out)
    assert [o["state"] for o in told["objects"]] == ["failed", "open", "open"]
    assert [Path(q).parts for q in told["questions"]] == [("q", "one", "01-recognize"), ("q", "two", "01-recognize")]
    assert run(["answer", "q", "geometry", "--json"]) == 2  # which one?
    assert "name the one to answer" in json.loads(capsys.readouterr().out)["error"]
    for question in open_in(Path("q")):
        record_answers([(question.path, known(question.path))])
    Path("meshes/broken.glb").unlink()
    assert run(command) == 9
    again = json.loads(capsys.readouterr().out)["questions"]
    assert [Path(q).name.partition("-")[0] for q in again] == ["02", "02"]


def test_without_a_folder_or_with_a_file_there_is_one_clear_error(work: Path) -> None:
    with pytest.raises(OptionError, match="files:FOLDER"):
        pipeline.articulate("box.glb", "out", answerer="files:")
    with pytest.raises(OptionError, match="this is a file"):
        pipeline.articulate("box.glb", "out", answerer="files:box.glb")
    with pytest.raises(OptionError, match="has no questions"):
        open_in(Path("nowhere"))
    with pytest.raises(OpenQuestionError):
        pipeline.articulate("box.glb", "out", answerer="files:a b")
    assert run(["answer", "a b", "--json"]) == 0


def test_an_evaluation_asks_about_each_object_in_a_folder_of_its_name(
    work: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.chdir(EXAMPLES.parent)
    with pytest.raises(OpenQuestionError, match="2 of 2 objects wait") as stopped:
        evaluate("examples", tmp_path / "eval", only=("storage_box", "bucket"), jobs=1, answerer=f"files:{tmp_path / 'q'}")
    places = [(f.parent.name, f.name) for f in stopped.value.folders]
    assert places == [("bucket", "01-motions"), ("storage_box", "01-motions")]


@pytest.mark.slow
def test_waiting_in_an_evaluation_ends_with_the_command(work: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.chdir(EXAMPLES.parent)

    def interrupts(stage: str, item: str, done: int, total: int) -> None:
        if item == "bucket":
            raise KeyboardInterrupt

    def answers() -> None:
        for _ in range(600):
            for question in find_questions(tmp_path / "q" / "bucket"):
                if question.answer() is None:
                    question.write_answer("geometry")
            if over.wait(0.05):
                return

    over = threading.Event()
    helper = threading.Thread(target=answers)
    helper.start()
    options = {"only": ("storage_box", "bucket"), "jobs": 2, "answerer": f"files:{tmp_path / 'q'}", "wait": True}
    with pytest.raises(KeyboardInterrupt):  # after the first object, while the other one waits
        evaluate("examples", tmp_path / "eval", progress=interrupts, **options)
    over.set()
    helper.join()


@pytest.mark.parametrize("name", ASKED)
def test_a_saved_question_checks_as_the_one_that_was_asked(name: str) -> None:
    asked = ASKED[name]
    again = unpack_question(pack_question(asked.question), asked.question.pictures)
    assert (again.kind, again.text(), again.schema()) == (asked.question.kind, asked.question.text(), asked.question.schema())
    assert again.parse(asked.found) == asked.means
    broken = {**asked.found, "parts": [*asked.found["parts"], asked.found["parts"][0]]}
    told = []
    for question in (asked.question, again):
        try:
            told.append(question.parse(broken))
        except BadAnswerError as error:
            told.append(str(error))
    assert told[0] == told[1]


def test_kinds_of_motion_saved_under_their_earlier_names_are_read() -> None:
    question = next(a.question for name, a in ASKED.items() if name.startswith("motions"))
    with np.load(io.BytesIO(pack_question(question))) as found:
        arrays = dict(found)
    text = arrays["record"].tobytes().decode()
    assert '"REVOLUTE"' in text
    earlier = text.replace('"REVOLUTE"', '"TURN"').replace('"PRISMATIC"', '"SLIDE"')
    buffer = io.BytesIO()
    np.savez(buffer, **arrays | {"record": np.frombuffer(earlier.encode(), np.uint8)})
    again = unpack_question(buffer.getvalue(), question.pictures)
    assert [m.kind for t in again.tables for m in t.motions] == [m.kind for t in question.tables for m in t.motions]


@pytest.mark.parametrize("name", ASKED)
def test_the_names_of_classes_in_files_are_those_of_the_first_version(name: str) -> None:
    with np.load(io.BytesIO(pack_question(ASKED[name].question))) as found:
        record = json.loads(found["record"].tobytes())
    assert record["class"].split(":")[0] in {f"anymesh.reasoning.{m}" for m in ("grounding", "prompting", "recognition")}


def test_a_renamed_enum_keeps_its_name_in_files() -> None:
    question = ASKED["points"].question
    with np.load(io.BytesIO(pack_question(question))) as found:
        text = found["record"].tobytes().decode()
    assert "anymesh.reasoning.prompting:JointKind" in text
    assert "JointAppearance" not in text
    again = unpack_question(pack_question(question), question.pictures)
    assert [t.kind for t in again.tables] == [t.kind for t in question.tables]


@pytest.mark.parametrize(
    "record",
    [
        {"class": "os:system", "fields": {}},
        {"class": "anymesh.prompted.questions.saved_question:importlib", "fields": {}},
        {"class": "anymesh.prompted.questions.recognition:recognize", "fields": {}},
        {"class": "anymesh.reasoning.recognition:recognize", "fields": {}},
        {
            "class": "anymesh.prompted.questions.recognition:Recognize",
            "fields": {"category": {"is": "object", "class": "pathlib:Path"}},
        },
    ],
)
def test_a_saved_question_can_name_no_other_code(record: dict) -> None:
    buffer = io.BytesIO()
    np.savez(buffer, record=np.frombuffer(json.dumps(record).encode(), np.uint8))
    for content in (buffer.getvalue(), b"", b"PK\x03\x04", buffer.getvalue()[:60]):
        with pytest.raises(InputError, match="cannot be read"):
            unpack_question(content, (PICTURE,))


@pytest.mark.parametrize("name", ASKED)
def test_the_example_satisfies_the_schema_in_form(name: str) -> None:
    schema = ASKED[name].question.schema()
    check_schema(example_answer(schema), schema)
    assert all(f"`{key}`" in explain_schema(schema) for key in schema["properties"]["parts"]["items"]["properties"])


@pytest.mark.parametrize(
    ("name", "told", "found"),
    [
        ("motions", "1=2 2=0", parts({"part": 1, "motion": 2}, {"part": 2, "motion": 0})),
        ("points", "1=3,1  2=4", parts({"part": 1, "points": [3, 1]}, {"part": 2, "points": [4]})),
        ("kinds", "1=hinge_into_surface,endless", parts({"part": 1, "joint": "hinge_into_surface", "endless": True})),
        ("marks", "door#2=1,4", parts({"label": "door", "instance": 2, "marks": [1, 4]})),
        ("marks", "door=1", parts({"label": "door", "instance": 1, "marks": [1]})),
        ("views", "door=1,2", parts({"label": "door", "views": [1, 2]})),
        ("arrows", "1=3", parts({"part": 1, "arrow": 3})),
    ],
)
def test_the_short_form(name: str, told: str, found: dict) -> None:
    schema = next(a for key, a in ASKED.items() if key.startswith(name)).question.schema()
    answer = json.loads(answer_text(told, schema))
    check_schema(answer, schema)
    pairs = zip(answer["parts"], found["parts"], strict=True)
    assert all(expected.items() <= entry.items() for entry, expected in pairs)


def test_the_short_form_passes_over_reasons_and_flags() -> None:
    item = an_object(reason={"type": "string"}, part={"type": "integer"}, pick=one_of(("a", "b")), unsure={"type": "boolean"})
    schema = an_object(note={"type": "string"}, parts=a_list(item))
    expected = {"note": "", "parts": [{"reason": "", "part": 3, "pick": "b", "unsure": True}]}
    assert json.loads(answer_text("3=b,unsure", schema)) == expected


def test_the_short_form_of_a_motion_takes_the_region_for_right_unless_told() -> None:
    schema = replace(ASKED["motions"].question, ask_fit=True).schema()
    answer = json.loads(answer_text("1=2 2=0,too_much", schema))
    check_schema(answer, schema)
    assert [(p["motion"], p["part_is"]) for p in answer["parts"]] == [(2, "right"), (0, "too_much")]


@pytest.mark.parametrize("told", ["1=2 and more", "1=x", "x=1", "1=1,2", "1#2=1", "1="])
def test_a_short_form_that_does_not_fit_is_an_error(told: str) -> None:
    with pytest.raises(OptionError):
        answer_text(told, ASKED["motions"].question.schema())


def test_json_stays_as_it_was_typed() -> None:
    schema = ASKED["motions"].question.schema()
    assert answer_text(' {"parts": []} ', schema) == '{"parts": []}'
    assert answer_text("words", schema) == "words"


def test_an_answer_holds_for_pictures_that_differ_by_rounding_and_for_no_other_number(tmp_path: Path) -> None:
    def drawn(number: str, off: int) -> Picture:
        image = Image.new("RGB", (200, 200), (200, 200, 200))
        ImageDraw.Draw(image).text((90, 90), number, fill=(0, 0, 0), font=font(14))
        image.putpixel((20, 30), (200 - off,) * 3)
        return encode(np.asarray(image), "picture 1: a view")

    store = QuestionStore(tmp_path)
    asked = [Request("marks", "", "which?", (drawn(*shown),), {"type": "object"}) for shown in (("8", 0), ("8", 90), ("9", 0))]
    store.put(asked[0], {}).write_answer("{}")
    assert [store.put(request, {}).answer() for request in asked] == ["{}", "{}", None]
    assert store.put(replace(asked[1], text="which one?"), {}).answer() is None
