"""Every page in a real browser at 1280 and 1920 pixels: nothing is cut or overlaps, no slider is covered, and pictures of all.

    pytest -m "slow or not slow" tests/viewer/test_pages.py     (pictures in out/pages, or in $ANYMESH_SCREENSHOTS)

Needs the extra `view`, playwright and a Chromium (see browser.py); skipped where one is missing. The empty page is looked at in
each run of the tests, the others where slow tests run.
"""

from __future__ import annotations

import base64
import io
import json
from dataclasses import replace

import numpy as np
import pytest
from asked_cabinet import MESH, questions
from assets import cabinet
from correctable import write_output
from fake_bench import FakeWork, asking, put, until
from layout import FOLDER, close_notices, look
from PIL import Image
from shown import folder_of

from anymesh.correcting import FlipSign
from anymesh.viewer.intake import bench_
from anymesh.viewer.intake.work import StageState
from anymesh.viewer.pictures_ import write_picture
from anymesh.viewer.report import write_report
from anymesh.viewer.server_ import serve

pytest.importorskip("viser", reason="needs the extra view")
NOW = "2024-05-01T12:00:00+00:00"
DROP = """async ([names, data, folder]) => {
  const transfer = new DataTransfer();
  names.forEach((name, k) => transfer.items.add(new File([Uint8Array.from(atob(data[k]), c => c.charCodeAt(0))], name)));
  document.body.dispatchEvent(new DragEvent('drop', {bubbles: true, cancelable: true, dataTransfer: transfer}));
}"""


@pytest.fixture
def page(monkeypatch, tab):
    """A page that accepts meshes, with work that the test controls, in a tab."""
    monkeypatch.setattr(bench_, "ArticulationWork", FakeWork)
    monkeypatch.setattr(bench_, "warm_pool", lambda: None)
    FakeWork.made = []
    with serve(None, port=8700, author="Ada", clock=lambda: NOW) as serving:
        open_(tab, serving)
        tab.page.get_by_text("Drop a mesh here").wait_for()
        tab.until("window.anymeshDrop === true")
        yield serving.page


def open_(tab, serving) -> None:
    tab.page.set_default_timeout(120_000)
    tab.open(serving.url)
    tab.page.wait_for_selector("canvas")
    tab.page.wait_for_timeout(500)
    close_notices(tab)


def drop(tab, files: dict[str, bytes]) -> None:
    """Drop several files together."""
    tab.page.evaluate(DROP, [list(files), [base64.b64encode(content).decode() for content in files.values()], ""])


def test_the_empty_page_is_in_order(page, tab):
    look(tab, "1_empty", colors=20)
    assert tab.page.title() == "Articulate AnyMesh"


def triangle_in_three_files() -> dict[str, bytes]:
    """A glTF of one textured triangle, with its buffer and its picture beside it."""
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], "<f4")
    uv, faces = corners[:, :2].copy(), np.array([0, 1, 2, 0, 1, 3, 0, 2, 3, 1, 2, 3], "<u2")
    data = corners.tobytes() + uv.tobytes() + faces.tobytes()
    sink = io.BytesIO()
    Image.new("RGB", (4, 4), (200, 30, 30)).save(sink, "PNG")
    views = [(0, 48), (48, 32), (80, 24)]
    described = {
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2, "material": 0}]}],
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        "textures": [{"source": 0}],
        "images": [{"uri": "rot.png"}],
        "buffers": [{"uri": "mesh.bin", "byteLength": len(data)}],
        "bufferViews": [{"buffer": 0, "byteOffset": at, "byteLength": size} for at, size in views],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 1]},
            {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2"},
            {"bufferView": 2, "componentType": 5123, "count": 12, "type": "SCALAR"},
        ],
    }
    return {"mesh.gltf": json.dumps(described).encode(), "mesh.bin": data, "rot.png": sink.getvalue()}


@pytest.mark.slow
def test_files_that_are_dropped_together_arrive_together(page, tab):
    files = triangle_in_three_files()
    drop(tab, files)
    until(lambda: FakeWork.made, 60)
    mesh = FakeWork.made[0].asked_mesh
    assert mesh.name == "mesh.gltf"
    assert {p.name: p.read_bytes() for p in mesh.parent.iterdir()} == files
    assert FakeWork.made[0].options["root"] == mesh.parent
    page.act(page.bench.cancel)
    tab.page.get_by_text("was cancelled").wait_for()
    tab.until("document.querySelector('input[type=file]')?.multiple")  # several may be chosen, too
    obj = {"box.obj": b"mtllib box.mtl\nv 0 0 0\n", "box.mtl": b"newmtl red\n"}
    tab.page.locator("input[type=file]").set_input_files(
        [{"name": name, "mimeType": "", "buffer": content} for name, content in obj.items()]
    )
    until(lambda: len(FakeWork.made) == 2, 60)
    assert {p.name: p.read_bytes() for p in FakeWork.made[1].asked_mesh.parent.iterdir()} == obj


