"""Drop zone for meshes on the page, as HTML. A file dropped anywhere is passed to the upload button.

The script runs when its (empty) picture loads, because scripts in HTML that is added later do not run. It also prevents the
browser from leaving the page when a file is dropped outside the zone, and from sending files that are too large.
"""

from __future__ import annotations

from html import escape

from anymesh.loading.load import READERS
from anymesh.viewer.uploads import MAX_UNPACKED_BYTES, MAX_UPLOAD_BYTES

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


def drop_zone(*, small: bool) -> str:
    """Return the drop zone; small: one line, used once an asset is shown."""
    formats = ", ".join(suffix[1:].upper() for suffix in READERS)
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
