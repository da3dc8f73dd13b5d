// Loops of every pad and of their sum, or clouds of the coefficient of friction: measured below, the model above.

import { colour, find, make } from "./dom.js";
import { factor, label, written } from "./units.js";

const ROOM = 0.12, LEFT = 40, BELOW = 22, TOP = 4, RIGHT = 6, SLOW = 0.002, FAST = 0.01;
const SHAPES = {
  loop: { points: false, x: "slip", xUnit: { si: "m", usual: "mm", factor: 1e-3 }, y: "force", yUnit: { si: "N", usual: "kN", factor: 1e3 } },
  speed: { points: true, x: "speed", xUnit: { si: "m/s", usual: "mm/s", factor: 1e-3 }, y: "coefficient", yUnit: { si: "1", usual: "1", factor: 1 } },
  pressure: { points: true, x: "pressure", xUnit: { si: "Pa", usual: "MPa", factor: 1e6 }, y: "coefficient", yUnit: { si: "1", usual: "1", factor: 1 } },
};

const summed = (columns) => (columns.length === 1 ? columns[0]
  : columns[0].map((_, i) => columns.reduce((all, column) => all + column[i], 0)));

export class Loops {
  constructor() {
    this.panels = [];
    this.window = [-Infinity, Infinity];
    new ResizeObserver(() => this.draw()).observe(find("loops"));
  }

  /** Show a run; `curves` may be null until the model has answered. */
  show(measured, curves, shape, area) {
    this.measured = measured;
    this.curves = curves;
    this.shape = SHAPES[shape];
    this.kind = shape;
    this.area = area;
    const names = [...measured.panels, ...(measured.panels.length > 1 ? ["Sum of the pads"] : [])];
    if (names.join() !== this.panels.map((p) => p.name).join()) this.#build(names);
    this.draw();
  }

  /** Only the model's curves have changed. */
  update(curves) {
    this.curves = curves;
    this.panels.forEach((panel, i) => this.#model(panel, i));
  }

  zoom(from, to) {
    this.window = [from, to];
    this.draw();
  }

  #build(names) {
    this.panels = names.map((name) => {
      const layers = [0, 1, 2].map(() => make("canvas", { "aria-hidden": "true" }));
      const said = make("span", {});
      const figure = make("figure", {}, make("figcaption", {}, name, said), make("div", { class: "layers", role: "img" }, ...layers));
      return { name, layers, said, figure };
    });
    find("loops").replaceChildren(...this.panels.map((p) => p.figure));
  }

  draw() {
    if (!this.measured) return;
    const { time } = this.measured.arrays;
    this.first = Math.max(0, time.findIndex((t) => t >= this.window[0]));
    const end = time.findIndex((t) => t > this.window[1]);
    this.last = end < 0 ? time.length : Math.max(end, this.first + 2);
    this.panels.forEach((panel, i) => { this.#ground(panel, i); this.#model(panel, i); });
  }

  /** Give x, y and where they count, of one panel; `force` of one pad or of all. */
  #points(place, force) {
    const { slip, velocity, load } = this.measured.arrays;
    const own = place < load.length ? load[place] : summed(load);
    const friction = place < force.length ? force[place] : summed(force);
    const pads = place < load.length ? 1 : load.length;
    const x = this.kind === "loop" ? slip : this.kind === "speed" ? velocity.map(Math.abs) : own.map((n) => n / (pads * this.area));
    const y = this.kind === "loop" ? friction : friction.map((f, i) => (f * Math.sign(velocity[i])) / own[i]);
    const least = this.kind === "pressure" ? FAST : SLOW;
    return { x, y, counts: this.shape.points ? (i) => Math.abs(velocity[i]) > least && own[i] > 0 : () => true };
  }

  #ground(panel, place) {
    const { x, y, counts } = this.#points(place, this.measured.arrays.force);
    let [x0, x1, y0, y1] = [Infinity, -Infinity, Infinity, -Infinity];
    for (let i = this.first; i < this.last; i++) {
      if (!counts(i)) continue;
      x0 = Math.min(x0, x[i]); x1 = Math.max(x1, x[i]); y0 = Math.min(y0, y[i]); y1 = Math.max(y1, y[i]);
    }
    if (this.shape.points) { y0 = 0; y1 = Math.min(y1, 0.5); x0 = Math.min(x0, 0); }
    const [wide, high] = [(x1 - x0) || 1, (y1 - y0) || 1];
    panel.limits = [x0 - ROOM * wide / 2, x1 + ROOM * wide / 2, y0 - ROOM * high, y1 + ROOM * high];
    panel.peak = Math.max(Math.abs(y0), Math.abs(y1));
    const pen = this.#clear(panel, 0);
    this.#axes(pen, panel);
    this.#line(pen, panel, { x, y, counts }, colour("measured"), 2.6);
  }

