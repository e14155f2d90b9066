"""Paid tasks of generation are made once, whatever happens on the way; requests are those that the service's pages describe."""

import json
from collections.abc import Iterator
from pathlib import Path

import pytest
from meshy_wire import IMAGE, TEXT, MeshyServer, refuses, says, serving

from anymesh.applications.generate.meshy import Meshy3D
from anymesh.errors import BudgetError, InputError, ModelError, OptionError
from anymesh.finishing.meshy_api import PREVIEW, REFINE

GLB = b"glTF" + (2).to_bytes(4, "little") + (20).to_bytes(4, "little") + b"12345678"
PROMPT = "a retro fridge"
PNG = b"\x89PNG\r\n\x1a\n" + b"picture"


@pytest.fixture
def waits() -> list[float]:
    return []


@pytest.fixture
def model_server(monkeypatch: pytest.MonkeyPatch, loopback_only: None) -> Iterator[MeshyServer]:
    with serving(MeshyServer(model=GLB), monkeypatch) as found:
        yield found


@pytest.fixture
def generator(tmp_path: Path, waits: list[float]):
    def make(**options) -> Meshy3D:
        return Meshy3D(tmp_path / "meshy.json", sleep=waits.append, chance=lambda: 0.0, **{"timeout": 4.0, **options})

    return make


def bodies(model_server: MeshyServer) -> list[dict]:
    extra = {"path", "looked", "made", "type", "credits", "seed", "sent"}
    return [{k: v for k, v in task.items() if k not in extra} for task in model_server.tasks.values()]


@pytest.fixture
def picture(tmp_path: Path) -> Path:
    path = tmp_path / "fridge.png"
    path.write_bytes(PNG)
    return path


def test_text_is_previewed_refined_and_fetched(model_server, generator, waits) -> None:
    client = generator(faces=5000)
    found = client.from_text(f"  {PROMPT} ")
    assert found.glb == GLB
    sized = {"auto_size": True, "origin_at": "bottom"}
    shape = {"should_remesh": True, "topology": "triangle", "target_polycount": 5000, "target_formats": ["glb"]}
    [preview, refined] = model_server.tasks
    assert bodies(model_server) == [
        {"mode": "preview", "prompt": PROMPT, "ai_model": "latest", **shape},
        {
            "mode": "refine",
            "preview_task_id": preview,
            "enable_pbr": True,
            "target_formats": ["glb"],
            **sized,
            "prompt": PROMPT,
        },
    ]
    assert {task["path"] for task in model_server.tasks.values()} == {TEXT}
    assert [(kind, b.task, b.credits, b.seed) for kind, b in found.tasks] == [
        (PREVIEW, preview, 20, 7),
        (REFINE, refined, 10, 7),
    ]
    assert (client.calls, client.credits) == (2, 30)
    assert waits == [2.0, 2.6, 2.0, 2.6]
    looks = ["create", "look", "look", "look"]
    assert model_server.asked == [*looks, *looks, "look", "file"]


def test_a_shape_alone_is_the_preview_in_the_size_that_the_service_estimates(model_server, generator) -> None:
    client = generator(textured=False)
    assert client.from_text(PROMPT).glb == GLB
    [body] = bodies(model_server)
    assert body["mode"] == "preview"
    assert body["auto_size"] is True
    assert (client.calls, client.credits) == (1, 20)


def test_a_picture_goes_as_a_data_uri(model_server, generator, picture) -> None:
    client = generator()
    found = client.from_image(picture, "white enamel")
    assert found.glb == GLB
    [task] = model_server.tasks.values()
    assert task["path"] == IMAGE
    assert task["sent"] == PNG
    assert {k: task[k] for k in ("should_texture", "enable_pbr", "texture_prompt", "auto_size")} == {
        "should_texture": True,
        "enable_pbr": True,
        "texture_prompt": "white enamel",
        "auto_size": True,
    }
    assert client.credits == 30
    jpeg = picture.with_suffix(".jpg")
    jpeg.write_bytes(b"\xff\xd8\xff\xe0 picture")
    assert generator(textured=False).from_image(jpeg).tasks[0][1].credits == 20


def test_pictures_that_the_service_does_not_take_are_refused_at_home(model_server, generator, tmp_path, monkeypatch) -> None:
    path = tmp_path / "fridge.png"
    with pytest.raises(InputError, match="cannot read the picture"):
        generator().from_image(path)
    path.write_bytes(b"GIF89a")
    with pytest.raises(InputError, match=r"neither PNG nor JPEG: it starts with b'GIF89a'"):
        generator().from_image(path)
    path.write_bytes(PNG)
    monkeypatch.setattr("anymesh.applications.generate.meshy.LARGEST_IMAGE", 10)
    with pytest.raises(InputError, match="has 15 bytes; meshy takes at most 10"):
        generator().from_image(path)
    for prompt in (" ", "x" * 801):
        with pytest.raises(OptionError, match="1 to 800 characters"):
            generator().from_text(prompt)
    assert model_server.asked == []


def test_a_rerun_fetches_what_is_paid_and_tells_all_of_its_cost(model_server, generator) -> None:
    generator().from_text(PROMPT)
    again = generator(max_calls=0)
    found = again.from_text(PROMPT)
    assert found.glb == GLB
    assert [bought.credits for _, bought in found.tasks] == [20, 10]
    assert (again.calls, again.credits) == (0, 0)
    assert model_server.count("create") == 2


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


def test_progress_is_told_by_kind(model_server, generator) -> None:
    seen = []
    generator(watch=lambda kind, task: seen.append((kind.type, task.status))).from_text(PROMPT)
    states = ["PENDING", "IN_PROGRESS", "SUCCEEDED"]
    assert seen == [(kind, s) for kind in ("text-to-3d-preview", "text-to-3d-refine") for s in states]
