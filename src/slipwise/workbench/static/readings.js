// What an engineer reads off the replay of a held-out run: measured, modelled, and without what was added.

import { find, make } from "./dom.js";
import { factor, label, written } from "./units.js";

const NAMES = { peak_slip: "peak slip", energy: "energy dissipated by the pads", largest_load: "largest load of a pad", uplift: "time with a pad lifted off" };
const USUAL = { m: ["mm", 1e-3], J: ["kN cm", 10], N: ["kN", 1e3], s: ["s", 1] };

export function drawReadings(replay, words) {
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
    make("thead", {}, make("tr", {}, ...heads.map((h) => (h ? make("th", { scope: "col" }, h) : make("td", {}))))), make("tbody", {}, ...rows)));
}
