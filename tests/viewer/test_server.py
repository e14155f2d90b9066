"""The live page answers browsers at its own address only, and nothing outside its own files."""

from __future__ import annotations

import http.client
import sys
from collections.abc import Iterator

import pytest
from correctable import write_output
from typer.testing import CliRunner

from anymesh.errors import InputError, MissingExtraError, OutputError
from anymesh.viewer import server_ as live_serve_
from anymesh.viewer.command_line import view
from anymesh.viewer.server_ import is_permitted


@pytest.mark.parametrize(
    ("host", "origin", "fine"),
    [
        ("127.0.0.1:8080", None, True), ("localhost:8080", "http://localhost:8080", True), ("[::1]:8080", None, True),
        ("127.0.0.1:8080", "http://127.0.0.1:8080", True), ("evil.example:8080", None, False), (None, None, False),
        ("evil.example", "http://evil.example", False), ("127.0.0.1:8080", "https://evil.example", False),
        ("127.0.0.1:8080", "null", False), ("127.0.0.1:8080", "http://127.0.0.1:9999", False), ("[bad", None, False),
        ("127.0.0.1.evil.example", None, False),
    ],
)  # fmt: skip
def test_who_may_speak_to_the_page(host, origin, fine) -> None:
    assert is_permitted(host, origin, bound="127.0.0.1") is fine


def test_a_page_that_is_bound_to_a_network_keeps_to_its_own_origin() -> None:
    assert is_permitted("box.lan:80", "http://box.lan:80", bound="0.0.0.0")
    assert not is_permitted("box.lan:80", "http://evil.example", bound="0.0.0.0")


@pytest.fixture(scope="module")
def port() -> Iterator[int]:
    pytest.importorskip("viser")
    from anymesh.viewer.server_ import start_server

    server = start_server("127.0.0.1", 18473, "test")
    yield server.get_port()
    server.stop()


def status(port: int, path: str = "/", **headers: str) -> int:
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=10)
    connection.request("GET", path, headers=headers)
    return connection.getresponse().status


def test_a_real_server_refuses_strangers_and_paths_that_lead_out(port) -> None:
    upgrade = {
        "Upgrade": "websocket",
        "Connection": "Upgrade",
        "Sec-WebSocket-Version": "13",
        "Sec-WebSocket-Key": "a" * 22 + "==",
    }
    assert status(port) == 200
    assert status(port, Host="evil.example") == 403
    assert status(port, Origin="https://evil.example") == 403
    assert status(port, Origin="https://evil.example", **upgrade) == 403
    assert status(port, Origin=f"http://127.0.0.1:{port}", **upgrade) == 101
    for path in ("/../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "//etc/passwd", "/..%5c..%5cetc/passwd"):
        assert status(port, path) == 404


def serving(target):
    return live_serve_.serve(target, author="Ada", clock=lambda: "2024-05-01T12:00:00+00:00")


def test_a_folder_without_outputs_and_a_file_that_is_no_mesh_are_refused(tmp_path):
    pytest.importorskip("viser", reason="needs the extra view")
    with pytest.raises(OutputError, match="holds no output"), serving(tmp_path):
        pass
    (tmp_path / "x.glb").write_bytes(b"no mesh")
    with pytest.raises(InputError), serving(tmp_path / "x.glb"):
        pass


def test_without_the_package_the_error_names_the_extra(tmp_path, monkeypatch):
    folder = write_output(tmp_path / "out")
    monkeypatch.setitem(sys.modules, "viser", None)
    with pytest.raises(MissingExtraError, match=r"\.\[view\]"), serving(folder):
        pass


def test_the_page_listens_on_this_machine_alone(tmp_path):
    pytest.importorskip("viser", reason="needs the extra view")
    with serving(write_output(tmp_path / "out")) as found:
        assert found.url.startswith("http://127.0.0.1:")


def test_a_mesh_is_articulated_first_and_its_folder_goes_when_nothing_was_saved(monkeypatch, tmp_path):
    pytest.importorskip("viser", reason="needs the extra view")
    made = []

    def articulate(mesh, folder, *, root, progress):
        made.append(folder)
        write_output(folder)

    monkeypatch.setattr(live_serve_.pipeline, "articulate", articulate)
    with serving(tmp_path / "mesh.glb") as found:
        assert str(made[0]) in found.notes[0]
        assert made[0].exists()
        folder = found.page.session.folder
    assert folder == made[0].resolve()
    assert not made[0].exists()


def test_the_options_are_told():
    import typer

    app = typer.Typer()
    app.command()(view)
    told = CliRunner().invoke(app, ["--help"], env={"COLUMNS": "200", "NO_COLOR": "1"}).output
    for option in ("--ask", "--out", "--host", "--port", "--no-browser", "--reviewer", "127.0.0.1"):
        assert option in told
