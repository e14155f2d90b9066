"""The tools of an agent, through the protocol's own client: over stdio, over HTTP, and with faults."""

from __future__ import annotations

import base64
import io
import json
import os
import shutil
import socket
import subprocess
import sys
import time
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import asynccontextmanager
from itertools import pairwise
from pathlib import Path
from typing import Any

import anyio
import pytest
from assets import cabinet
from PIL import Image

pytest.importorskip("mcp")

from mcp.client.client import Client
from mcp.client.stdio import StdioServerParameters, stdio_client

from anymesh.agents.server_ import _as_arguments, make_server
from anymesh.agents.tools import _corrected
from anymesh.cli import run
from anymesh.correcting import CorrectionError
from anymesh.correcting.history import History
from anymesh.errors import InputError
from anymesh.evaluation.ground_truth import example_truths, prepared
from anymesh.evaluation.oracle import oracle
from anymesh.prompted.answerers.question_files import find_questions
from anymesh.prompted.questions.saved_question import answer_object, unpack_question

EXAMPLES = Path(__file__).parents[2] / "examples"
TOOLS = {"articulate", "open_questions", "answer", "inspect", "correct", "check", "export"}
SERVER = [sys.executable, "-m", "anymesh.cli", "mcp"]


@pytest.fixture
def work(tmp_path: Path) -> Path:
    folder = tmp_path / "work"
    folder.mkdir()
    shutil.copy(EXAMPLES / "meshes" / "storage_box.glb", folder / "box.glb")
    shutil.copy(EXAMPLES / "meshes" / "storage_box.glb", tmp_path / "secret.glb")
    (folder / "link.glb").symlink_to(tmp_path / "secret.glb")
    return folder


class Agent:
    """A client that reads what the tools say."""

    def __init__(self, client: Client) -> None:
        self.client = client
        self.progress: list[tuple[float, str]] = []

    async def call(self, tool: str, **arguments: Any) -> tuple[dict[str, Any], list[bytes]]:
        async def heard(progress: float, total: float | None, message: str | None) -> None:
            self.progress.append((progress, message or ""))

        result = await self.client.call_tool(tool, arguments, progress_callback=heard)
        texts = [c.text for c in result.content if c.type == "text"]
        if result.is_error:
            return {"error": texts[0]}, []
        return json.loads(texts[0]), [base64.b64decode(c.data) for c in result.content if c.type == "image"]


async def over_stdio(folder: Path, script: Callable[[Agent], Awaitable[None]]) -> None:
    environment = {k: v for k, v in os.environ.items() if k.startswith(("PYTHON", "ANYMESH"))}
    server = StdioServerParameters(command=SERVER[0], args=[*SERVER[1:], str(folder)], env=environment)
    async with Client(stdio_client(server)) as client:
        await script(Agent(client))


@asynccontextmanager
async def http_server(folder: Path) -> AsyncIterator[str]:
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    process = subprocess.Popen([*SERVER, str(folder), "--http", "--port", str(port)], stderr=subprocess.DEVNULL)
    try:
        for _ in range(300):
            with socket.socket() as probe:
                if probe.connect_ex(("127.0.0.1", port)) == 0:
                    break
            await anyio.sleep(0.1)
        yield f"http://127.0.0.1:{port}/mcp"
    finally:
        process.terminate()
        process.wait(10)


def known_answer(folder: Path) -> dict[str, Any]:
    answerer = oracle(prepared(next(t for t in example_truths(EXAMPLES) if t.name == "storage_box")))
    (found,) = [q for q in find_questions(folder) if q.path == folder]
    question = unpack_question((folder / "check.npz").read_bytes(), found.pictures())
    return answer_object(question, answerer.ask(question))


