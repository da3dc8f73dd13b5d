// Histories: measured and modelled over time, the residual below with its noise floor; both zoom and point together.

import { colour, find, make } from "./dom.js";
import { factor, label, written } from "./units.js";

const HEIGHT = [240, 150];

export class Histories {
  /** @param pointed called with the index under the cursor; @param zoomed called with the ends of the time shown */
  constructor(pointed, zoomed) {
    this.pointed = pointed;
    this.zoomed = zoomed;
    this.charts = [];
    this.shape = "";
    this.ends = null;
    new ResizeObserver(() => this.charts.forEach((c, i) => c.setSize({ width: this.#width(), height: HEIGHT[i] })))
      .observe(find("histories"));
  }

  #width() {
    return Math.max(280, find("histories").clientWidth);
  }

  /**
   * Show a quantity.
   * @param shown {name, unit, time, measured, model, beside, floor}: arrays in SI; model, beside and floor may be null
   */
  show(shown) {
    const by = factor(shown.unit), unit = label(shown.unit);
    const used = (array) => (array ? Array.from(array, (v) => (Number.isNaN(v) ? null : v / by)) : null);
    const [measured, model, beside] = [used(shown.measured), used(shown.model), used(shown.beside)];
    const above = [shown.time, measured, ...(model ? [model] : []), ...(beside ? [beside] : [])];
    const residual = model ? measured.map((m, i) => (model[i] === null ? null : m - model[i])) : null;
    const level = residual && shown.floor ? (2 * shown.floor) / by : null;
    const below = residual ? [shown.time, residual, ...(level ? [level, -level].map((y) => shown.time.map(() => y)) : [])] : null;
    const shape = [shown.name, unit, Boolean(model), Boolean(beside), Boolean(level), document.documentElement.dataset.theme,
      colour("ink")].join("|");
    if (shape !== this.shape) this.#build(shape, shown.name, unit, above, below, Boolean(beside));
    else [above, below].forEach((data, i) => data && this.#fill(this.charts[i], data));
    const said = residual?.filter((r) => r !== null);
    const rms = said ? Math.sqrt(said.reduce((s, r) => s + r * r, 0) / said.length) : null;
    find("histories").setAttribute("aria-label", `${shown.name}: ${rms === null
      ? "measured; the model says nothing of it here" : `residual ${written(rms, 3)} ${unit} rms`}`);
  }

  #fill(chart, data) {
    chart.setData(data, this.ends === null);
    if (this.ends) chart.setScale("x", { min: this.ends[0], max: this.ends[1] });
  }

  #build(shape, name, unit, above, below, beside) {
    this.shape = shape;
    this.charts.forEach((chart) => chart.destroy());
    const host = find("histories");
    host.setAttribute("role", "group");
    host.replaceChildren(make("div"), make("div"));
    const line = (words, ink, width = 1.2) => ({ label: words, stroke: ink, width, points: { show: false }, value: (_, v) => written(v) });
    const series = [line("measured", colour("measured"), 2.2), line("model", colour("model")), line("beside", colour("warn"))];
    const floor = { ...line("2 floors", colour("good"), 1), dash: [6, 4] };
    const axis = (words) => ({ stroke: colour("muted"), grid: { stroke: colour("line") }, ticks: { stroke: colour("line") }, label: words,
      labelSize: words ? 18 : 0, size: words ? 56 : 32 });
    const quantity = unit ? `${name} [${unit}]` : name;
    const chart = (data, lines, words, place, last) => new window.uPlot({
      width: this.#width(), height: HEIGHT[place],
      scales: { x: { time: false } },
      cursor: { sync: { key: "time" }, drag: { x: true, y: false } },
      series: [{ label: "time [s]", value: (_, v) => written(v) }, ...lines],
      axes: [{ ...axis(last ? "time [s]" : ""), size: last ? 40 : 28 }, axis(words)],
      hooks: {
        setCursor: [(u) => this.pointed(u.cursor.idx)],
        setScale: [(u, key) => key === "x" && this.#linked(u)],
      },
    }, data, host.children[place]);
    const top = beside ? series : series.slice(0, above.length - 1);
    this.charts = [chart(above, top, quantity, 0, !below)];
    if (below) this.charts.push(chart(below, [line("residual", colour("model"), 1), ...(below.length > 2 ? [floor, { ...floor, label: "−2 floors" }] : [])],
      unit ? `residual [${unit}]` : "residual", 1, true));
    if (this.ends) this.zoom(...this.ends);
  }

  /** One chart was zoomed: so are the other and the loops. */
  #linked(chart) {
    if (this.busy) return;
    this.busy = true;
    const { min, max } = chart.scales.x;
    const time = chart.data[0];
    const whole = min <= time[0] && max >= time[time.length - 1];
    this.ends = whole ? null : [min, max];
    this.charts.forEach((other) => other !== chart && other.setScale("x", { min, max }));
    this.zoomed(whole ? null : [min, max], [time[0], time[time.length - 1]]);
    this.busy = false;
  }

  /** Show part of the run; the whole of it without ends. */
  zoom(from, to) {
    const time = this.charts[0]?.data[0];
    if (time) this.charts[0].setScale("x", { min: from ?? time[0], max: to ?? time[time.length - 1] });
  }
}
