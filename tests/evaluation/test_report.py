"""The report: one row for each thing, nothing of a name is taken for markup, and the HTML needs nothing else."""

import json
import re
import xml.etree.ElementTree as ET
from dataclasses import fields, replace
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from records import ALIKE, DOOR, DRAWER, KNOB, MISSING, record

from anymesh.errors import OutputError
from anymesh.evaluation.drawing import captioned, contact_sheet, without_caption
from anymesh.evaluation.record import worst
from anymesh.evaluation.report import cumulative, error_charts, joint_rows, markdown, write_report
from anymesh.evaluation.score import JointScore
from anymesh.evaluation.summary import Cell, Table, report_tables

SETTINGS = {"dataset": "examples", "answerer": "geometry", "seed": "0"}
WEIRD = '<script>&"|a_b*'
RECORDS = [
    record(DOOR, DRAWER, name="cabinet", category="cabinet", rest=ALIKE),
    record(DOOR, DRAWER, name="cabinet", category="cabinet", change="noise .01"),
    record(replace(KNOB, part=WEIRD), name=WEIRD, category=WEIRD, pictures=((WEIRD, "pictures/a.png"),)),
    record(MISSING, name="box", error=f"ValueError: {WEIRD}"),
]


class Reader(HTMLParser):
    """Tags and text; a tag that is closed must be the last that was opened."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.tags: list[tuple[str, dict]] = []
        self.text = ""

    def handle_starttag(self, tag, attributes) -> None:
        self.tags.append((tag, dict(attributes)))
        if tag not in ("meta", "img", "br", "path"):
            self.open.append(tag)

    def handle_endtag(self, tag) -> None:
        if tag != "path":
            assert self.open.pop() == tag

    def handle_data(self, data) -> None:
        self.text += data


def read(html: str) -> Reader:
    reader = Reader()
    reader.feed(html)
    reader.close()
    assert not reader.open
    return reader


@pytest.fixture
def folder(tmp_path) -> Path:
    (tmp_path / "pictures").mkdir()
    image = captioned(np.full((60, 200, 3), 120, np.uint8), "title", "told")
    Image.fromarray(image).save(tmp_path / "pictures" / "a.png")
    write_report(RECORDS, tmp_path, title=f"Report {WEIRD}", settings=SETTINGS)
    return tmp_path


def test_joints_have_a_row_each_with_all_scores(folder) -> None:
    rows = [json.loads(line) for line in (folder / "joints.jsonl").read_text().splitlines()]
    assert [r["object"] for r in rows] == ["cabinet"] * 4 + [WEIRD, "box"]
    assert {f.name for f in fields(JointScore)} < set(rows[0])
    assert rows[0]["change"] == "none"
    assert rows[0]["success_opd"] is True
    assert (rows[-1]["angle"], rows[-1]["success_opd"], rows[-1]["error"]) == (None, False, f"ValueError: {WEIRD}")
    assert rows == json.loads(json.dumps(list(joint_rows(RECORDS))))


def test_markdown_tables_are_whole_and_names_stay_in_their_cells(folder) -> None:
    text = (folder / "report.md").read_text()
    titles = ["Settings", "Summary", "By change", "By category", "By true joint type", "The worst", "Errors", "Objects"]
    assert re.findall(r"^## (.*)$", text, re.M) == titles
    for block in re.findall(r"(?:^\|.*\n)+", text, re.M):
        bars = {len(re.findall(r"(?<!\\)\|", line)) for line in block.splitlines()}
        assert len(bars) == 1
    assert "<script" not in text
    assert "| answerer | geometry |" in text
    assert "| angle | 17.33 | 3.00 | 2.80 |" in text  # five found of six
    assert "![The worst joints](worst.png)" in text


def test_html_is_one_sound_file_that_asks_for_nothing_else(folder) -> None:
    html = (folder / "report.html").read_text()
    reader = read(html)
    tags = [tag for tag, _ in reader.tags]
    assert not {"script", "link", "iframe"} & set(tags)
    sources = [a[k] for _, a in reader.tags for k in ("src", "href", "xlink:href") if k in a]
    assert len(sources) == 1
    assert sources[0].startswith("data:image/jpeg;base64,")
    assert "url(" not in html
    assert "@import" not in html
    assert tags.count("svg") == 3
    assert WEIRD in reader.text
    assert reader.text.count("By change") == 1


def test_every_table_of_one_is_in_the_other(folder) -> None:
    text = read((folder / "report.html").read_text()).text
    for table in report_tables(RECORDS, SETTINGS, worst(RECORDS, 5)):
        for row in table.rows:
            assert all(cell.text in text for cell in row), table.title


def test_the_contact_sheet_goes_when_there_is_nothing_to_show(folder) -> None:
    assert (folder / "worst.png").is_file()
    write_report(RECORDS[:1], folder, title="t", settings={})
    assert not (folder / "worst.png").exists()
    assert "worst" not in (folder / "report.md").read_text()
    assert sorted(p.name for p in folder.iterdir()) == ["joints.jsonl", "pictures", "report.html", "report.md"]


def test_a_report_on_nothing_is_a_report(tmp_path) -> None:
    write_report([], tmp_path, title="nothing", settings=SETTINGS)
    assert (tmp_path / "joints.jsonl").read_text() == ""
    read((tmp_path / "report.html").read_text())


def test_a_folder_that_is_none_is_told(tmp_path) -> None:
    with pytest.raises(OutputError, match="missing"):
        write_report(RECORDS, tmp_path / "missing", title="t", settings={})


def test_one_change_one_category_and_one_type_make_no_tables_of_their_own() -> None:
    titles = [t.title for t in report_tables([record(DOOR)], SETTINGS, [])]
    assert titles == ["Settings", "Summary", "Objects"]


def test_figures_that_were_not_measured_have_no_column() -> None:
    tables = {t.title: t for t in report_tables(RECORDS, SETTINGS, [])}
    assert "runs" not in tables["By change"].head
    assert "rest gIoU" in [row[0].text for row in tables["Summary"].rows]
    tried = {t.title: t for t in report_tables([record(DOOR, executable=True)], {}, [])}
    assert "runs" in tried["Objects"].head
    assert "objects" not in tried["Objects"].head


def test_wrong_figures_are_shaded_and_right_ones_are_not() -> None:
    (table,) = (t for t in report_tables([record(replace(DOOR, angle=0.0), MISSING)], {}, []) if t.title == "Summary")
    shades = {row[0].text: row[1].shade for row in table.rows}
    assert (shades["type"], shades["part F1"], shades["tree"]) == (0.5, pytest.approx(1 / 3), 0.0)
    assert shades["angle"] == 0.5
    assert shades["joints"] == 0


def test_markdown_keeps_signs_as_they_are_read() -> None:
    assert markdown(Table("t", ("a", "b"), ((Cell("x|y"), Cell("<1\n2>")),))).splitlines() == [
        "| a | b |",
        "| --- | --- |",
        "| x\\|y | &lt;1 2> |",
    ]


def test_a_curve_ends_at_the_share_that_was_found() -> None:
    svg = ET.fromstring(cumulative("a & b", {"<x>": [1.0, None, 10.0, None]}, 0.1, 100.0))
    path = next(p.attrib["d"] for p in svg.iter("path") if p.attrib.get("stroke"))
    heights = [float(y) for y in re.findall(r"V([\d.]+)", path)]
    grid = [float(re.match(r"M40 ([\d.]+)H", p.attrib["d"])[1]) for p in svg.iter("path") if "H390" in p.attrib["d"][:14]]
    assert len(heights) == 2
    assert heights[-1] == pytest.approx(grid[2], abs=0.1)  # the line of one half
    across = [float(x) for x in re.findall(r"H([\d.]+)V", path)]
    assert across == pytest.approx([40 + 350 / 3, 40 + 700 / 3], abs=0.1)


def test_errors_outside_the_axis_are_at_its_ends() -> None:
    svg = cumulative("e", {"x": [0.0, 1e9]}, 0.1, 100.0)
    assert "H40.0V" in svg
    assert "H390.0V" in svg


def test_slides_have_no_curve_of_lines() -> None:
    assert len(error_charts({"prismatic": [DRAWER]})) == 2
    assert error_charts({"revolute": [MISSING]}) == []


def test_a_contact_sheet_holds_all_pictures_in_rows() -> None:
    pictures = [np.full((50, 100, 3), k, np.uint8) for k in (10, 60, 110, 160, 210)]
    sheet = contact_sheet(pictures, 3, 40)
    assert sheet.shape == (40, 120, 3)
    assert [int(sheet[10, 20 + 40 * k, 0]) for k in range(3)] == [10, 60, 110]
    assert [int(sheet[30, 20 + 40 * k, 0]) for k in range(3)] == [160, 210, 255]
    assert (without_caption(captioned(pictures[0], "é", "x")) == pictures[0]).all()