@pytest.mark.slow
def test_an_example_is_clicked_watched_cancelled_and_finished(page, tab):
    tab.page.locator(".anymesh-example[title=stove]").click()
    until(lambda: FakeWork.made, 60)
    work = FakeWork.made[0]
    work.stages += [StageState("finding how they move", None, False), StageState("writing the files", None, False)]
    work.mesh = MESH
    until(lambda: page.bench._desk.mesh is MESH)
    tab.page.get_by_text("finding the parts").wait_for()
    look(tab, "2_working")
    tab.page.get_by_role("button", name="Cancel").click()
    tab.page.get_by_role("button", name="Start again").wait_for()
    look(tab, "3_cancelled")
    tab.page.get_by_role("button", name="Start again").click()
    until(lambda: len(FakeWork.made) == 2)
    FakeWork.made[1].finish()
    until(lambda: page.session is not None, 60)
    tab.page.get_by_text("All to rest").wait_for()
    look(tab, "4_asset")


@pytest.mark.slow
def test_every_kind_of_question_is_in_order_and_back_returns_to_it(page, tab):
    folder, desk = asking(page), page.bench._desk
    for number, kind in enumerate(questions()):
        put(folder, kind)
        until(lambda: desk.busy and desk._asked._suggested, 60)
        tab.page.get_by_role("button", name="Answer").wait_for()
        look(tab, f"5_question_{number}_{kind}")
        tab.page.get_by_role("button", name="Answer").click()
        until(lambda: not desk.busy)
    last = desk._given[-1][0].path
    tab.page.get_by_role("button", name="Back to the last question").click()
    until(lambda: desk.busy and desk._asked.folder.path == last)
    tab.page.get_by_text("as you answered before").wait_for()
    look(tab, "5_question_8_back")


@pytest.mark.slow
def test_an_asset_and_its_correction_are_in_order_and_no_tooltip_covers_a_slider(tmp_path, tab):
    with serve(write_output(tmp_path / "cabinet"), port=8720, author="Ada", clock=lambda: NOW) as serving:
        open_(tab, serving)
        tab.page.get_by_text("All to rest").wait_for()
        look(tab, "6_play")
        for control in tab.page.locator(".mantine-Slider-root, label, button").all():
            if not control.is_visible():
                continue
            control.hover(force=True)
            tab.page.wait_for_timeout(600)  # until a tooltip appears
            tips = [t.bounding_box() for t in tab.page.locator("[role=tooltip]").all() if t.is_visible()]
            sliders = [s.bounding_box() for s in tab.page.locator(".mantine-Slider-root").all() if s.is_visible()]
            assert not [(t, s) for t in tips for s in sliders if t and s and overlap(t, s)], control.inner_text()
        tab.page.mouse.move(300, 600)
        serving.page.act(lambda: (serving.page.select("door"), serving.page.correct(FlipSign("door"))))
        tab.page.get_by_role("tab", name="Correct").click()
        tab.page.get_by_text("1 correction not saved").wait_for()
        look(tab, "7_correct")
        tab.page.get_by_role("button", name="Save").click()
        tab.page.get_by_text("Saved at 12:00").wait_for()
        tab.page.wait_for_timeout(300)
        look(tab, "8_saved")


def overlap(a: dict, b: dict) -> bool:
    return all(a[at] < b[at] + b[size] and b[at] < a[at] + a[size] for at, size in (("x", "width"), ("y", "height")))


@pytest.mark.slow
def test_review_report_and_contact_sheet_are_in_order(tmp_path, tab):
    many = tmp_path / "many"
    for name in ("cabinet", "chest"):
        folder_of(replace(cabinet(), name=name), tmp_path / "shown" / name)
        write_output(many / name)
    with serve(many, port=8740, author="Ada", clock=lambda: NOW) as serving:
        open_(tab, serving)
        tab.page.get_by_text("0 of 2 decided").wait_for()
        look(tab, "9_review")
    tab.open(write_report(tmp_path / "shown", tmp_path / "report.html").path)
    tab.page.wait_for_timeout(500)
    look(tab, "10_report", colors=20)
    FOLDER.mkdir(parents=True, exist_ok=True)
    with Image.open(write_picture(tmp_path / "shown", FOLDER / "11_contact_sheet.png")) as sheet:
        assert min(sheet.size) > 100
