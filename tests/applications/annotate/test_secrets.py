"""Marked keys are in no file, no output and no error of a collection, whatever the provider says."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from pathlib import Path

import pytest
import trimesh
from dialects import _openai
from model_wire import SECRET, Service

from anymesh.cli import run

KEYS = ("ANYMESH_API_KEY", "OPENAI_API_KEY", "ANTHROPIC_API_KEY", "GOOGLE_API_KEY", "MESHY_API_KEY", "HF_TOKEN")


@pytest.fixture
def service(tmp_path, monkeypatch) -> Iterator[Service]:
    """A provider that repeats the key in its answers, then in its errors."""
    pytest.importorskip("pydantic_ai")
    for name in [n for n in os.environ if "PROXY" in n.upper()]:
        monkeypatch.delenv(name)
    for number, name in enumerate(KEYS):
        monkeypatch.setenv(name, f"{SECRET}-{number}")
    monkeypatch.setenv("ANYMESH_CACHE", str(tmp_path / "cache"))
    found = Service()

    def answer(handler) -> None:
        number = len(found.seen)
        text = f"I was sent {SECRET}-0 in {found.seen[-1].headers}"
        body = json.dumps(_openai(text, "stop") if number < 3 else {"error": {"message": text}}).encode()
        handler.send_response(200 if number < 3 else 400)
        handler.send_header("content-type", "application/json")
        handler.send_header("content-length", str(len(body)))
        handler.end_headers()
        handler.wfile.write(body)
        found.turns.append(answer)

    found.turns.append(answer)
    server = found.start()
    yield found
    found.over.set()
    server.shutdown()
    server.server_close()


def leaks(folder: Path) -> list[str]:
    """Files that hold a key, as it is or packed in base64 or hex."""
    import base64

    marks = [SECRET.encode(), SECRET.encode().hex().encode(), base64.b64encode(SECRET.encode())[:12]]
    return [str(p) for p in folder.rglob("*") if p.is_file() and any(mark in p.read_bytes() for mark in marks)]


def test_keys_are_in_no_file_and_no_output_of_a_collection(tmp_path, service, capfd) -> None:
    (tmp_path / "in").mkdir()
    trimesh.creation.box().export(tmp_path / "in" / "box.stl")
    (tmp_path / "in" / f"{'x' * 40}.glb").write_text("no mesh")
    call = [
        "annotate",
        str(tmp_path / "in"),
        "-o",
        str(tmp_path / "out"),
        "--answerer",
        f"openai-compatible:{service.url}/v1#m",
    ]
    run([*call, "-j", "1", "--attempts", "1", "--views", "1@15", "--formats", "urdf"])
    told = capfd.readouterr()
    assert len(service.seen) >= 2
    assert any(SECRET in value for value in service.seen[0].headers.values())  # it was sent, to where it belongs
    assert SECRET not in told.out + told.err
    assert (tmp_path / "out" / "report.html").is_file()
    assert leaks(tmp_path) == []


def test_the_search_would_find_them(tmp_path) -> None:
    (tmp_path / "a").write_text(f"key={SECRET}-0")
    assert len(leaks(tmp_path)) == 1