  #model(panel, place) {
    if (!panel.limits) return;
    const pen = this.#clear(panel, 1);
    if (!this.curves || this.curves.run !== this.measured.run) return;
    const { pads, beside_pads: beside } = this.curves.arrays;
    if (beside) this.#line(pen, panel, this.#points(place, beside), colour("warn"), 1);
    const own = this.#points(place, pads);
    this.#line(pen, panel, own, colour("model"), 1.1);
    let peak = 0;
    for (let i = this.first; i < this.last; i++) if (own.counts(i) && own.y[i] === own.y[i]) peak = Math.max(peak, Math.abs(own.y[i]));
    const unit = label(this.shape.yUnit);
    const read = (si) => `${written(si / factor(this.shape.yUnit), 3)}${unit && ` ${unit}`}`;
    panel.said.textContent = `${written(panel.peak / factor(this.shape.yUnit), 3)} / ${read(peak)}`;
    panel.figure.lastChild.setAttribute("aria-label",
      `${panel.name}, ${this.shape.y} over ${this.shape.x}: largest measured ${read(panel.peak)}, of the model ${read(peak)}`);
  }

  /** Mark the instant at which the histories' cursor stands. */
  mark(index) {
    this.panels.forEach((panel, place) => {
      const pen = this.#clear(panel, 2);
      if (index === null || index === undefined || !panel.limits) return;
      const { x, y } = this.#points(place, this.measured.arrays.force);
      const [px, py] = this.#at(panel, x[index], y[index]);
      pen.fillStyle = colour("ink");
      pen.beginPath();
      pen.arc(px, py, 4, 0, 7);
      pen.fill();
    });
  }

  #clear(panel, layer) {
    const canvas = panel.layers[layer], ratio = window.devicePixelRatio || 1;
    [panel.width, panel.height] = [canvas.clientWidth, canvas.clientHeight];
    const [w, h] = [Math.round(panel.width * ratio), Math.round(panel.height * ratio)];
    if (canvas.width !== w || canvas.height !== h) [canvas.width, canvas.height] = [w, h];
    const pen = canvas.getContext("2d");
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, panel.width, panel.height);
    return pen;
  }

  #at(panel, x, y) {
    const [x0, x1, y0, y1] = panel.limits;
    return [LEFT + ((x - x0) / (x1 - x0)) * (panel.width - LEFT - RIGHT),
      TOP + ((y1 - y) / (y1 - y0)) * (panel.height - TOP - BELOW)];
  }

  #line(pen, panel, { x, y, counts }, ink, width) {
    const [x0, x1, y0, y1] = panel.limits;
    const kx = (panel.width - LEFT - RIGHT) / (x1 - x0), ky = (panel.height - TOP - BELOW) / (y1 - y0);
    pen.save();
    pen.beginPath();
    pen.rect(LEFT, TOP, panel.width - LEFT - RIGHT, panel.height - TOP - BELOW);
    pen.clip();
    pen.strokeStyle = pen.fillStyle = ink;
    pen.lineWidth = width;
    pen.beginPath();
    let down = false;
    for (let i = this.first; i < this.last; i++) {
      if (!counts(i)) continue;
      const px = LEFT + (x[i] - x0) * kx, py = TOP + (y1 - y[i]) * ky;
      if (Number.isNaN(py)) down = false; // nothing is predicted there
      else if (this.shape.points) pen.rect(px, py, 1.5, 1.5);
      else if (down) pen.lineTo(px, py);
      else { pen.moveTo(px, py); down = true; }
    }
    if (this.shape.points) pen.fill(); else pen.stroke();
    pen.restore();
  }

  #axes(pen, panel) {
    const [x0, x1, y0, y1] = panel.limits, fx = factor(this.shape.xUnit), fy = factor(this.shape.yUnit);
    pen.font = "11px system-ui, sans-serif";
    pen.fillStyle = colour("muted");
    pen.strokeStyle = colour("line");
    pen.textAlign = "right";
    pen.textBaseline = "middle";
    for (const tick of ticks(y0 / fy, y1 / fy, 4)) {
      const [, py] = this.#at(panel, x0, tick * fy);
      pen.strokeRect(LEFT, py, panel.width - LEFT - RIGHT, 0);
      pen.fillText(written(tick, 3), LEFT - 4, py);
    }
    pen.textAlign = "center";
    pen.textBaseline = "top";
    for (const tick of ticks(x0 / fx, x1 / fx, 4)) {
      const [px] = this.#at(panel, tick * fx, y0);
      pen.strokeRect(px, TOP, 0, panel.height - TOP - BELOW);
      pen.fillText(written(tick, 3), px, panel.height - BELOW + 3);
    }
    const [xUnit, yUnit] = [label(this.shape.xUnit), label(this.shape.yUnit)];
    pen.textAlign = "right";
    pen.textBaseline = "bottom";
    pen.fillText(xUnit, panel.width - RIGHT, panel.height - BELOW - 2);
    pen.textAlign = "left";
    pen.textBaseline = "top";
    pen.fillText(yUnit, LEFT + 3, TOP + 1);
  }
}

/** Give round numbers between two ends, about so many. */
function ticks(low, high, about) {
  const raw = (high - low) / about, size = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((s) => s * size).find((s) => s >= raw);
  const out = [];
  for (let tick = Math.ceil(low / step) * step; tick <= high; tick += step) out.push(Math.abs(tick) < step / 1e6 ? 0 : tick);
  return out;
}