async def finish(agent: Agent, work: Path, told: dict[str, Any], pictures: list[bytes]) -> None:
    """From a finished asset to one that is corrected, checked and exported."""
    assert told["state"] == "done"
    assert [p["name"] for p in told["parts"][1:]] == ["lid"]
    (joint,) = told["joints"]
    assert (joint["type"], 0 < joint["confidence"] <= 1) == ("revolute", True)
    assert len(pictures) == 1  # the preview
    assert any("segment" in words for _, words in agent.progress)
    counts = [count for count, _ in agent.progress]
    assert all(after > before or after == 1 for before, after in pairwise(counts))
    upper = {"correction": "set_limits", "part": "lid", "lower": 0.0, "upper": 1.0}
    corrected, _ = await agent.call("correct", asset="out", corrections=[upper])
    assert (corrected["joints"][0]["limits"], corrected["corrections"]) == ([0.0, 1.0], 1)
    given = [{"part": "lid", "motion": 1, "limits": "0,1rad"}, {"part": "lid_joint", "right": True}]
    told, _ = await agent.call("correct", asset="out", corrections=given)
    assert [(r["part"], r["change"], r["confidence"]) for r in told["changed"]] == [("lid", "changed", 1.0)]
    no_part, no_name = ({"part": "li", "flip": True}, "parts are base, lid"), ({"part": ["lid"]}, "name of a part")
    for wrong, words in (no_part, no_name):
        refused, _ = await agent.call("correct", asset="out", corrections=[{"part": "lid", "flip": True}, wrong])
        assert words in refused["error"]
    told, _ = await agent.call("correct", asset="out", corrections=[{"undo": True}, {"undo": True}])
    assert (told["joints"][0]["limits"], told["corrections"]) == ([0.0, 1.0], 1)
    report, _ = await agent.call("check", asset="out")
    assert (report["ok"], report["path"]) == (True, "out")
    made, _ = await agent.call("export", asset="out", formats="urdf,mjcf", archive="out.zip")
    assert set(made["files"]) >= {"urdf", "mjcf"}
    assert (work / "out.zip").stat().st_size > 1000
    motions, _ = await agent.call("inspect", asset="out", motions_of="lid", regions_of="base")
    assert (motions["motions"][0]["number"], motions["regions"][0]["number"]) == (1, 1)
    assert motions["motions"][0]["correction"] == "choose_motion"
    assert motions["joints"][0]["limits"] == [0.0, 1.0]


def test_an_agent_takes_a_mesh_to_a_checked_asset_over_stdio(work: Path) -> None:
    async def script(agent: Agent) -> None:
        assert {t.name for t in (await agent.client.list_tools()).tools} == TOOLS
        assert "preview.png" in (agent.client.instructions or "")
        options = {"answerer": "geometry", "formats": "urdf"}
        await finish(agent, work, *await agent.call("articulate", mesh="box.glb", out="out", **options))

    anyio.run(over_stdio, work, script)


@pytest.mark.slow
def test_an_agent_answers_all_questions_over_stdio(work: Path) -> None:
    async def script(agent: Agent) -> None:
        answers: list[dict[str, Any]] = []
        for _ in range(12):
            told, pictures = await agent.call("articulate", mesh="box.glb", out="out", formats="urdf", answers=answers)
            if told.get("state") != "open":
                break
            assert pictures
            assert all(Image.open(io.BytesIO(png)).size[0] > 100 for png in pictures)
            answers = [{"question": told["question"], "answer": known_answer(work / told["question"])}]
        await finish(agent, work, told, pictures)

    anyio.run(over_stdio, work, script)


def test_the_same_tools_over_http_and_only_for_this_machine(work: Path) -> None:
    import httpx2

    async def script() -> None:
        async with http_server(work) as url:
            async with Client(url) as client:
                agent = Agent(client)
                assert {t.name for t in (await client.list_tools()).tools} == TOOLS
                told, pictures = await agent.call("articulate", mesh="box.glb", out="out")
                assert (told["state"], told["kind"], len(pictures)) == ("open", "recognize", 1)
                assert agent.progress
                listed, none = await agent.call("open_questions", pictures="none")
                assert (listed["question"], none) == (told["question"], [])
                _, single = await agent.call("open_questions", pictures="all")
                assert len(single) > len(pictures)
                refused, _ = await agent.call("answer", question=told["question"], answer={"category": "box"})
                assert "not a valid answer" in refused["error"]
                assert not (work / told["question"] / "answer.json").exists()
                good = known_answer(work / told["question"])
                answered, _ = await agent.call("answer", question=told["question"], answer=good)
                assert answered["checked_whole"]
                assert json.loads((work / told["question"] / "answer.json").read_text()) == good
            body = {"jsonrpc": "2.0", "id": 1, "method": "ping"}
            headers = {"accept": "application/json, text/event-stream", "host": "evil.example"}
            async with httpx2.AsyncClient() as plain:
                assert (await plain.post(url, json=body, headers=headers)).status_code in (403, 421)
                headers = {**headers, "host": url.split("/")[2], "origin": "https://evil.example"}
                assert (await plain.post(url, json=body, headers=headers)).status_code == 403

    anyio.run(script)


