"""Test what a retexturing task refuses or hides: wrong requests, keys, redirects, and secrets in messages."""

import io
import logging
import traceback
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from assets import cabinet
from meshy_tasks import GLB
from meshy_wire import KEY, SIGNATURE, refuses, says
from PIL import Image

from anymesh.errors import AnymeshError, BudgetError, ModelError, OptionError
from anymesh.finishing.bake import png
from anymesh.finishing.meshy import Meshy
from anymesh.finishing.protocol import Finished
from anymesh.finishing.retexture import Remote
from anymesh.finishing.scene_glb import scene_glb
from anymesh.finishing.texture import Retexturer
from anymesh.loading.files import Folder
from anymesh.loading.gltf import read_gltf
from anymesh.rendering.render import face_colors
from anymesh.types import Material, Texture


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


def test_a_wrong_key_is_refused_before_anything_is_made(server, meshy, monkeypatch) -> None:
    monkeypatch.setenv("MESHY_API_KEY", "msy_wrong")
    with pytest.raises(ModelError, match="the key in MESHY_API_KEY is missing or refused"):
        meshy().retexture(GLB, "oak")
    assert server.asked == ["list"]


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
    server.fails("list", lambda handler: says(handler, {}, 302, location=f"{server.url}/elsewhere"))
    server.fails("create", lambda handler: says(handler, {}, 307, location=f"{server.url}/elsewhere"))
    with pytest.raises(ModelError, match="HTTP 307"):
        meshy().retexture(GLB, "oak")
    assert server.asked == ["list", "create"]


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
