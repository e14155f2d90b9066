"""Fusion of posed pictures with depth into a surface mesh in metres that the pipeline can articulate (paper, 4.2)."""

from anymesh.applications.scan.output import ScanReport
from anymesh.applications.scan.rendered import render_frames
from anymesh.applications.scan.scanning import ScanConfig, scan

__all__ = ["ScanConfig", "ScanReport", "render_frames", "scan"]
