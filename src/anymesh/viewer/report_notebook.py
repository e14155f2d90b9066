"""An asset in a notebook: its page in a frame of its own, which nothing of the notebook can reach, nor it the notebook."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from anymesh.types import Asset

HEIGHT = 620  # [px] of the frame


class NotebookReport:
    """What `show` gives: a notebook displays it."""

    def __init__(self, html: str) -> None:
        self._html = html

    def _repr_html_(self) -> str:
        return self._html


def show(asset: Asset, *, height: int = HEIGHT) -> NotebookReport:
    """The asset as a notebook displays it: in 3D, a slider a joint, tables. height: of the frame [px]."""
    return NotebookReport(asset_html(asset, height=height))


def asset_html(asset: Asset, *, height: int = HEIGHT) -> str:
    """The report's page of an asset, as a frame that may run its own scripts and nothing else."""
    from anymesh.viewer.report_display import FACES
    from anymesh.viewer.report_entry import asset_entry
    from anymesh.viewer.report_html import html_report

    page = html_report(asset.name, [asset_entry(asset, faces=FACES)])
    return (
        f'<iframe sandbox="allow-scripts" srcdoc="{escape(page)}" width="100%" height="{int(height)}" '
        'style="border:1px solid #ccc"></iframe>'
    )


def register(shell: Any) -> None:
    """Tells an IPython shell how an asset is displayed; the class is told by name, so nothing is imported before one is."""
    shell.display_formatter.formatters["text/html"].for_type_by_name("anymesh.types.asset", "Asset", asset_html)
