"""The command line of `anymesh export`: the files of saved stages."""

from __future__ import annotations

from anymesh.cli.from_options import with_options
from anymesh.cli.options import Folder, Formats, Json, Package, Quiet, Time, Zip
from anymesh.cli.output import Shown, print_asset


@with_options
def export(
    folder: Folder,
    *,
    writing: Formats,
    package: Package = None,
    zip_: Zip = None,
    time: Time,
    json_: Json = False,
    quiet: Quiet = False,
) -> None:
    """Write the files of the asset whose stages are in DIR."""
    from anymesh import pipeline

    with Shown(quiet or json_) as progress:
        asset = pipeline.export_asset(folder, package=package, archive=zip_, progress=progress, **writing, **time)
    print_asset(asset, folder, json_, quiet)
