"""A paid task is made once, whatever happens on the way; what comes back is checked; the key and addresses stay inside."""

import base64
import io
import json
import logging
import traceback
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from assets import cabinet
from meshy_wire import KEY, SIGNATURE, MeshyServer, cuts, refuses, says, serving
from PIL import Image

from anymesh.errors import AnymeshError, BudgetError, ModelError, OptionError
from anymesh.finishing.bake import png
from anymesh.finishing.meshy import Meshy
from anymesh.finishing.protocol import Finished
from anymesh.finishing.retexture import Remote
from anymesh.finishing.scene_glb import scene_glb
from anymesh.finishing.texture import Retexturer
from anymesh.formats.gltf.scene import read_gltf
from anymesh.loading.files import Folder
from anymesh.rendering.render import face_colors
from anymesh.types import Material, Texture

GLB = b"glTF" + (2).to_bytes(4, "little") + (20).to_bytes(4, "little") + b"12345678"
SENT = "data:application/octet-stream;base64," + base64.b64encode(GLB).decode()


@pytest.fixture
def server(monkeypatch: pytest.MonkeyPatch, loopback_only: None) -> Iterator[MeshyServer]:
    with serving(MeshyServer(), monkeypatch) as found:
        yield found


@pytest.fixture
def waits() -> list[float]:
    return []


@pytest.fixture
def meshy(tmp_path: Path, waits: list[float]):
    def make(**options) -> Meshy:
        return Meshy(tmp_path / "task.json", sleep=waits.append, chance=lambda: 0.0, **{"timeout": 4.0, **options})

    return make


def state(client: Meshy) -> dict:
    return json.loads(client.state.read_text())


def test_a_task_is_created_waited_for_and_fetched(server, meshy, waits) -> None:
    client = meshy()
    assert client.retexture(GLB, " oak and steel ") == GLB
    assert server.asked == ["create", "look", "look", "look", "look", "file"]
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


@pytest.mark.parametrize("fault", [cuts, refuses(502, "bad gateway"), lambda handler: says(handler, {"result": ""})])
def test_a_creation_whose_answer_is_lost_is_not_repeated(server, meshy, fault) -> None:
    server.fails("create", fault)
    client = meshy()
    with pytest.raises(ModelError, match=r"may have been made and paid: look at your account .* write its id as \"task\" into"):
        client.retexture(GLB, "oak")
    assert server.count("create") == 1
    task = server.create({"model_url": SENT, "text_style_prompt": "oak"})  # as the user finds it
    client.state.write_text(json.dumps({**state(client), "task": task}))
    assert meshy(max_calls=0).retexture(GLB, "oak") == GLB


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


@pytest.mark.parametrize(
    ("status", "told"),
    [
        (400, "HTTP 400, it says: Invalid model"),
        (401, "the key in MESHY_API_KEY is missing or refused"),
        (402, "it says: Invalid model; the account has too few credits, a retexture takes about 10"),
    ],
)
def test_a_refusal_is_told_once(server, meshy, status, told) -> None:
    server.fails("create", refuses(status, "Invalid model"))
    with pytest.raises(ModelError, match=told):
        meshy().retexture(GLB, "oak")
    assert server.count("create") == 1


def test_the_budget_refuses_before_anything_is_paid(server, meshy) -> None:
    with pytest.raises(BudgetError, match=r"about 10 credits and would exceed --max-calls 0; spent so far: 0 tasks"):
        meshy(max_calls=0).retexture(GLB, "oak")
    assert server.asked == []


