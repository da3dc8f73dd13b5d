// The right side: effects with switches, and every number of the model with its slider, interval, bounds and unit.

import { find, make } from "./dom.js";
import { factor, label, written } from "./units.js";

const STEPS = 1000, DECADES = 100;

/** A number that spans decades moves over its logarithm. */
const logarithmic = (n) => n.low > 0 && n.high / n.low > DECADES;

function toStep(n, value) {
  const share = logarithmic(n) ? Math.log(value / n.low) / Math.log(n.high / n.low) : (value - n.low) / (n.high - n.low);
  return STEPS * Math.min(1, Math.max(0, share));
}

const fromStep = (n, step) => (logarithmic(n) ? n.low * (n.high / n.low) ** (step / STEPS) : n.low + ((n.high - n.low) * step) / STEPS);

/** Say what a fit knows of a number. */
function known(n) {
  const read = (si) => written(si / factor(n.unit), 5);
  const bounds = `possible ${read(n.low)} to ${read(n.high)}`;
  if (!n.known) return bounds;
  const [low, high, bound, limit] = n.known;
  if (limit) return `at most ${read(high)} (95 %); ${bounds}`;
  if (bound) return `ended on its ${bound} bound; ${bounds}`;
  return `95 %: ${read(low)} to ${read(high)}; ${bounds}`;
}

export class Effects {
  /** @param ask called with a message for the server; @param link for numbers that are dragged */
  constructor(ask, link) {
    this.ask = ask;
    this.link = link;
    this.open = new Set();
    this.filter = "";
  }

  show(campaign, state) {
    const focused = document.activeElement?.id;
    this.campaign = campaign;
    this.limits = state.limits ?? {};
    const about = new Map([...campaign.effects, ...state.own].map((e) => [e.name, e]));
    const labels = new Set(state.effects.map((e) => e.label));
    const own = state.effects.map((e) => this.#card(about.get(e.name) ?? { name: e.name }, e, state.numbers.filter((n) => n.label === e.label)));
    const rig = state.numbers.filter((n) => !labels.has(n.label));
    find("in-model").replaceChildren(make("h3", {}, "In the model"), ...own,
      this.#fold("rig", "Numbers of the rig and its gauges", rig.map((n) => this.#number(n))));
    find("catalogue").replaceChildren(...this.#groups(campaign, state));
    if (focused && document.activeElement?.id !== focused) document.getElementById(focused)?.focus({ preventScroll: true });
  }

  #groups(campaign, state) {
    const used = new Set(state.effects.filter((e) => !e.group).map((e) => e.name));
    const found = state.findings.explain ?? { effects: [], minor: [], screened: [] };
    const gain = new Map();
    for (const s of found.screened) {
      const name = s.effect.split("[")[0];
      gain.set(name, Math.max(gain.get(name) ?? 0, s.gain ?? 0));
    }
    const free = campaign.effects.filter((e) => !used.has(e.name));
    const named = (names) => free.filter((e) => names.includes(e.name));
    const others = free.filter((e) => ![...found.effects, ...found.minor].includes(e.name) && !e.cannot)
      .sort((a, b) => (gain.get(b.name) ?? 0) - (gain.get(a.name) ?? 0));
    const cannot = free.filter((e) => e.cannot);
    const cards = (all) => all.map((e) => this.#card(e, null, []));
    const search = make("input", { type: "search", id: "filter", "aria-label": "Find an effect", placeholder: "find an effect", value: this.filter,
      oninput: ({ target }) => { this.filter = target.value; this.#hide(); } });
    const title = found.screened.length ? "Others, the most promising first" : "Others";
    const out = [
      ...(named(found.effects).length ? [make("h3", {}, "Missing and material"), ...cards(named(found.effects))] : []),
      ...(named(found.minor).length ? [make("h3", {}, "There, but minor"), ...cards(named(found.minor))] : []),
      make("h3", {}, title), search, make("div", { id: "others" }, ...cards(others)),
      this.#fold("cannot", "Cannot be tested here", cannot.map((e) => make("p", { class: "hint" }, `${e.name}: ${e.cannot}`))),
    ];
    queueMicrotask(() => this.#hide());
    return out;
  }

  #hide() {
    for (const card of find("others").children) card.hidden = !card.textContent.toLowerCase().includes(this.filter.toLowerCase());
  }

  #fold(name, title, children) {
    if (!children.length) return "";
    return make("details", { open: this.open.has(name), ontoggle: ({ target }) => (target.open ? this.open.add(name) : this.open.delete(name)) },
      make("summary", { id: `fold-${name}` }, title), ...children);
  }

  /** One effect; `use` is its place in the model, null where it is not in it. */
  #card(about, use, numbers) {
    const id = `switch-${use ? use.label : about.name}`;
    const targets = about.targets ?? [];
    const where = !use && targets.length
      ? make("select", { id: `target-${about.name}`, "aria-label": `Channel of ${about.name}` }, ...targets.map((t) => make("option", {}, t))) : null;
    const box = make("input", { type: "checkbox", role: "switch", id, checked: Boolean(use),
      onchange: () => this.ask({ do: "toggle", effect: about.name, target: use ? use.group : where ? where.value : "" }) });
    return make("div", { class: use ? "effect on" : "effect" },
      make("div", { class: "head" }, box, make("label", { for: id }, use ? use.label : about.name), where),
      make("p", {}, about.summary ?? ""), !use && this.limits[about.name] ? make("p", { class: "hint" }, this.limits[about.name]) : null,
      about.equation ? this.#fold(`about-${id}`, "Equation and signature",
        [make("p", {}, make("code", {}, about.equation)), make("p", {}, about.signature ?? "")]) : null,
      ...numbers.map((n) => this.#number(n)));
  }

  #number(n) {
    const id = `number-${n.key}`, read = (si) => Number((si / factor(n.unit)).toPrecision(6));
    const said = make("p", { class: "known", id: `${id}-known` }, known(n));
    const exact = make("input", { type: "number", step: "any", id: `${id}-exact`, value: read(n.value), "aria-label": `${n.name}, exactly`,
      min: read(n.low), max: read(n.high),
      onchange: ({ target }) => target.value !== "" && this.ask({ do: "set", key: n.key, value: Number(target.value) * factor(n.unit) }) });
    const slide = make("input", { type: "range", min: 0, max: STEPS, step: 1, id, value: toStep(n, n.value), "aria-describedby": said.id,
      oninput: ({ target }) => {
        const value = fromStep(n, Number(target.value));
        exact.value = read(value);
        target.setAttribute("aria-valuetext", `${written(read(value))} ${label(n.unit)}`);
        this.link.drag(n.key, value);
      },
      onchange: () => this.link.release() });
    slide.setAttribute("aria-valuetext", `${written(read(n.value))} ${label(n.unit)}`);
    const track = make("div", { class: "track" }, slide);
    if (n.known && n.known[0] !== null && n.known[1] !== null) {
      const mark = make("i", { "aria-hidden": "true" });
      mark.style.left = `${toStep(n, n.known[0]) / 10}%`;
      mark.style.width = `${(toStep(n, n.known[1]) - toStep(n, n.known[0])) / 10}%`;
      track.append(mark);
    }
    return make("div", { class: "number" },
      make("div", { class: "name" }, make("label", { for: id }, n.name), make("span", { class: "value" }, `${written(read(n.value))} ${label(n.unit)}`)),
      make("div", { class: "row" }, track, exact, make("span", { class: "unit" }, label(n.unit))), said);
  }
}
