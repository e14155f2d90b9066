// Files dropped anywhere on the live page, or chosen, go to its one upload button. Several files, or a folder, become one zip.
// It runs when a picture loads, because scripts in HTML that is added later do not run. The largest size is put in by the program.
if (!window.anymeshDrop) {
  window.anymeshDrop = true;
  const most = MOST, mostFiles = 2000;
  const input = () => document.querySelector('input[type=file][id^=file_upload_]');
  const showNote = (text) => {
    for (const note of document.querySelectorAll('.anymesh-drop-note')) note.textContent = text;
  };
  const paint = (on) => {
    for (const zone of document.querySelectorAll('.anymesh-drop')) zone.style.background = on ? 'rgba(34,139,230,0.18)' : '';
  };

  const table = Uint32Array.from({ length: 256 }, (_, n) => {
    for (let k = 0; k < 8; k++) n = n & 1 ? 0xedb88320 ^ (n >>> 1) : n >>> 1;
    return n;
  });
  const checksum = (bytes) => {
    let value = 0xffffffff;
    for (let k = 0; k < bytes.length; k++) value = table[(value ^ bytes[k]) & 255] ^ (value >>> 8);
    return (value ^ 0xffffffff) >>> 0;
  };
  const numbers = (...pairs) => {  // [value, bytes], little endian
    const view = new DataView(new ArrayBuffer(pairs.reduce((sum, [, size]) => sum + size, 0)));
    let at = 0;
    for (const [value, size] of pairs) {
      size === 4 ? view.setUint32(at, value, true) : view.setUint16(at, value, true);
      at += size;
    }
    return view.buffer;
  };
  async function zipped(entries) {  // [path, File] each; stored, not compressed
    const content = [], directory = [];
    let at = 0, size = 0;
    for (const [path, file] of entries) {
      const name = new TextEncoder().encode(path), bytes = new Uint8Array(await file.arrayBuffer());
      const fields = [[20, 2], [0x800, 2], [0, 2], [0, 2], [0x21, 2], [checksum(bytes), 4], [bytes.length, 4],
        [bytes.length, 4], [name.length, 2], [0, 2]];
      const entry = numbers([0x02014b50, 4], [20, 2], ...fields, [0, 2], [0, 2], [0, 2], [0, 4], [at, 4]);
      content.push(numbers([0x04034b50, 4], ...fields), name, bytes);
      directory.push(entry, name);
      at += 30 + name.length + bytes.length;
      size += entry.byteLength + name.length;
    }
    const count = entries.length;
    const end = numbers([0x06054b50, 4], [0, 2], [0, 2], [count, 2], [count, 2], [size, 4], [at, 4], [0, 2]);
    return new File([...content, ...directory, end], 'files.zip', { type: 'application/zip' });
  }

  async function inside(entry) {  // files of a dropped file or folder, with their paths
    if (entry.isFile) return [[entry.fullPath.replace(/^\/+/, ''), await new Promise((done, fail) => entry.file(done, fail))]];
    const reader = entry.createReader(), found = [];
    for (;;) {
      const some = await new Promise((done, fail) => reader.readEntries(done, fail));
      if (!some.length) return found;
      for (const one of some) {
        found.push(...await inside(one));
        if (found.length > mostFiles) throw new Error('The folder holds more than ' + mostFiles + ' files.');
      }
    }
  }
  async function dropped(transfer) {
    const entries = [...transfer.items].map((item) => item.webkitGetAsEntry && item.webkitGetAsEntry());
    const files = [...transfer.files];
    if (!entries.length || entries.some((entry) => !entry)) return files.map((file) => [file.name, file]);
    return (await Promise.all(entries.map(inside))).flat();
  }
  async function send(found) {
    const to = input();
    if (!to) { showNote('Wait until the current mesh is done, or cancel it.'); return; }
    const size = found.reduce((sum, [, file]) => sum + file.size, 0);
    if (!found.length) { showNote('The folder is empty.'); return; }
    if (size > most) {
      const what = found.length > 1 ? 'The files together are' : 'The file is';
      showNote(what + ' larger than ' + Math.round(most / 1048576) + ' MB, the maximum.');
      return;
    }
    showNote('');
    const transfer = new DataTransfer();
    transfer.items.add(found.length === 1 ? found[0][1] : await zipped(found));
    const now = input();
    if (!now) return;
    window.anymeshSent = true;
    now.files = transfer.files;
    now.dispatchEvent(new Event('change', { bubbles: true }));
    window.anymeshSent = false;
  }

  window.addEventListener('dragover', (event) => { event.preventDefault(); paint(true); });
  window.addEventListener('dragleave', () => paint(false));
  window.addEventListener('drop', (event) => {
    event.preventDefault();
    paint(false);
    dropped(event.dataTransfer).then(send).catch((error) => showNote(error.message));
  });
  const allowSeveral = () => { const to = input(); if (to) to.multiple = true; };
  new MutationObserver(allowSeveral).observe(document.body, { childList: true, subtree: true });
  allowSeveral();
  window.addEventListener('change', (event) => {  // files that were chosen
    if (event.target !== input() || window.anymeshSent) return;
    event.stopImmediatePropagation();
    send([...event.target.files].map((file) => [file.name, file])).catch((error) => showNote(error.message));
  }, true);
}
