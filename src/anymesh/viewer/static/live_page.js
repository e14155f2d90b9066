// What the live page adds to viser: buttons with pictures, and outlines drawn over the scene. Messages go to the server as the
// value of a hidden text field, the one after the element #anymesh-channel. Runs once per tab.
(() => {
  if (window.anymeshPage) return;
  window.anymeshPage = true;
  const MOST_POINTS = 400, LEAST_STEP = 3; // corners of an outline; [px] between two of them
  let count = 0;

  const say = (message) => {
    const mark = document.getElementById('anymesh-channel'), row = mark && mark.parentElement.nextElementSibling;
    const field = row && row.querySelector('input');
    if (!field) return;
    const set = Object.getOwnPropertyDescriptor(HTMLInputElement.prototype, 'value').set;
    count += 1;
    set.call(field, JSON.stringify({ ...message, count: `${Date.now()}-${count}` }));
    field.dispatchEvent(new Event('input', { bubbles: true }));
  };

  document.addEventListener('click', (event) => {
    const button = event.target.closest && event.target.closest('[data-say]');
    if (button && !button.disabled) say({ say: button.dataset.say });
    // a button that was clicked lets go of the focus, so that Enter and the arrows are for the page
    if (event.detail && document.activeElement && document.activeElement.closest('button')) document.activeElement.blur();
  });
  // keys that a focused control uses itself are not for the page
  document.body.addEventListener('keydown', (event) => {
    const button = event.target.closest('button'), slider = event.target.closest('[role=slider]');
    if ((button && ['Enter', ' '].includes(event.key)) || (slider && event.key.startsWith('Arrow'))) event.stopPropagation();
  });

  let drawing = null;
  const stop = (event) => { event.preventDefault(); event.stopImmediatePropagation(); };
  const end = () => { drawing.svg.remove(); drawing = null; };
  const draw = (event) => {
    const last = drawing.points[drawing.points.length - 1];
    const far = !last || Math.hypot(event.clientX - last[0], event.clientY - last[1]) >= LEAST_STEP;
    if (far && drawing.points.length < MOST_POINTS) drawing.points.push([event.clientX, event.clientY]);
    drawing.line.setAttribute('points', drawing.points.map((p) => p.join(',')).join(' '));
  };
  window.addEventListener('pointerdown', (event) => {
    if (!document.getElementById('anymesh-lasso') || event.button !== 0 || event.target.tagName !== 'CANVAS') return;
    stop(event);
    const svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
    svg.setAttribute('style', 'position:fixed;inset:0;width:100vw;height:100vh;z-index:50;pointer-events:none');
    const line = document.createElementNS('http://www.w3.org/2000/svg', 'polygon');
    line.setAttribute('style', 'fill:rgba(230,0,200,0.12);stroke:rgb(230,0,200);stroke-width:2;stroke-dasharray:5 4');
    svg.append(line);
    document.body.append(svg);
    drawing = { svg, line, points: [], box: event.target.getBoundingClientRect() };
    draw(event);
  }, true);
  window.addEventListener('pointermove', (event) => { if (drawing) { stop(event); draw(event); } }, true);
  window.addEventListener('pointercancel', () => { if (drawing) end(); }, true);
  window.addEventListener('pointerup', (event) => {
    if (!drawing) return;
    stop(event);
    const { points, box } = drawing;
    end();
    const inPicture = ([x, y]) => [(x - box.left) / box.width, (y - box.top) / box.height].map((v) => Math.round(1e4 * v) / 1e4);
    if (points.length > 2) say({ lasso: points.map(inPicture), take: event.shiftKey });
  }, true);
  window.addEventListener('keydown', (event) => { if (drawing && event.key === 'Escape') { stop(event); end(); } }, true);
  for (const kind of ['mousedown', 'mousemove', 'mouseup']) {
    window.addEventListener(kind, (event) => { if (drawing) stop(event); }, true);
  }
})();
