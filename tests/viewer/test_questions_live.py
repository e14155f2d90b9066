"""The page that takes meshes, in a real browser: a mesh is dropped, played and downloaded; questions are answered by clicks.

    pytest -m slow tests/viewer/test_questions_live.py

Needs the extra `view`, playwright and a Chromium (see browser.py); skipped where one is missing.
"""

import io
import json
import time
import xml.etree.ElementTree as ET
import zipfile
from pathlib import Path

import numpy as np
import pytest
from browser import Tab

from anymesh import pipeline
from anymesh.types import JointType
from anymesh.viewer.questions.scene_ import point_places
from anymesh.viewer.server_ import serve

pytest.importorskip("viser", reason="needs the extra view")
pytestmark = pytest.mark.slow
MESHES = Path(__file__).parents[2] / "examples" / "meshes"
DROP = """async ([name, data]) => {
  const bytes = Uint8Array.from(atob(data), c => c.charCodeAt(0));
  const transfer = new DataTransfer();
  transfer.items.add(new File([bytes], name));
  for (const kind of ['dragover', 'drop'])
    document.querySelector('canvas').dispatchEvent(
      new DragEvent(kind, {bubbles: true, cancelable: true, dataTransfer: transfer}));
}"""
BIG = """async (size) => {
  const transfer = new DataTransfer();
  transfer.items.add(new File([new Uint8Array(size)], 'big.glb'));
  document.body.dispatchEvent(new DragEvent('drop', {bubbles: true, cancelable: true, dataTransfer: transfer}));
}"""


def until(what, seconds: float = 60):
    end = time.monotonic() + seconds
    while not what():
        assert time.monotonic() < end, "it did not happen"
        time.sleep(0.1)


@pytest.fixture
def taking(tab):
    with serve(None, port=8500, author="Ada", clock=lambda: "2024-05-01T12:00:00+00:00") as serving:
        tab.open(serving.url)
        tab.page.get_by_text("Drop a mesh here").wait_for()
        tab.until("window.anymeshDrop === true")
        yield serving, tab


def drop(tab: Tab, name: str, content: bytes) -> None:
    import base64

    tab.page.evaluate(DROP, [name, base64.b64encode(content).decode()])


def text(tab: Tab) -> str:
    return tab.page.inner_text("body")


def zipped(path: Path) -> bytes:
    sink = io.BytesIO()
    with zipfile.ZipFile(sink, "w") as archive:
        archive.write(path, f"inside/{path.name}")
    return sink.getvalue()


def test_a_mesh_is_dropped_worked_on_played_and_downloaded(taking):
    serving, tab = taking
    assert not tab.page.get_by_role("button", name="Download zip").is_visible()
    drop(tab, "box.zip", zipped(MESHES / "cabinet.glb"))
    until(lambda: "cabinet.glb" in text(tab) and "finding the parts" in text(tab))
    until(lambda: tab.page.get_by_role("button", name="Download zip").is_visible())
    session = serving.page.session
    (joint,) = (j for j in session.asset.joints if j.child == "door_1")
    row = tab.page.locator("label:has-text('door_1')").locator("xpath=ancestor::*[descendant::input][1]")
    row.locator("input").last.fill("40")
    row.locator("input").last.press("Enter")
    until(lambda: abs(session.positions.get(joint.name, 0)) > 0.5)
    with tab.page.expect_download() as waiting:
        tab.page.get_by_role("button", name="Download zip").click()
    with zipfile.ZipFile(waiting.value.path()) as archive:
        names = set(archive.namelist())
        files = json.loads(archive.read("cabinet/asset.json"))["files"]
        assert {"urdf", "mjcf", "sdf", "glb"} <= set(files)
        assert {f"cabinet/{name}" for name in (*files.values(), "preview.png")} <= names
        robot = ET.fromstring(archive.read("cabinet/cabinet.urdf"))
        for mesh in robot.iter("mesh"):
            assert f"cabinet/{mesh.get('filename')}" in names
    assert waiting.value.suggested_filename == "cabinet.zip"
    assert tab.errors == []


def test_bad_files_are_told_work_is_cancelled_and_another_mesh_is_taken(taking):
    serving, tab = taking
    drop(tab, "notes.txt", b"text")
    until(lambda: "found the format .txt" in text(tab))
    tab.page.evaluate(BIG, 201 << 20)
    until(lambda: "larger than 200 MB" in text(tab))
    drop(tab, "broken.glb", b"glTF and nothing else")
    until(lambda: "broken.glb was not articulated" in text(tab))
    assert tab.page.url.startswith(serving.url)  # a dropped file never takes the page away
    tab.page.locator("input[type=file]").set_input_files(MESHES / "cabinet.glb")
    tab.page.get_by_role("button", name="Cancel").click()
    until(lambda: "was cancelled" in text(tab))
    drop(tab, "box.glb", (MESHES / "storage_box.glb").read_bytes())
    until(lambda: serving.page.session is not None)
    until(lambda: "Another mesh" in text(tab))
    drop(tab, "ball.obj", b"v 0 0 0\n")  # while an asset is shown
    until(lambda: "ball.obj was not articulated" in text(tab))
    assert tab.errors == []


