"""`anymesh view` on the command line: what cannot be shown is an error that says why, and a mesh is articulated first."""

import sys

import pytest
from correctable import write_output
from typer.testing import CliRunner

from anymesh.errors import InputError, MissingExtraError, OutputError
from anymesh.viewer import server_ as live_serve_
from anymesh.viewer.command_line import view


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
    with pytest.raises(MissingExtraError, match=r"articulate-anymesh\[view\]"), serving(folder):
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
