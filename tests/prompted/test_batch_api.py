"""Open questions sent as one job of a provider's batch API, against a real server that speaks Anthropic's format."""

import http.server
import json
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from dialects import ANTHROPIC
from wire import SECRET, a_request

from anymesh.cli import run
from anymesh.errors import BudgetError, ModelError, OptionError
from anymesh.prompted.answerers.question_files import find_questions
from anymesh.prompted.answerers.question_store import QuestionStore
from anymesh.prompted.models.batch_api import answer_by_batch

pytest.importorskip("pydantic_ai")
MODEL = "anthropic:claude-sonnet-4-5"
GOOD = '{"hinge": 3, "why": "it is the longest edge"}'


class Jobs:
    """A service with one job at a time. answers: by the request's name; None: the request failed."""

    def __init__(self) -> None:
        self.requests: list[dict[str, Any]] = []
        self.answers: dict[str, str | None] = {}
        self.ended, self.status, self.url = False, 200, ""

    def batch(self) -> dict[str, Any]:
        counts = dict.fromkeys(("processing", "succeeded", "errored", "canceled", "expired"), 0)
        return {
            "id": "msgbatch_1", "type": "message_batch", "created_at": "2026-11-22T00:00:00Z", "archived_at": None,
            "expires_at": "2026-11-23T00:00:00Z", "ended_at": "2026-11-22T01:00:00Z" if self.ended else None,
            "cancel_initiated_at": None, "processing_status": "ended" if self.ended else "in_progress",
            "request_counts": counts, "results_url": f"{self.url}/v1/messages/batches/msgbatch_1/results",
        }  # fmt: skip

    def results(self) -> bytes:
        lines = []
        for name, text in self.answers.items():
            failed = {
                "type": "errored",
                "error": {"type": "error", "error": {"type": "invalid_request_error", "message": "no"}},
            }
            made = {"type": "succeeded", "message": ANTHROPIC.reply(text or "", "stop")}
            lines.append(json.dumps({"custom_id": name, "result": failed if text is None else made}))
        return "\n".join(lines).encode()

    def handler(jobs) -> type[http.server.BaseHTTPRequestHandler]:  # noqa: N805
        class Handler(http.server.BaseHTTPRequestHandler):
            def do_GET(self) -> None:
                self.say(jobs.results() if self.path.split("?")[0].endswith("/results") else json.dumps(jobs.batch()).encode())

            def do_POST(self) -> None:
                body = json.loads(self.rfile.read(int(self.headers["content-length"])))
                jobs.requests = body["requests"]
                self.say(json.dumps(jobs.batch()).encode())

            def say(self, content: bytes) -> None:
                self.send_response(jobs.status)
                self.send_header("content-type", "application/json")
                self.send_header("content-length", str(len(content)))
                self.end_headers()
                self.wfile.write(content)

            def log_message(self, *args: object) -> None: ...

        return Handler


@pytest.fixture
def jobs(monkeypatch: pytest.MonkeyPatch) -> Iterator[Jobs]:
    found = Jobs()
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), found.handler())
    threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.02}, daemon=True).start()
    found.url = f"http://127.0.0.1:{server.server_port}"
    monkeypatch.setenv("ANTHROPIC_BASE_URL", found.url)
    monkeypatch.setenv("ANTHROPIC_API_KEY", SECRET)
    yield found
    server.shutdown()
    server.server_close()


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    for name in ("chair", "lamp"):
        QuestionStore(tmp_path / "q" / name, name).put(a_request(text=f"Where is the hinge of the {name}?"), {})
    return tmp_path / "q"


def test_a_job_is_sent_waited_for_and_collected(jobs: Jobs, folder: Path) -> None:
    sent = answer_by_batch(folder, MODEL, max_cost=1.0)
    assert (sent.state, sent.count) == ("sent", 2)
    bodies = {r["custom_id"]: r["params"] for r in jobs.requests}
    assert len(bodies) == 2
    content = [c for body in bodies.values() for c in body["messages"][0]["content"]]
    assert sum(c["type"] == "image" for c in content) == 4
    assert not [p for p in folder.rglob("*") if p.is_file() and SECRET.encode() in p.read_bytes()]
    assert answer_by_batch(folder, MODEL).state == "waiting"
    chair, lamp = (next(n for n, b in bodies.items() if what in json.dumps(b)) for what in ("chair", "lamp"))
    jobs.ended, jobs.answers = True, {lamp: "I will not", chair: GOOD}
    done = answer_by_batch(folder, MODEL)
    assert (done.state, done.count, done.answered) == ("collected", 2, 1)
    by_name = {q.path.parent.name: q for q in find_questions(folder)}
    assert json.loads(by_name["chair"].answer() or "") == json.loads(GOOD)
    assert "no JSON" in (by_name["lamp"].refusal() or "")
    again = answer_by_batch(folder, MODEL)  # what is still open is sent again, with what was wrong
    assert (again.state, again.count) == ("sent", 1)
    assert "was not valid: I will not" in json.dumps(jobs.requests)
    jobs.answers = {lamp: None}
    last = answer_by_batch(folder, MODEL)
    assert last.answered == 0
    assert any("gave no answer" in line for line in last.refused)


def test_an_answer_that_somebody_gave_since_stays(jobs: Jobs, folder: Path) -> None:
    answer_by_batch(folder, MODEL)
    for question in find_questions(folder):
        question.write_answer('{"hinge": 1, "why": "mine"}')
    jobs.ended, jobs.answers = True, {r["custom_id"]: GOOD for r in jobs.requests}
    assert answer_by_batch(folder, MODEL).answered == 2
    assert all("mine" in (q.answer() or "") for q in find_questions(folder))


def test_what_is_refused(jobs: Jobs, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(BudgetError, match=r"--max-cost 0\.0001"):
        answer_by_batch(folder, MODEL, max_cost=0.0001)
    assert run(["answer", str(folder), "x", "--batch-api", MODEL]) == 2
    with pytest.raises(ModelError, match="no batch API"):
        answer_by_batch(folder, "ollama:llava")
    jobs.status = 500
    with pytest.raises(ModelError) as error:
        answer_by_batch(folder, MODEL)
    assert SECRET not in str(error.value)
    assert not (folder / "batch.json").exists()
    jobs.status = 200
    assert run(["answer", str(folder), "--batch-api", MODEL]) == 0
    assert "sent 2 questions" in capsys.readouterr().out
    with pytest.raises(OptionError, match="waits for a job"):
        answer_by_batch(folder, "openai:gpt-4o")