class Person:
    """Somebody at the page who answers by clicks alone."""

    def __init__(self, serving, tab: Tab) -> None:
        self.page, self.tab, self.desk = serving.page, tab, serving.page.bench._desk

    def button(self, name: str) -> None:
        self.tab.page.get_by_role("button", name=name, exact=True).click()

    def waits_for(self, kind: str):
        """The form of the question, once it is on the page with geometry's suggestion."""
        until(lambda: self.desk.busy and self.desk._asked.folder.kind == kind and self.desk._asked._suggested, 180)
        time.sleep(1.5)
        return self.desk._asked.form

    def answer(self) -> None:
        self.tab.page.get_by_role("button", name="Answer").click()

    def pose(self) -> tuple[float, ...]:
        """Where the part that plays is."""
        with self.page._lock:  # the scene may be drawn anew
            moving = self.desk._scene._moving
            return (*moving.wxyz, *moving.position)

    def click(self, place: np.ndarray) -> None:
        """Click where the page shows a place [m]."""
        (client,) = self.page.server.get_clients().values()
        camera = client.camera
        w, x, y, z = camera.wxyz
        R = np.array([
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ])  # fmt: skip
        local = R.T @ (place - camera.position)
        half = np.tan(camera.fov / 2)
        u, v = local[0] / (local[2] * half * camera.aspect), local[1] / (local[2] * half)
        self.tab.page.mouse.click((u + 1) / 2 * camera.image_width, (v + 1) / 2 * camera.image_height)
        time.sleep(0.6)

    def seen_point(self, form, mark: int) -> np.ndarray | None:
        """A place on a mark that the page shows, None when it shows none."""
        (client,) = self.page.server.get_clients().values()
        eye, mesh = np.asarray(client.camera.position), self.desk._mesh
        for face in np.flatnonzero(form.face_mark == mark)[:400]:
            place = mesh.triangles[face].mean(0)
            if self.desk._scene._mark_at(form, mesh, eye, place - eye) == mark:
                return place
        return None


def answer_recognition_and_marks(person: Person, tab) -> None:
    """Name the object, remove a label, and click the marks of the door."""
    form = person.waits_for("recognize")
    assert [r.label for r in form.rows] == ["door", "wheel", "knob"]
    tab.page.locator("label:has-text('Object')").locator("xpath=ancestor::*[descendant::input][1]").locator("input").fill(
        "microwave"
    )
    tab.page.get_by_text("wheel: turns round and round").click()
    time.sleep(0.5)
    tab.page.get_by_role("button", name="Remove").filter(visible=True).first.click()
    until(lambda: len(form.rows) == 2)
    person.button("I look at its front now")
    until(lambda: form.front > 0)
    person.answer()

    form = person.waits_for("marks")
    wanted = set(form.groups["door", 1])
    form.set_marks("")
    for mark in sorted(wanted):
        place = person.seen_point(form, mark)
        assert place is not None, mark
        person.click(place)
    until(lambda: form.groups["door", 1] == wanted)
    until(lambda: f"door 1: {', '.join(map(str, sorted(wanted)))}" in text(tab))
    person.answer()


def answer_points_and_motions(person: Person) -> None:
    """Click two points of the hinge on the left, and watch each motion before one is chosen."""
    form = person.waits_for("points")
    places = point_places(form.table, person.desk._mesh)
    left = np.flatnonzero(places[:, 0] < places[:, 0].min() + 0.02)
    form.chosen[0] = []
    for row in (left[places[left, 2].argmin()], left[places[left, 2].argmax()]):
        person.click(places[row])
    until(lambda: len(form.chosen[0]) == 2)
    assert {n - 1 for n in form.chosen[0]} <= set(left)
    person.answer()

    form = person.waits_for("motions")
    hinges = [
        k for k, m in enumerate(form.table.motions, 1)
        if m.kind is JointType.REVOLUTE and abs(m.axis[2]) > 0.99 and m.origin[0] < 0
    ]  # fmt: skip
    for number in range(1, len(form.table.motions) + 1):  # each plays when it is chosen
        person.button(str(number))
        until(lambda n=number: form.chosen[0] == n)
        poses: list[tuple[float, ...]] = []
        until(lambda poses=poses: poses.append(person.pose()) or np.ptp(poses, 0).max() > 1e-3)
    person.button(str(hinges[0]))
    person.answer()


def test_every_question_about_a_microwave_is_answered_by_clicks(tmp_path, tab):
    options = {"ask": True, "out": tmp_path / "out", "author": "Ada", "clock": lambda: "2024-05-01T12:00:00+00:00"}
    with serve(MESHES / "microwave.glb", port=8540, **options) as serving:
        tab.open(serving.url)
        person = Person(serving, tab)
        answer_recognition_and_marks(person, tab)
        form = person.waits_for("kinds")
        assert form.answer()["parts"][0]["joint"] == "hinge_along_edge"
        person.answer()
        answer_points_and_motions(person)
        until(lambda: serving.page.session is not None, 180)
        asset, folder = serving.page.session.asset, serving.page.session.folder
    door = next(j for j in asset.joints if j.child == "door")
    assert abs(door.axis[2]) > 0.999
    assert door.origin[0] == pytest.approx(asset.mesh.bounds[0, 0], abs=0.05)
    assert asset.answerer.startswith("files")
    recorded = sorted((folder / "transcript").glob("*.json"))
    assert [json.loads(p.read_text())["kind"] for p in recorded][:2] == ["recognize", "marks"]
    assert json.loads(recorded[0].read_text())["answer"].count("microwave") == 1
    again = pipeline.articulate(MESHES / "microwave.glb", tmp_path / "again", answerer=f"replay:{folder / 'transcript'}")
    np.testing.assert_allclose([j.axis for j in again.joints], [j.axis for j in asset.joints])
    np.testing.assert_allclose([j.origin for j in again.joints], [j.origin for j in asset.joints])
    assert tab.errors == []
