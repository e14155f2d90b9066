"""`anymesh report` and `anymesh picture` as they are called."""

import json

import pytest
import typer
from assets import cabinet
from shown import folder_of
from typer.testing import CliRunner

from anymesh.viewer.command_line import picture, report


@pytest.fixture(scope="module")
def app() -> typer.Typer:
    made = typer.Typer()
    made.command()(report)
    made.command()(picture)
    return made


def called(app: typer.Typer, *arguments) -> str:
    result = CliRunner().invoke(app, [str(a) for a in arguments], catch_exceptions=False)
    assert result.exit_code == 0, result.output
    return result.output


def test_the_path_of_a_report_is_printed_as_text_or_json_or_not_at_all(app, tmp_path):
    folder = folder_of(cabinet(), tmp_path / "all" / "cabinet")
    (tmp_path / "all" / "odd\tname").mkdir()
    (tmp_path / "all" / "odd\tname" / "asset.json").write_text("[]")
    lines = called(app, "report", tmp_path / "all", "-o", tmp_path / "page.html").splitlines()
    assert lines[0] == "cannot be shown: odd?name"
    assert lines[1].startswith(f"wrote {tmp_path / 'page.html'}: 2 assets, ")
    told = json.loads(called(app, "report", folder, "--json"))
    assert told["path"] == str(tmp_path / "all" / "cabinet_report.html")
    assert (told["assets"], told["unreadable"], told["notes"]) == (1, [], [])
    assert called(app, "report", folder, "-q") == ""


def test_a_picture_is_written_where_it_is_said(app, tmp_path):
    folder = folder_of(cabinet(), tmp_path / "cabinet")
    assert called(app, "picture", folder, "-o", tmp_path / "sheet.png").strip() == f"wrote {tmp_path / 'sheet.png'}"
    assert called(app, "picture", folder, "-o", tmp_path / "a.gif", "--size", "32", "--rate", "1", "--turn", "0", "-q") == ""
    assert (tmp_path / "a.gif").read_bytes().startswith(b"GIF89a")
