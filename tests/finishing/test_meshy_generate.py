"""Paid tasks of generation are made once, whatever happens on the way; requests are those that the service's pages describe."""

import json
from pathlib import Path

import pytest
from meshy_generation import GLB, PNG, PROMPT, bodies
from meshy_wire import IMAGE, TEXT, cuts

from anymesh.errors import InputError, ModelError, OptionError
from anymesh.finishing.meshy_api import PREVIEW, REFINE


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
    assert model_server.asked == [
        "list",
        "create",
        "look",
        "look",
        "look",
        "list",
        "create",
        "look",
        "look",
        "look",
        "look",
        "file",
    ]


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


@pytest.mark.parametrize("looks", [1, 4], ids=["while the preview runs", "while the refinement runs"])
def test_a_kill_costs_nothing(model_server, generator, waits, looks) -> None:
    client = generator()

    def sleep(seconds: float) -> None:
        waits.append(seconds)
        if len(waits) == min(looks, 3):
            raise KeyboardInterrupt

    client.sleep = sleep
    with pytest.raises(KeyboardInterrupt):
        client.from_text(PROMPT)
    found = generator(max_calls=1 if looks == 1 else 0).from_text(PROMPT)
    assert found.glb == GLB
    assert model_server.count("create") == 2
    assert sum(bought.credits for _, bought in found.tasks) == 30


def test_a_kill_before_the_id_of_a_refinement_arrived_costs_nothing(model_server, generator, monkeypatch) -> None:
    from anymesh.finishing import meshy as meshy_paid

    real = meshy_paid.create_task

    def dies_at_the_second(kind, body: bytes, timeout: float) -> str:
        if kind is REFINE:
            model_server.create(json.loads(body), kind.path)
            raise KeyboardInterrupt
        return real(kind, body, timeout)

    with monkeypatch.context() as patched:
        patched.setattr(meshy_paid, "create_task", dies_at_the_second)
        with pytest.raises(KeyboardInterrupt):
            generator().from_text(PROMPT)
    assert generator(max_calls=0).from_text(PROMPT).glb == GLB
    assert len(model_server.tasks) == 2


def test_a_picture_s_task_whose_id_is_lost_is_found_by_when_it_was_made(model_server, generator, picture) -> None:
    def made_and_silent(handler) -> None:
        model_server.create(json.loads(handler.content), IMAGE)
        cuts(handler)

    model_server.fails("create", made_and_silent)
    assert generator().from_image(picture).glb == GLB
    assert model_server.count("create") == 1


def test_tasks_of_others_are_not_taken_for_a_lost_one(model_server, generator, picture) -> None:
    def of_somebody_else(seconds: float):
        def fault(handler) -> None:
            model_server.clock = seconds
            model_server.create(json.loads(handler.content), IMAGE)
            model_server.clock = 0.0
            cuts(handler)

        return fault

    model_server.fails("create", of_somebody_else(-7200.0))
    assert generator().from_image(picture).glb == GLB
    assert [task["looked"] > 0 for task in model_server.tasks.values()] == [False, True]


def test_tasks_that_cannot_be_told_apart_are_not_paid_again(model_server, generator, picture) -> None:
    def two_at_once(handler) -> None:
        for _ in range(2):
            model_server.create(json.loads(handler.content), IMAGE)
        cuts(handler)

    model_server.fails("create", two_at_once)
    client = generator()
    with pytest.raises(ModelError, match="cannot be told apart; write its id"):
        client.from_image(picture)
    assert model_server.count("create") == 1
    [state] = client.state.parent.glob("meshy-image.json")
    state.write_text(json.dumps({**json.loads(state.read_text()), "task": next(iter(model_server.tasks))}))
    assert generator(max_calls=0).from_image(picture).glb == GLB  # as the message advises
