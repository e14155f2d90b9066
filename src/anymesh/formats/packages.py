"""Unpacking of formats that are archives (USDZ, 3MF), bounded in number and size, and never out of the target folder."""

from __future__ import annotations

import zipfile
from pathlib import Path, PurePosixPath

from anymesh.errors import InputError
from anymesh.loading.references import SHOWN

MAX_ENTRIES = 20_000
MAX_UNPACKED = 4 * 1024**3
CHUNK = 1 << 20


def unpack(name: str, archive: Path, target: Path) -> list[str]:
    """Unpack an archive into an empty folder and return the names of its files in their order.

    Raise InputError if it is broken, too large, or has a name that leads out of the folder.
    """
    room, names = MAX_UNPACKED, []
    try:
        with zipfile.ZipFile(archive) as packed:
            entries = [entry for entry in packed.infolist() if not entry.is_dir()]
            if len(entries) > MAX_ENTRIES:
                raise InputError(f"{name} has {len(entries)} files inside; at most {MAX_ENTRIES} are read")
            for entry in entries:
                place = PurePosixPath(entry.filename.replace("\\", "/"))
                if place.is_absolute() or ".." in place.parts or ":" in entry.filename:
                    raise InputError(f"{name} has a file named {entry.filename[:SHOWN]!r}, which leads out of the archive")
                file = target / place
                file.parent.mkdir(parents=True, exist_ok=True)
                with packed.open(entry) as source, file.open("wb") as sink:
                    while chunk := source.read(CHUNK):
                        room -= len(chunk)
                        if room < 0:
                            raise InputError(f"{name} holds more than {MAX_UNPACKED} bytes; at most that are unpacked")
                        sink.write(chunk)
                names.append(place.as_posix())
    except (zipfile.BadZipFile, EOFError, OSError, NotImplementedError, RuntimeError, ValueError) as error:
        raise InputError(f"{name} is no readable archive, it is broken ({type(error).__name__}: {error})") from None
    return names
