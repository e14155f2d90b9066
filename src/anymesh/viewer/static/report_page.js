// The page: 3D views made when they are looked at, sliders, playing, selecting.
"use strict";
(() => {
  const LIVE = 4; // views that are kept; browsers bear about sixteen
  const WAY = 2; // [s] rest to one limit and back, as in the GLB's animation
  const json = (id) => JSON.parse(document.getElementById(id).textContent);
  const still = window.matchMedia("(prefers-reduced-motion: reduce)");
  const entries = [];

  // A position in the units that people read.
  function told(joint, amount) {
    if (joint.type === "prismatic" || joint.type === "free") return `${(100 * amount).toFixed(1)} cm`;
    return `${(amount * 180 / Math.PI).toFixed(0)}°`;
  }

  // Where a joint is at a time of the loop, as in the GLB's animation: up and back, then down and back.
  function played(joint, time, up, down) {
    const length = WAY * (up + down);
    const at = time % length;
    if (!joint.limits) return ((2 * Math.PI * at / length + Math.PI) % (2 * Math.PI)) - Math.PI;
    const way = (limit, begin) => limit * (1 - Math.cos(2 * Math.PI * Math.min(1, Math.max(0, (at - begin) / WAY)))) / 2;
    const [low, high] = joint.limits;
    return (high > 0 ? way(high, 0) : 0) + (low < 0 ? way(low, WAY * up) : 0);
  }

  class Entry {
    constructor(section, number) {
      this.section = section;
      this.number = number;
      this.stage = section.querySelector(".stage");
      this.data = json(`scene-${number}`);
      this.view = null;
      this.opening = null;
      this.playing = new Map(); // joint -> seconds into the loop
      this.used = 0;
      this.values = this.data.joints.map(() => 0);
      this.rows = new Map([...section.querySelectorAll("li[data-joint]")].map((row) => [Number(row.dataset.joint), row]));
      this.rows.forEach((row, k) => this._row(row, k));
      this._tools();
    }

    find(name) { return this.section.querySelector(name); }

    _row(row, k) {
      const slider = row.querySelector("input"), link = this.data.joints[k].link;
      row.addEventListener("pointerenter", () => this.pick(link));
      row.addEventListener("pointerleave", () => this.pick(-1));
      if (!slider) return;
      slider.addEventListener("input", () => { this.stop(k); this.set(k, Number(slider.value)); this.show(); });
      slider.addEventListener("dblclick", () => this.set(k, 0));
      row.querySelector(".play").addEventListener("click", () => (this.playing.has(k) ? this.stop(k) : this.play([k])));
      this.set(k, 0);
    }

    _tools() {
      const on = (name, kind, act) => this.find(name).addEventListener(kind, act);
      on(".open", "click", () => this.show());
      on(".all", "click", () => (this.playing.size ? this.stop() : this.play([...this.rows.keys()])));
      on(".rest", "click", () => { this.stop(); this.rows.forEach((_, k) => this.set(k, 0)); });
      on(".home", "click", () => this.view?.home());
      on(".looks", "change", (e) => this.view?.colors(e.target.checked));
      on(".axes", "change", (e) => this.view?.axes(e.target.checked));
      on(".grippers", "change", (e) => this.view?.grippers(e.target.checked));
      on(".apart", "input", () => { this.show(); this._apply(); });
    }

    set(k, amount) {
      const joint = this.data.joints[k], row = this.rows.get(k), slider = row?.querySelector("input");
      if (!slider) return;
      this.values[k] = amount;
      if (Number(slider.value) !== amount) slider.value = amount;
      slider.setAttribute("aria-valuetext", told(joint, amount));
      row.querySelector("output").textContent = told(joint, amount);
      this._apply();
    }

    _apply() {
      if (!this.view) return;
      this.view.positions = this.values;
      this.view.apart = Number(this.find(".apart").value);
      this.view.pose();
    }

    play(joints) {
      this.show();
      for (const k of joints) if (this.rows.get(k)?.querySelector("input")) this.playing.set(k, 0);
      this._buttons();
    }

    stop(joint) {
      if (joint === undefined) this.playing.clear();
      else this.playing.delete(joint);
      this._buttons();
    }

    _buttons() {
      this.find(".all").textContent = this.playing.size ? "■ Stop" : "▶ Play all";
      this.rows.forEach((row, k) => {
        const button = row.querySelector(".play");
        if (button) button.textContent = this.playing.has(k) ? "■" : "▶";
      });
    }

    step(seconds) {
      if (this.playing.size && this.view) {
        const limits = [...this.playing.keys()].map((k) => this.data.joints[k].limits);
        const up = limits.some((l) => !l || l[1] > 0), down = limits.some((l) => l && l[0] < 0);
        this.playing.forEach((time, k) => {
          this.playing.set(k, time + seconds);
          this.set(k, played(this.data.joints[k], time + seconds, up, down));
        });
      }
      this.view?.draw();
    }

    pick(link) {
      this.view?.pick(link);
      this.rows.forEach((row, k) => row.classList.toggle("picked", link >= 0 && this.data.joints[k].link === link));
    }

    // Makes the 3D view when there is none; the one that was not looked at for longest goes when there are many.
    async show() {
      this.used = performance.now();
      if (this.view || this.opening) return this.opening;
      const message = this.find(".message");
      message.textContent = "loading …";
      this.opening = AnymeshView.open(this.stage, this.data, document.getElementById(`glb-${this.number}`).textContent);
      try {
        this.view = await this.opening;
      } catch (error) {
        message.textContent = `No 3D view: ${error.message}. The pictures and tables below hold all the same.`;
        return undefined;
      } finally {
        this.opening = null;
      }
      message.textContent = "";
      this.stage.classList.add("live");
      this._habits();
      this.view.axes(this.find(".axes").checked);
      this.view.grippers(this.find(".grippers").checked);
      this.view.colors(this.find(".looks").checked);
      this._apply();
      const live = entries.filter((e) => e.view).sort((a, b) => b.used - a.used);
      for (const old of live.slice(LIVE)) old.hide();
      return this.view;
    }

    hide() {
      this.stop();
      this.stage.classList.remove("live");
      this.view.dispose();
      this.view = null;
    }

    // The wheel scrolls the page until the view was clicked, unless it is the only one; a click selects, Esc leaves.
    _habits() {
      const canvas = this.view.canvas, controls = this.view.controls, only = entries.length === 1;
      let down = null;
      controls.enableZoom = only;
      canvas.addEventListener("focus", () => { controls.enableZoom = true; });
      canvas.addEventListener("blur", () => { controls.enableZoom = only; });
      canvas.addEventListener("pointerdown", (e) => { down = [e.clientX, e.clientY]; canvas.focus({ preventScroll: true }); });
      canvas.addEventListener("pointerup", (e) => {
        if (!down || Math.hypot(e.clientX - down[0], e.clientY - down[1]) > 4 || e.button !== 0) return;
        const link = this.view.at(e);
        this.pick(link);
        const joint = this.data.joints.findIndex((j) => j.link === link);
        this.rows.get(joint)?.scrollIntoView({ block: "nearest" });
      });
      canvas.addEventListener("keydown", (e) => {
        if (e.key !== "Escape") return;
        this.pick(-1);
        canvas.blur();
      });
    }
  }

  for (const section of document.querySelectorAll("section[data-entry]")) {
    if (document.getElementById(`glb-${section.dataset.entry}`)) entries.push(new Entry(section, Number(section.dataset.entry)));
  }

  const seen = new IntersectionObserver((changes) => {
    for (const change of changes) {
      const entry = entries.find((e) => e.stage === change.target);
      entry.visible = change.isIntersecting;
      if (change.isIntersecting) entry.show();
      else entry.stop();
    }
  });
  for (const entry of entries) seen.observe(entry.stage);
  const sized = new ResizeObserver((changes) => {
    for (const change of changes) entries.find((e) => e.stage === change.target).view?.resize();
  });
  for (const entry of entries) sized.observe(entry.stage);

  let last = performance.now();
  function frame(now) {
    const seconds = Math.min(0.1, (now - last) / 1000);
    last = now;
    for (const entry of entries) if (entry.visible) entry.step(still.matches ? seconds / 2 : seconds);
    requestAnimationFrame(frame);
  }
  requestAnimationFrame(frame);

  // Pictures that a model was shown stand in the page once, and are put in place when someone opens them.
  const pictures = json("anymesh-pictures");
  for (const details of document.querySelectorAll("details.asked")) {
    details.addEventListener("toggle", () => {
      for (const image of details.querySelectorAll("img[data-picture]:not([src])")) {
        image.src = `data:image/jpeg;base64,${pictures[image.dataset.picture]}`;
      }
    });
  }

  // For tests and the curious: reads, never writes.
  window.anymesh = Object.freeze({
    count: entries.length,
    ready: (k) => Boolean(entries[k].view),
    positions: (k) => Object.fromEntries(entries[k].data.joints.map((joint, j) => [joint.name, entries[k].values[j]])),
    transforms: (k) => entries[k].view?.transforms() ?? null,
    picked: (k) => entries[k].data.links[entries[k].view?.picked]?.name ?? null,
    onScreen: (k, name) => entries[k].view?.onScreen(entries[k].data.links.findIndex((link) => link.name === name)) ?? null,
  });
})();
