"""A paid task is made once, whatever happens on the way; what comes back is checked; the key and addresses stay inside."""

import json

import pytest
from meshy_tasks import GLB, SENT, state
from meshy_wire import cuts, refuses, says

from anymesh.errors import ModelError


def test_a_task_is_created_waited_for_and_fetched(server, meshy, waits) -> None:
    client = meshy()
    assert client.retexture(GLB, " oak and steel ") == GLB
    assert server.asked == ["list", "create", "look", "look", "look", "look", "file"]
    [task] = server.tasks.values()
    assert task["glb"] == GLB
    assert {k: task[k] for k in ("text_style_prompt", "enable_original_uv", "enable_pbr", "ai_model")} == {
        "text_style_prompt": "oak and steel",
        "enable_original_uv": True,
        "enable_pbr": True,
        "ai_model": "latest",
    }
    assert (client.calls, client.credits) == (1, 10)
    assert waits == [2.0, 2.6]  # between looks, ever longer


def test_a_rerun_takes_the_result_that_is_paid(server, meshy) -> None:
    meshy().retexture(GLB, "oak")
    again = meshy(max_calls=0)
    assert again.retexture(GLB, "oak") == GLB
    assert (again.calls, again.credits) == (0, 0)
    assert server.count("create") == 1
    meshy().retexture(GLB, "steel")
    assert server.count("create") == 2


def test_a_kill_between_creation_and_waiting_costs_nothing(server, meshy) -> None:
    def killed(seconds: float) -> None:
        raise KeyboardInterrupt

    client = meshy()
    client.sleep = killed
    with pytest.raises(KeyboardInterrupt):
        client.retexture(GLB, "oak")
    assert state(client)["task"] == next(iter(server.tasks))
    assert meshy(max_calls=0).retexture(GLB, "oak") == GLB
    assert server.count("create") == 1


def test_a_kill_before_the_id_arrived_costs_nothing(server, meshy, monkeypatch) -> None:
    def dies(*_: object) -> str:
        server.create({"model_url": SENT, "text_style_prompt": "oak"})
        raise KeyboardInterrupt

    server.create({"model_url": SENT, "text_style_prompt": "oak"})  # of another day
    with monkeypatch.context() as patched:
        patched.setattr("anymesh.finishing.meshy.create_task", dies)
        with pytest.raises(KeyboardInterrupt):
            meshy().retexture(GLB, "oak")
    meshy().retexture(GLB, "oak")
    assert server.count("create") == 0
    assert [t["looked"] > 0 for t in server.tasks.values()] == [False, True]


def test_an_answer_to_creation_that_is_lost_is_looked_up_instead_of_paid_again(server, meshy) -> None:
    def made_and_silent(handler) -> None:
        server.create(json.loads(handler.content))
        cuts(handler)

    server.fails("create", made_and_silent)
    assert meshy().retexture(GLB, "oak") == GLB
    assert server.count("create") == 1


def test_a_gateway_that_fails_before_the_task_is_made_is_asked_again(server, meshy, waits) -> None:
    server.create({"model_url": "data:application/octet-stream;base64,", "text_style_prompt": "oak"})  # of another object
    server.fails("create", refuses(502, "bad gateway"), refuses(500, "oops"))
    assert meshy().retexture(GLB, "oak") == GLB
    assert server.count("create") == 3
    assert len(server.tasks) == 2
    assert waits[:2] == [1.0, 2.0]


def test_where_tasks_cannot_be_listed_a_lost_answer_is_an_error_and_not_a_second_task(server, meshy) -> None:
    server.fails("list", refuses(404), refuses(404))
    server.fails("create", cuts)
    with pytest.raises(ModelError, match="may have been made and paid"):
        meshy().retexture(GLB, "oak")
    assert server.count("create") == 1


def test_too_many_requests_are_waited_for_as_asked(server, meshy, waits) -> None:
    server.fails("create", refuses(429, "slow down", retry_after="7"))
    server.fails("look", refuses(429), refuses(500, "oops"))
    assert meshy().retexture(GLB, "oak") == GLB
    assert waits[:3] == [7.0, 1.0, 2.0]
    assert len(server.tasks) == 1


def test_a_service_that_stays_down_is_given_up(server, meshy) -> None:
    server.fails("create", *[refuses(503, "maintenance")] * 9)
    with pytest.raises(ModelError, match=r"HTTP 503, it says: maintenance; gave up after 5 attempts"):
        meshy().retexture(GLB, "oak")
    assert server.tasks == {}