FAULTS: dict[str, tuple[str, dict[str, Any], str]] = {
    "a mesh outside": ("articulate", {"mesh": "../secret.glb", "out": "out"}, "lies outside"),
    "a link that leads outside": ("articulate", {"mesh": "link.glb", "out": "out"}, "lies outside"),
    "an absolute path": ("articulate", {"mesh": "/etc/passwd", "out": "out"}, "lies outside"),
    "an output outside": ("articulate", {"mesh": "box.glb", "out": "../out"}, "lies outside"),
    "the whole folder": ("articulate", {"mesh": "box.glb", "out": "."}, "name a folder in it"),
    "labels outside": ("articulate", {"mesh": "box.glb", "out": "out", "parts": "../x.npy"}, "lies outside"),
    "a model that costs": ("articulate", {"mesh": "box.glb", "out": "out", "answerer": "openai:gpt-4o"}, "answerer"),
    "an argument that is unknown": ("articulate", {"mesh": "box.glb", "out": "out", "colour": 3}, "colour"),
    "an argument that lacks": ("articulate", {"mesh": "box.glb"}, "out"),
    "an argument of another type": ("articulate", {"mesh": 3, "out": []}, "mesh"),
    "no such mesh": ("articulate", {"mesh": "none.glb", "out": "out"}, "none.glb"),
    "a null byte": ("inspect", {"asset": "a\x00b"}, "not a path"),
    "no asset": ("inspect", {"asset": "box"}, "holds no asset"),
    "no answer in answers": ("articulate", {"mesh": "box.glb", "out": "out", "answers": [{"question": "."}]}, "an answer is"),
    "answers to no question": ("articulate", {"mesh": "box.glb", "out": "out", "answers": [{"answer": "x"}]}, "no questions"),
    "no question": ("answer", {"question": ".", "answer": "geometry"}, "is not a question"),
    "a question outside": ("answer", {"question": "../..", "answer": "geometry"}, "lies outside"),
    "corrections of nothing": ("correct", {"asset": "out", "corrections": []}, "not an output of anymesh"),
    "a check of nothing": ("check", {"asset": "nowhere"}, "nowhere"),
    "an engine that is unknown": ("check", {"asset": ".", "engines": ["abacus"]}, "abacus"),
    "a zip outside": ("export", {"asset": "out", "archive": "../out.zip"}, "lies outside"),
    "no such tool": ("delete_everything", {}, "delete_everything"),
}


def test_faults_are_told_and_change_nothing(work: Path) -> None:
    async def script() -> None:
        async with Client(make_server([str(work)])) as client:
            agent = Agent(client)
            for name, (tool, arguments, words) in FAULTS.items():
                try:
                    told, pictures = await agent.call(tool, **arguments)
                except Exception as error:
                    told, pictures = {"error": str(error)}, []
                assert words in told.get("error", ""), (name, told)
                assert not pictures
            assert (await agent.call("open_questions"))[0] == {"open": 0}

    before = sorted(work.parent.rglob("*"))
    anyio.run(script)
    assert sorted(work.parent.rglob("*")) == before


def test_what_the_command_line_refuses(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["mcp", str(tmp_path), "--http", "--host", "0.0.0.0"]) == 2
    assert "there is no password" in capsys.readouterr().err
    assert run(["mcp", str(tmp_path / "nowhere")]) == InputError.exit_code
    assert run(["skill"]) == 0
    told = capsys.readouterr().out
    assert told.startswith("---\nname: articulate-anymesh\ndescription: ")
    for command in ("articulate", "answer", "check", "export", "inspect", "correct"):
        assert command in told


@pytest.mark.slow
def test_stdio_carries_nothing_but_the_protocol(work: Path) -> None:
    opening = {
        "jsonrpc": "2.0",
        "id": 1,
        "method": "initialize",
        "params": {"protocolVersion": "2025-06-18", "capabilities": {}, "clientInfo": {"name": "t", "version": "1"}},
    }
    begin = time.monotonic()
    done = subprocess.run([*SERVER, str(work)], input=json.dumps(opening) + "\n", capture_output=True, text=True, timeout=60)
    (line,) = done.stdout.splitlines()
    assert json.loads(line)["result"]["serverInfo"]["name"] == "anymesh"
    assert time.monotonic() - begin < 30


def test_options_of_the_command_line_are_told_as_arguments_of_tools() -> None:
    told = "to use the answer, give --scale 0.45:longest; --at-least 1 helps; --detail low and a--scale b stay"
    assert _as_arguments(told) == (
        "to use the answer, give scale 0.45:longest; at_least 1 helps; --detail low and a--scale b stay"
    )


@pytest.mark.parametrize(
    ("correction", "told"),
    [
        ({"correction": "set_limits", "part": "door", "lower": "a", "upper": 1}, "wrong kind|needs part, lower"),
        ({"correction": ["a"]}, "unknown correction"),
        ({"correction": "choose_motion", "part": "door"}, "needs part, type"),
    ],
)
def test_a_correction_with_a_value_of_the_wrong_kind_says_so(correction: dict, told: str) -> None:
    with pytest.raises(CorrectionError, match=told):
        _corrected(History((cabinet(),)), correction)
