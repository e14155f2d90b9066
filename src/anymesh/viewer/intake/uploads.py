"""Uploaded files (a mesh, or a zip with a mesh and its referenced files), whose content is not trusted, and the drop zone.

A file dropped anywhere on the page is passed to the upload button. The script of the drop zone runs when its (empty) picture
loads, because scripts in HTML that is added later do not run. It also prevents the browser from leaving the page when a file is
dropped outside the zone, and from sending files that are too large.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from html import escape
from pathlib import Path

from anymesh.errors import InputError
from anymesh.formats.advice import remedy
from anymesh.formats.zipped import MAX_UNPACKED_BYTES, only_mesh, unpack
from anymesh.loading.files import FORMATS

MAX_UPLOAD_BYTES = 200 << 20  # maximum size of a file [bytes]
PLAIN_NAME = re.compile(r"[^A-Za-z0-9._-]+")
EMPTY_PICTURE = "data:image/gif;base64,R0lGODlhAQABAAAAACwAAAAAAQABAAA="
STYLE = "border:2px dashed #868e96;border-radius:8px;padding:1.4em 0.8em;margin:0.4em 0.8em;text-align:center;line-height:1.45"
SMALL_STYLE = "padding:0.2em 1em 0.4em;font-size:0.8em;opacity:0.8"
SCRIPT = """
if (!window.anymeshDrop) {
  window.anymeshDrop = true;
  const most = MOST;
  const input = () => document.querySelector('input[type=file][id^=file_upload_]');
  const show_note = (text) => { const note = document.getElementById('anymesh-drop-note'); if (note) note.textContent = text; };
  const paint = (on) => { const zone = document.getElementById('anymesh-drop');
    if (zone) zone.style.background = on ? 'rgba(34,139,230,0.18)' : ''; };
  window.addEventListener('dragover', (event) => { event.preventDefault(); paint(true); });
  window.addEventListener('dragleave', () => paint(false));
  window.addEventListener('drop', (event) => {
    event.preventDefault(); paint(false);
    const files = event.dataTransfer.files, to = input();
    if (!to) { show_note('Wait until the current mesh is done, or cancel it.'); return; }
    if (files.length !== 1) { show_note('Drop one file; several that belong together as a zip.'); return; }
    to.files = files;
    to.dispatchEvent(new Event('change', { bubbles: true }));
  });
  window.addEventListener('change', (event) => {
    if (event.target !== input() || !event.target.files.length) return;
    show_note('');
    if (event.target.files[0].size > most) {
      event.stopImmediatePropagation();
      show_note('The file is larger than ' + Math.round(most / 1048576) + ' MB, the maximum.');
    }
  }, true);
}
"""


@dataclass(frozen=True)
class Upload:
    """An uploaded mesh. root: folder with the files that it refers to."""

    mesh: Path
    root: Path


def receive(name: str, content: bytes, folder: Path) -> Upload:
    """Save an uploaded file in an empty folder; a zip is unpacked there.

    Raise InputError for a file that is too large, of unknown format, or a zip that is unsafe or without exactly one mesh.
    """
    if len(content) > MAX_UPLOAD_BYTES:
        raise InputError(f"the file has {_size(len(content))}; at most {_size(MAX_UPLOAD_BYTES)} are accepted")
    folder.mkdir(parents=True)
    plain = plain_name(name)
    suffix = Path(plain).suffix.lower()
    if suffix not in (*FORMATS, ".zip"):
        way = remedy(suffix) or f"valid are {', '.join(FORMATS)}, and .zip"
        raise InputError(f"{plain}: found the format {suffix or '(none)'}; {way}")
    path = folder / plain
    path.write_bytes(content)
    if suffix != ".zip":
        return Upload(path, folder)
    inside = folder / "unpacked"
    unpack(path, inside)
    path.unlink()
    return Upload(only_mesh(inside, FORMATS).mesh, inside)


def plain_name(name: str) -> str:
    """Return the last part of a file name in plain characters, never hidden or empty."""
    last = re.split(r"[\\/]", name)[-1]
    plain = PLAIN_NAME.sub("_", last).strip("._") or "mesh"
    stem, dot, suffix = plain.rpartition(".")
    return f"{stem[:60]}{dot}{suffix[:10]}" if dot else plain[:60]


def _size(count: int) -> str:
    return f"{count / (1 << 20):.0f} MB"


def drop_zone(*, small: bool) -> str:
    """Return the drop zone; small: one line, used once an asset is shown."""
    formats = ", ".join(suffix[1:].upper() for suffix in FORMATS)
    script = escape(SCRIPT.replace("MOST", str(MAX_UPLOAD_BYTES), 1), quote=True)
    runs = f'<img src="{EMPTY_PICTURE}" alt="" style="display:none" onload="{script}">'
    note = '<div id="anymesh-drop-note" role="alert" style="color:#c92a2a"></div>'
    if small:
        return f'<div id="anymesh-drop" style="{SMALL_STYLE}">Or drop another mesh anywhere on the page.{note}{runs}</div>'
    limits = f"At most {MAX_UPLOAD_BYTES >> 20} MB; {MAX_UNPACKED_BYTES >> 30} GB unpacked. It stays on this machine."
    return (
        f'<div id="anymesh-drop" style="{STYLE}"><b>Drop a mesh here</b><br><span style="font-size:0.8em;opacity:0.8">'
        f"{formats}, or a zip of one mesh with its textures.<br>{limits}</span>{note}{runs}</div>"
    )
