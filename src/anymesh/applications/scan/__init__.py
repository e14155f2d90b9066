"""Fusion of posed pictures with depth into a surface mesh in metres that the pipeline can articulate (paper, 4.2)."""

from typing import TYPE_CHECKING

from anymesh.entry_points import on_first_use

if TYPE_CHECKING:
    from anymesh.applications.scan.rendered import render_frames
    from anymesh.applications.scan.scanning import ScanConfig, ScanReport, scan

__all__ = ["ScanConfig", "ScanReport", "render_frames", "scan"]
__getattr__ = on_first_use(
    __name__, {**dict.fromkeys(("ScanConfig", "ScanReport", "scan"), "scanning"), "render_frames": "rendered"}
)
