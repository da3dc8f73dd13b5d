// What an engineer reads off the replay of a held-out run: measured, modelled, and without what was added.

import { find, make } from "./dom.js";
import { factor, floors, label, written } from "./units.js";

const NAMES = { peak_slip: "peak slip", energy: "energy dissipated by the pads", largest_load: "largest load of a pad", uplift: "time with a pad lifted off" };
const USUAL = { m: ["mm", 1e-3], J: ["kN cm", 10], N: ["kN", 1e3], s: ["s", 1] };

/** Say what a channel of the replay is called; `*` stands for every pad. */
const CHANNELS = { slip_x: "slip along", slip_y: "slip across", girder_ax: "girder acceleration along", girder_ay: "girder acceleration across",
  girder_az: "girder acceleration, vertical", "pad_*_N": "loads of the pads", "pad_*_Fx": "friction of the pads, along", "pad_*_Fy": "friction of the pads, across" };

/** Give the errors at system level as a table; nothing while they are not known. */
function systemErrors(system, atFloor) {
  if (!system || !Object.keys(system).length) return system === null ? make("p", { class: "hint" }, "The error of the replay follows.") : null;
  const rows = Object.entries(system).map(([name, error]) => make("tr", {},
    make("th", { scope: "row" }, CHANNELS[name] ?? name), make("td", { class: error <= atFloor ? "" : "over" }, floors(error))));
  return make("table", { id: "system" }, make("caption", {}, "Error of the replay, in multiples of its noise floor (held-out runs)"), make("tbody", {}, ...rows));
}

export function drawReadings(replay, words, system, atFloor) {
  const host = find("readings");
  if (!replay) return host.replaceChildren(make("p", {}, words || "The held-out run has not been replayed yet."));
  const heads = ["", "measured", "model", ...(replay.without ? ["without what was added", "change without it"] : [])];
  const rows = Object.entries(replay.units).map(([name, si]) => {
    const unit = { si, usual: USUAL[si][0], factor: USUAL[si][1] };
    const read = (found) => (found === undefined ? "–" : `${written(found / factor(unit))} ${label(unit)}`);
    const now = replay.now[name], without = replay.without?.[name];
    const change = without === undefined || !now ? "–" : `${written(100 * (without / now - 1), 2)} %`;
    return make("tr", {}, make("th", { scope: "row" }, NAMES[name]), make("td", {}, read(replay.measured[name])), make("td", {}, read(now)),
      ...(replay.without ? [make("td", {}, read(without)), make("td", {}, change)] : []));
  });
  const what = replay.left_out.length ? `; without ${replay.left_out.join(", ")}` : "";
  host.replaceChildren(make("table", {}, make("caption", {}, `Replay of ${replay.run} from the table's motion alone${what}`),
    make("thead", {}, make("tr", {}, ...heads.map((h) => (h ? make("th", { scope: "col" }, h) : make("td", {}))))), make("tbody", {}, ...rows)), systemErrors(system, atFloor) ?? "");
}
