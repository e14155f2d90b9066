"""Servers on one's own machine: their names, addresses and models."""

import http.server
import json
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from dialects import _openai
from model_wire import SECRET, Service, a_request

from anymesh.cli import run
from anymesh.errors import OptionError
from anymesh.prompted.answerers.answering import open_model
from anymesh.prompted.models.servers import SERVERS, parse_address, probe_servers

VARIABLES = [v for server in SERVERS.values() for v in (*server.variables, *server.keys)]


@pytest.fixture(autouse=True)
def bare(monkeypatch: pytest.MonkeyPatch) -> None:
    """No server of this machine answers."""
    for name in VARIABLES:
        monkeypatch.delenv(name, raising=False)
    for server in SERVERS.values():
        monkeypatch.setenv(server.variables[0], "127.0.0.1:9")


@contextmanager
def listening(says: dict[str, object]) -> Iterator[str]:
    """Answer each path with JSON or raw bytes."""

    class Handler(http.server.BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            found = says.get(self.path)
            content = found if isinstance(found, bytes) else json.dumps(found).encode()
            self.send_response(404 if found is None else 200)
            self.send_header("content-length", str(len(content)))
            self.end_headers()
            self.wfile.write(content)

        def log_message(self, *args: object) -> None: ...

    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.02}, daemon=True).start()
    yield f"127.0.0.1:{server.server_port}"
    server.shutdown()
    server.server_close()


def listed(*names: str) -> dict[str, object]:
    return {"data": [{"id": name} for name in names]}


def test_names_lead_to_the_usual_places(monkeypatch: pytest.MonkeyPatch) -> None:
    for variable in VARIABLES:
        monkeypatch.delenv(variable, raising=False)
    found = [parse_address(f"{name}:a/b:7b") for name in ("ollama", "lmstudio", "vllm")]
    assert [a.base_url for a in found] == [f"http://127.0.0.1:{port}/v1" for port in (11434, 1234, 8000)]
    assert {(a.model, a.provider) for a in found} == {("a/b:7b", "openai-compatible")}
    assert found[2].keys == ("VLLM_API_KEY",)


@pytest.mark.parametrize(
    ("told", "url"),
    [
        ("0.0.0.0", "http://127.0.0.1:11434/v1"),
        ("box:5000", "http://box:5000/v1"),
        ("http://box:5000/v1/", "http://box:5000/v1"),
        ("https://box/ollama", "https://box:443/ollama/v1"),
        ("[::1]:80", "http://[::1]:80/v1"),
    ],
)
def test_the_environment_says_where(told: str, url: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("OLLAMA_BASE_URL")
    monkeypatch.setenv("OLLAMA_HOST", told)
    assert parse_address("ollama:m").base_url == url


@pytest.mark.parametrize("told", ["ftp://box", "http://me:secret@box", "http://box:port", "http://box?x=1", "http://"])
def test_a_bad_place_is_an_error_that_does_not_repeat_it(told: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("OLLAMA_BASE_URL", told)
    with pytest.raises(OptionError, match="OLLAMA_BASE_URL must hold") as error:
        parse_address("ollama:m")
    assert "secret" not in str(error.value)
    assert probe_servers(0.2)[0].models is None


def test_servers_list_their_models(monkeypatch: pytest.MonkeyPatch) -> None:
    with (
        listening({"/v1/models": listed("llama", "llava")}) as ollama,
        listening({"/v1/models": listed("some/model")}) as vllm,
    ):
        monkeypatch.setenv("OLLAMA_BASE_URL", ollama)
        monkeypatch.setenv("VLLM_BASE_URL", vllm)
        assert [f.models for f in probe_servers()] == [("ollama:llama", "ollama:llava"), None, ("vllm:some/model",)]


@pytest.mark.parametrize("says", [b"<html>", {"data": 3}, {"models": []}, [], {"data": [{}]}])
def test_something_else_on_the_port_is_no_server(says: object, monkeypatch: pytest.MonkeyPatch) -> None:
    with listening({"/v1/models": says}) as place:
        monkeypatch.setenv("VLLM_BASE_URL", place)
        found = probe_servers()[2]
    assert found.models is None
    assert "lists no models" in found.note


def test_models_shows_which_keys_are_set_and_never_what_they_are(monkeypatch: pytest.MonkeyPatch, capsys) -> None:
    monkeypatch.setenv("OPENAI_API_KEY", SECRET)
    monkeypatch.delenv("ANTHROPIC_API_KEY", raising=False)
    assert run(["models"]) == 0
    listed_once = capsys.readouterr().out
    assert listed_once.count("OPENAI_API_KEY") == 1
    assert run(["models", "--json"]) == 0
    shown = listed_once + capsys.readouterr().out
    assert SECRET not in shown
    found = json.loads(shown[shown.index("{") :])
    told = {k["variable"]: k["set"] for k in found["keys"]}
    assert (told["OPENAI_API_KEY"], told["ANTHROPIC_API_KEY"]) == (True, False)
    assert not any(s["answers"] for s in found["servers"])


def test_a_local_model_is_asked_with_its_own_key(service: Service, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    pytest.importorskip("pydantic_ai")
    monkeypatch.setenv("OPENAI_API_KEY", SECRET)
    monkeypatch.setenv("ANYMESH_API_KEY", f"{SECRET}-2")
    monkeypatch.setenv("OLLAMA_BASE_URL", service.url)
    service.says(_openai('{"hinge": 3, "why": "x"}', "stop"))
    reply = open_model("ollama:llava", timeout=5.0).ask(a_request())
    assert (reply.model, json.loads(reply.text)["hinge"]) == ("ollama:llava", 3)
    (seen,) = service.seen
    assert seen.path == "/v1/chat/completions"
    assert SECRET not in json.dumps(seen.headers)
