"""Display of an asset in a notebook, as a page in an isolated frame."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from anymesh.types import Asset

HEIGHT = 620  # [px] height of the frame


class NotebookReport:
    """Result of `show`, which a notebook displays."""

    def __init__(self, html: str) -> None:
        self._html = html

    def _repr_html_(self) -> str:
        return self._html


def show(asset: Asset, *, height: int = HEIGHT) -> NotebookReport:
    """Return the asset for display in a notebook: 3D view, a slider per joint, tables. height: of the frame [px]."""
    return NotebookReport(asset_html(asset, height=height))


def asset_html(asset: Asset, *, height: int = HEIGHT) -> str:
    """Return the report of an asset in a frame that may only run its own scripts."""
    from anymesh.viewer.report_display import FACES
    from anymesh.viewer.report_entry import asset_entry
    from anymesh.viewer.report_html import html_report

    page = html_report(asset.name, [asset_entry(asset, faces=FACES)])
    return (
        f'<iframe sandbox="allow-scripts" srcdoc="{escape(page)}" width="100%" height="{int(height)}" '
        'style="border:1px solid #ccc"></iframe>'
    )


def register(shell: Any) -> None:
    """Register the display of assets in an IPython shell, by class name, so that nothing is imported early."""
    shell.display_formatter.formatters["text/html"].for_type_by_name("anymesh.types.asset", "Asset", asset_html)
