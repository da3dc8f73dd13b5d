// The left side: the stages from data to the next test, what each has found, and the one click that goes on.

import { find, make } from "./dom.js";
import { drawGuide, judged } from "./guide.js";
import { floors } from "./units.js";

const same = (a, b) => JSON.stringify(a) === JSON.stringify(b);

/** Say whether a finding is of the model as it is. */
const stale = (finding, labels) => (finding && !same(finding.of, labels) ? " (of the model as it was then)" : "");

export function drawStages(campaign, state, ask) {
  const labels = state.effects.map((e) => e.label);
  const { locate, explain, discover, next, report } = state.findings;
  const held = campaign.runs.filter((r) => r.role === "holdout").length;
  const worst = state.errors.reduce((a, b) => (judged(b) > judged(a) ? b : a));
  const worstFitted = Math.max(...state.errors.map((e) => e.now.fitted));
  const good = Math.max(worst.now.held_out ?? 0, worstFitted) <= campaign.at_floor;
  const button = (job, words) => make("button", { id: `do-${job}`, class: "edits", onclick: () => ask({ do: job }) }, words);
  const link = (file, words) => make("p", {}, make("a", { href: file, target: "_blank", rel: "noopener" }, words));
  const stages = [
    ["Data", "done", [`${campaign.runs.length} runs on ${campaign.rig}, ${held} of them held out.`,
      ...(campaign.notes.length ? [make("details", {}, make("summary", {}, "Notes"), ...campaign.notes.map((n) => make("p", {}, n)))] : [])]],
    ["Instruments", locate ? (locate.accused ? "bad" : "done") : "", [locate ? locate.instruments : "Not checked yet."]],
    ["Model", state.fitted ? "done" : "here", [state.fitted ? "Fitted." : "Changed, not fitted yet.",
      `Worst: ${worst.name}, ${floors(judged(worst))} floors.`]],
    ["Where it fails", locate ? (good ? "done" : "bad") : "", [
      ...(locate ? (locate.places.length ? locate.places.slice(0, 3).map((p) => p.words + stale(locate, labels)) : ["Nowhere above the floor."]) : ["Not looked for yet."]),
      button("locate", "Look again")]],
    ["What is missing", explain ? (explain.effects.length ? "here" : "done") : "", [
      explain ? explain.words + stale(explain, labels) : "The catalogue has not been searched yet; that takes a minute or two.",
      ...(explain?.file ? [link(explain.file, "The diagnosis, in full")] : []),
      ...(explain?.rivals ?? []).map((r) => make("details", {}, make("summary", { id: `why-not-${r.effect}` }, `Why not ${r.effect}?`),
        ...r.words.map((w) => make("p", {}, w)), link(r.file, "What contradicts it, drawn"))), button("explain", "Find what is missing"),
      ...(discover ? [make("p", {}, discover.words + stale(discover, labels))] : []),
      ...(discover?.files?.length ? [make("button", { id: "do-law", class: "edits", onclick: () => ask({ do: "law" }) }, "Add this law")] : []),
      ...(explain ? [button("discover", "Find a law for what is unknown")] : [])]],
    ["Next test", next ? "done" : "", [next ? next.words + stale(next, labels) : "Which motion would separate the rivals.", button("next", "Propose a motion")]],
    ["Report", report ? "done" : "", report ? [link(report.file, "The report" + stale(report, labels))] : ["Written by the button above."]],
  ];
  find("stage-list").replaceChildren(...stages.map(([title, kind, pieces]) => make("li", { class: kind },
    make("strong", {}, title), ...pieces.map((piece) => (typeof piece === "string" ? make("p", {}, piece) : piece)))));
  drawGuide(state, campaign.at_floor, ask);
}
