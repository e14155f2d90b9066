"""`anymesh report`: the assets of a folder as one page; and the display of an asset in a notebook."""

from __future__ import annotations

import os
import sys
import webbrowser
from dataclasses import dataclass
from html import escape
from pathlib import Path
from tempfile import mkdtemp
from typing import Any

from anymesh.correcting.editable import EditableAsset
from anymesh.errors import InputError
from anymesh.names import confidence_word
from anymesh.rendering.preview import extent
from anymesh.runtime import Progress, silent, writing
from anymesh.types import Asset
from anymesh.viewer.report_asset import FACES, ReportEntry, asset_entry, find_assets, folder_entry, within
from anymesh.viewer.report_html import html_report

MEGABYTES = 100.0  # maximum size of a page that browsers open quickly
HEIGHT = 620  # [px] height of the frame in a notebook


@dataclass(frozen=True)
class Reported:
    """Contents of a written report."""

    path: Path
    assets: int
    unreadable: tuple[str, ...]  # folders; the page states the reasons
    notes: tuple[str, ...]  # what was decimated or left out
    size: int  # [bytes] of the file


def write_report(
    folder: str | Path,
    out: str | Path | None = None,
    *,
    faces: int = FACES,
    megabytes: float = MEGABYTES,
    progress: Progress = silent,
) -> Reported:
    """Write one HTML file of the asset in `folder`, or of all assets below it, least confident first.

    out: FOLDER_report.html beside the folder if None; an existing file is replaced. faces: number above which an asset is
    decimated for display; megabytes: maximum size of the file, beyond which content is left out with a note.
    Raise InputError if there is no asset, OutputError if the file cannot be written.
    """
    folder = Path(folder)
    entries = within(_entries(folder, faces, progress), megabytes)
    whole = folder.resolve()
    out = whole.parent / f"{whole.name}_report.html" if out is None else Path(out)
    data = html_report(whole.name, entries).encode()
    with writing(out):
        temporary = out.with_name(f".{out.name}.part")  # so that the page is written atomically
        temporary.write_bytes(data)
        temporary.replace(out)
    return Reported(
        path=out,
        assets=len(entries),
        unreadable=tuple(e.title for e in entries if e.asset is None),
        notes=tuple(f"{e.title}: {note}" for e in entries for note in e.notes),
        size=len(data),
    )


def _entries(folder: Path, faces: int, progress: Progress = silent) -> list[ReportEntry]:
    """Return the entries of all assets in a folder, least confident first. Raise InputError if there is none."""
    if not folder.is_dir():
        raise InputError(f"{folder} is not a folder; valid is one that `anymesh articulate` made, or a folder of such")
    folders, entries = find_assets(folder), []
    for k, place in enumerate(folders):
        title = folder.resolve().name if place == folder else place.relative_to(folder).as_posix()
        progress("report", title, k, len(folders))
        entries.append(folder_entry(place, title, faces=faces))
    return sorted(entries, key=lambda entry: (entry.least, entry.title))


class NotebookReport:
    """Result of `show`, which a notebook displays. path: of the page that was written outside of a notebook."""

    def __init__(self, html: str, path: Path | None = None) -> None:
        self._html, self.path = html, path

    def _repr_html_(self) -> str:
        return self._html

    def __repr__(self) -> str:
        return "report in a notebook" if self.path is None else f"report in {self.path}"


def show(asset: str | Path | Asset | EditableAsset, *, height: int = HEIGHT) -> NotebookReport:
    """Show an asset with a 3D view, a slider per joint, and tables: in a notebook, else in the browser.

    asset: an output folder, or a folder of several; or an asset. height: of the frame in a notebook [px]. Outside of a notebook
    the page is written to a temporary folder and its path is printed; without a display no browser is opened.
    Raise InputError if a folder holds no asset.
    """
    if isinstance(asset, (str, Path)):
        name, entries = Path(asset).resolve().name, within(_entries(Path(asset), FACES), MEGABYTES)
    else:
        plain = asset.asset if isinstance(asset, EditableAsset) else asset
        name, entries = plain.name, [asset_entry(plain, faces=FACES)]
    page = html_report(name, entries)
    if "ipykernel" in sys.modules:  # the kernel of a notebook
        return NotebookReport(_framed(page, height))
    path = Path(mkdtemp(prefix="anymesh-")) / f"{name}.html"
    path.write_text(page, encoding="utf-8")
    sys.stdout.write(f"the report of {name} is {path}\n")
    if sys.platform != "linux" or {"DISPLAY", "WAYLAND_DISPLAY"} & {*os.environ}:
        webbrowser.open(path.as_uri())
    return NotebookReport(_framed(page, height), path)


def asset_html(asset: Asset, *, height: int = HEIGHT) -> str:
    """Return the report of an asset in a frame that may only run its own scripts."""
    return _framed(html_report(asset.name, [asset_entry(asset, faces=FACES)]), height)


def _framed(page: str, height: int) -> str:
    return (
        f'<iframe sandbox="allow-scripts" srcdoc="{escape(page)}" width="100%" height="{int(height)}" '
        'style="border:1px solid #ccc"></iframe>'
    )


def asset_text(asset: Asset) -> str:
    """Return one line for the asset, and one per joint with its motion and how sure it is."""
    joints = (f"  {j.name}: {j.type.value} {extent(j)}, {confidence_word(j.confidence)}" for j in asset.joints)
    return "\n".join((f"{asset.name}: {len(asset.joints)} joints", *joints))


def register(shell: Any) -> None:
    """Let an IPython shell print assets by `asset_text`; their page they show by themselves (`Asset._repr_html_`)."""
    plain = shell.display_formatter.formatters["text/plain"]
    plain.for_type(Asset, lambda asset, printer, cycle: printer.text(asset_text(asset)))
