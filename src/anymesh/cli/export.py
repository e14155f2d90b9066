"""The command line of `anymesh export`: the files of saved stages."""

from __future__ import annotations

from anymesh.cli.options import (
    FORMATS,
    BaseName,
    Drives,
    Folder,
    Formats,
    Json,
    Package,
    Quiet,
    TimeLimit,
    Zip,
)
from anymesh.cli.output import Shown, tell_asset
from anymesh.deadline import DEFAULT_SECONDS


def export(
    folder: Folder,
    base: BaseName = "fixed",
    formats: Formats = FORMATS,
    drives: Drives = "passive",
    package: Package = None,
    zip_: Zip = None,
    time_limit: TimeLimit = DEFAULT_SECONDS,
    json_: Json = False,
    quiet: Quiet = False,
) -> None:
    """Write the files of the asset whose stages are in DIR."""
    from anymesh import pipeline

    with Shown(quiet or json_) as progress:
        asset = pipeline.export(
            folder, base=base, formats=formats, drives=drives, package=package, archive=zip_,
            time_limit=time_limit, progress=progress,
        )  # fmt: skip
    tell_asset(asset, folder, json_, quiet)