def test_what_cannot_be_asked_is_refused_at_home(server, meshy, monkeypatch) -> None:
    for prompt in ("", "  ", "x" * 601):
        with pytest.raises(OptionError, match="1 to 600 characters"):
            meshy().retexture(GLB, prompt)
    with pytest.raises(OptionError, match="--max-calls must be 0 or more, found -1"):
        meshy(max_calls=-1)
    monkeypatch.setattr("anymesh.finishing.meshy.LARGEST_MODEL", 50)
    with pytest.raises(ModelError, match="at most 50 are accepted"):
        meshy().retexture(GLB, "oak")
    monkeypatch.delenv("MESHY_API_KEY")
    with pytest.raises(ModelError, match="no key for meshy: set the environment variable MESHY_API_KEY"):
        meshy().retexture(GLB, "oak")
    assert server.asked == []


def test_the_key_goes_nowhere_without_encryption(server, meshy, monkeypatch) -> None:
    monkeypatch.setenv("MESHY_BASE_URL", "http://meshy.example")
    with pytest.raises(ModelError, match="must be https"):
        meshy().retexture(GLB, "oak")


def test_a_redirect_does_not_take_the_key_along(server, meshy) -> None:
    server.fails("create", lambda handler: says(handler, {}, 307, location=f"{server.url}/elsewhere"))
    with pytest.raises(ModelError, match="HTTP 307"):
        meshy().retexture(GLB, "oak")
    assert server.asked == ["create"]


def test_a_state_that_cannot_be_kept_buys_nothing(server, tmp_path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(AnymeshError, match="cannot be kept"):
        Meshy(tmp_path / "file" / "task.json").retexture(GLB, "oak")
    assert server.tasks == {}


def test_a_broken_state_is_none(server, meshy) -> None:
    client = meshy()
    for text in ("{", "[]", '{"request": "other", "task": "t"}'):
        client.state.write_text(text)
        client.retexture(GLB, text)
    assert server.count("create") == 3


def test_key_and_signed_addresses_are_in_no_message_log_file_or_repr(server, meshy, caplog, tmp_path) -> None:
    caplog.set_level(logging.DEBUG)
    server.fails("create", refuses(429, f"slow down, {KEY}"), refuses(400, f"no, {KEY} {'a' * 80}"))
    client = meshy()
    with pytest.raises(ModelError) as refused:
        client.retexture(GLB, "oak")
    server.fails("file", *[refuses(500)] * 5)
    with pytest.raises(ModelError) as lost:
        client.retexture(GLB, "oak")
    server.fails("look", refuses(401, KEY))
    with pytest.raises(ModelError) as rejected:
        client.retexture(GLB, "oak")
    told = [repr(client), caplog.text, *(p.read_text() for p in tmp_path.iterdir())]
    for error in (refused, lost, rejected):
        told += [*traceback.format_exception(error.value), repr(error.value.__context__), repr(error.value.__cause__)]
    assert "[removed]" in "".join(told)
    for secret in (KEY, SIGNATURE, "a" * 80):
        assert not [text for text in told if secret in text]


def test_the_whole_road_to_an_asset_with_new_looks(server, meshy) -> None:
    """Over the wire and back: the atlas that was sent, painted blue."""

    def blue(glb: bytes) -> bytes:
        sent = read_gltf(glb, Folder(Path("sent.glb")))
        with Image.open(io.BytesIO(sent.materials[0].textures["base_color"].data)) as image:
            assert image.size == (128, 128)
        picture = Texture(png(np.full((8, 8, 3), (10, 20, 200), np.uint8)), "image/png")
        material = Material("blue", (1.0, 1.0, 1.0, 1.0), textures={"base_color": picture})
        return scene_glb({"made": replace(sent, materials=(material,))}, np.eye(4))

    server.texture = blue
    asset = cabinet()
    looks = Remote(meshy(), "blue paint", size=128, padding=1)
    assert isinstance(looks, Retexturer)
    found = looks.retexture(Finished(asset, np.arange(len(asset.mesh.faces))))
    assert found.notes[-1] == "meshy: its pictures are used"
    assert (face_colors(found.asset.mesh) == (10, 20, 200)).all()
    assert [task["text_style_prompt"] for task in server.tasks.values()] == ["blue paint"]
