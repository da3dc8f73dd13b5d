// The error of every balance: how far above its noise floor, now, before, and of a model that stands beside.

import { find, make } from "./dom.js";
import { floors } from "./units.js";

/** Bars reach from 0 to this many floors, or as far as the largest error. */
const LEAST_REACH = 3;

const one = (found) => (found ? found.held_out ?? found.fitted : null);

/** Write an error in floors; a balance that no sample judges has none. */
const told = (found) => (found && one(found) === null ? "not judged" : floors(one(found)));

/** Draw every balance; an error up to `atFloor` is at the noise floor. */
export function drawErrors(errors, atFloor) {
  const all = errors.flatMap((e) => [e.now, e.before, e.beside]).filter(Boolean);
  const reach = Math.max(LEAST_REACH, ...all.flatMap((e) => [e.fitted ?? 0, e.held_out ?? 0]));
  const place = (error) => `${(100 * Math.log1p(error)) / Math.log1p(reach)}%`;
  const rows = errors.flatMap((e) => {
    const bar = make("div", { class: "bar", "aria-hidden": "true" });
    const add = (kind, error, wide) => {
      if (error === null || error === undefined) return;
      const piece = make("i", { class: kind });
      piece.style[wide ? "width" : "left"] = place(error);
      bar.append(piece);
    };
    add(one(e.now) > atFloor ? "over" : "", one(e.now), true);
    add("fitted", e.now.fitted, true);
    add("floor", 1, false);
    add("mark", one(e.before), false);
    add("beside", one(e.beside), false);
    return [
      make("tr", { "data-relation": e.relation }, make("th", { scope: "row" }, e.name),
        make("td", {}, told(e.before)), make("td", { class: "now" }, told(e.now)),
        make("td", { class: "fitted" }, floors(e.now.fitted)),
        errors.some((x) => x.beside) ? make("td", {}, told(e.beside)) : null),
      make("tr", {}, make("td", { class: "bars", colspan: 5 }, bar)),
    ];
  });
  const heads = ["balance", "before", "now", "fitted", ...(errors.some((e) => e.beside) ? ["beside"] : [])];
  const table = make("table", {}, make("caption", { class: "visually-hidden" }, "Error in multiples of the noise floor"),
    make("thead", {}, make("tr", {}, ...heads.map((h, i) => make(i ? "td" : "th", { scope: i ? null : "col" }, h)))),
    make("tbody", {}, ...rows));
  find("errors").replaceChildren(table);
}

/** Say in a sentence how the errors stand, for who hears the page. */
export function errorsInWords(errors) {
  const worst = errors.reduce((a, b) => (one(b.now) > one(a.now) ? b : a));
  return `Worst balance: ${worst.name}, ${floors(one(worst.now))} times its noise floor.`;
}
