"""Test faults of the service during generation: budgets, failed tasks, refusals, retries, and secrets."""

import json
import logging

import pytest
from meshy_generation import GLB, PROMPT
from meshy_wire import KEY, SIGNATURE, TEXT, refuses, says

from anymesh.errors import BudgetError, ModelError


def test_the_budget_is_checked_for_all_tasks_before_the_first(model_server, generator) -> None:
    told = r"preview and a text-to-3D refinement take about 30 credits and would exceed --max-calls 1; spent so far: 0 tasks"
    with pytest.raises(BudgetError, match=told):
        generator(max_calls=1).from_text(PROMPT)
    assert model_server.asked == []


@pytest.mark.parametrize("status", ["FAILED", "CANCELED"])
def test_a_refinement_that_failed_is_made_again_and_the_preview_is_not(model_server, generator, status) -> None:
    model_server.ends["text-to-3d-refine"] = {"status": status, "task_error": {"message": "try again"}}
    with pytest.raises(ModelError, match=rf"is {status}, it says: try again; a rerun makes a new one \(about 10 credits\)"):
        generator().from_text(PROMPT)
    model_server.ends.clear()
    assert generator(max_calls=1).from_text(PROMPT).glb == GLB
    assert [task["type"] for task in model_server.tasks.values()] == ["text-to-3d-preview", *["text-to-3d-refine"] * 2]


def test_a_preview_that_is_no_longer_kept_is_forgotten(model_server, generator) -> None:
    client = generator()
    model_server.fails(
        "create", lambda handler: says(handler, {"result": model_server.create(json.loads(handler.content), TEXT)}, 202)
    )
    model_server.fails("create", refuses(402, "no credits"))
    with pytest.raises(ModelError, match="too few credits, a text-to-3D refinement takes about 10"):
        client.from_text(PROMPT)
    model_server.tasks.clear()  # after three days
    with pytest.raises(ModelError, match=r"no longer has task .*; a rerun makes a new one \(about 20 credits\)"):
        generator().from_text(PROMPT)
    assert generator().from_text(PROMPT).glb == GLB


@pytest.mark.parametrize(
    ("status", "told"),
    [(401, "the key in MESHY_API_KEY is missing or refused"), (402, "a text-to-3D preview takes about 20"), (400, "HTTP 400")],
)
def test_a_refusal_is_told_once(model_server, generator, status, told) -> None:
    model_server.fails("create", refuses(status, "no"))
    with pytest.raises(ModelError, match=told):
        generator().from_text(PROMPT)
    assert model_server.count("create") == 1


def test_too_many_requests_and_faults_of_the_server_are_waited_for(model_server, generator, waits) -> None:
    model_server.fails("create", refuses(429, "queue is full", retry_after="7"), refuses(503, "maintenance"))
    model_server.fails("look", refuses(502, "bad gateway"))
    assert generator().from_text(PROMPT).glb == GLB
    assert waits[:3] == [7.0, 2.0, 1.0]
    assert len(model_server.tasks) == 2


def test_a_result_that_is_too_large_or_no_model_is_not_used(model_server, generator, monkeypatch) -> None:
    model_server.model = b"glTF" + bytes(200)
    with pytest.raises(ModelError, match="not a complete GLB"):
        generator().from_text(PROMPT)
    model_server.model = b"<html>"
    with pytest.raises(ModelError, match="not a complete GLB"):
        generator().from_text(PROMPT)
    monkeypatch.setattr("anymesh.finishing.meshy_api.LARGEST", 1000)
    model_server.model = b"glTF" + bytes(200_000)
    with pytest.raises(ModelError, match="larger than 1000 bytes"):
        generator().from_text(PROMPT)
    model_server.model = GLB
    assert generator(max_calls=0).from_text(PROMPT).glb == GLB
    assert model_server.count("create") == 2


def test_progress_is_told_by_kind(model_server, generator) -> None:
    seen = []
    generator(watch=lambda kind, task: seen.append((kind.type, task.status))).from_text(PROMPT)
    states = ["PENDING", "IN_PROGRESS", "SUCCEEDED"]
    assert seen == [(kind, s) for kind in ("text-to-3d-preview", "text-to-3d-refine") for s in states]


def test_key_and_signed_addresses_stay_inside(model_server, generator, caplog, tmp_path) -> None:
    caplog.set_level(logging.DEBUG)
    model_server.fails("file", *[refuses(500)] * 5)
    with pytest.raises(ModelError) as lost:
        generator().from_text(PROMPT)
    told = [repr(generator()), str(lost.value), caplog.text, *(p.read_text() for p in tmp_path.iterdir())]
    assert len(told) > 4
    for secret in (KEY, SIGNATURE):
        assert not [text for text in told if secret in text]