def test_a_wait_that_is_too_long_is_not_waited(server, meshy, waits) -> None:
    server.fails("create", refuses(429, "slow down", retry_after="3600"))
    with pytest.raises(ModelError, match="asks to wait 3600 s, which is longer than 120 s"):
        meshy().retexture(GLB, "oak")
    assert waits == []


def test_silence_ends_in_time(server, meshy) -> None:
    server.fails("look", *[lambda handler: server.over.wait(10)] * 5)
    with pytest.raises(ModelError, match=r"no answer within 0\.1 s; gave up after 5 attempts"):
        meshy(timeout=0.1).retexture(GLB, "oak")


def test_a_trickle_ends_in_time(server, meshy) -> None:
    def trickles(handler) -> None:
        handler.wfile.write(b"HTTP/1.1 200 OK\r\ncontent-length: 100000\r\n\r\n")
        while not server.over.wait(0.02):
            try:
                handler.wfile.write(b" " * 10)
            except OSError:
                return

    server.fails("look", *[trickles] * 5)
    with pytest.raises(ModelError, match=r"within 0\.1 s"):
        meshy(timeout=0.1).retexture(GLB, "oak")


@pytest.mark.parametrize("status", ["FAILED", "EXPIRED", "CANCELED"])
def test_a_task_that_failed_says_why_and_is_forgotten(server, meshy, status) -> None:
    server.last = {"status": status, "task_error": {"message": "The model has no faces"}}
    with pytest.raises(ModelError, match=rf"is {status}, it says: The model has no faces; a rerun makes a new one"):
        meshy().retexture(GLB, "oak")
    server.last = {"status": "SUCCEEDED"}
    meshy().retexture(GLB, "oak")
    assert len(server.tasks) == 2


def test_a_task_that_is_gone_is_forgotten(server, meshy) -> None:
    client = meshy()
    client.retexture(GLB, "oak")
    server.tasks.clear()
    with pytest.raises(ModelError, match=r"no longer has task"):
        meshy().retexture(GLB, "oak")
    assert not client.state.exists()


def test_a_task_that_takes_too_long_is_kept_for_the_rerun(server, meshy) -> None:
    server.last = {"status": "IN_PROGRESS"}
    client = meshy(patience=1e-9)
    with pytest.raises(ModelError, match=r"is still .* a rerun resumes it"):
        client.retexture(GLB, "oak")
    assert state(client)["task"] in server.tasks


def test_a_truncated_download_is_fetched_again(server, meshy) -> None:
    server.fails("file", cuts, refuses(403, "expired"))
    assert meshy().retexture(GLB, "oak") == GLB
    assert server.count("file") == 3


@pytest.mark.parametrize(
    ("content", "kind", "told"),
    [
        (b"<html>login</html>", "text/html", "content of type 'text/html', valid is a GLB"),
        (b"{}", "application/json", "content of type 'application/json'"),
        (b"not a model", "application/octet-stream", "not a complete GLB"),
        (GLB[:-3], "model/gltf-binary", "not a complete GLB: 17 bytes"),
    ],
)
def test_another_content_is_refused(server, meshy, content, kind, told) -> None:
    server.fails("file", lambda handler: says(handler, content, kind=kind))
    with pytest.raises(ModelError, match=told):
        meshy().retexture(GLB, "oak")


def test_a_result_that_is_too_large_is_not_read(server, meshy, monkeypatch) -> None:
    monkeypatch.setattr("anymesh.finishing.meshy_api.LARGEST", 1000)
    server.texture = lambda glb: b"glTF" + bytes(200_000)
    with pytest.raises(ModelError, match="larger than 1000 bytes"):
        meshy().retexture(GLB, "oak")


@pytest.mark.parametrize("url", ["file:///etc/hostname", "http://203.0.113.5/model.glb", "ftp://127.0.0.1/m.glb", 7, None])
def test_an_address_of_a_result_that_is_no_web_page_is_not_opened(server, meshy, url) -> None:
    server.last = {"status": "SUCCEEDED", "model_urls": {"glb": url}}
    with pytest.raises(ModelError, match=r"must be https|without a GLB"):
        meshy().retexture(GLB, "oak")
