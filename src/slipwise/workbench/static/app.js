// The page: what the server tells is drawn, what the user does is asked of the server.

import { find, options } from "./dom.js";
import { drawErrors, errorsInWords } from "./errors.js";
import { Effects } from "./effects.js";
import { Histories } from "./histories.js";
import { Link } from "./link.js";
import { Loops } from "./loops.js";
import { drawReadings } from "./readings.js";
import { drawStages } from "./stages.js";
import * as units from "./units.js";

const ONE = { si: "1", usual: "1", factor: 1 };
const FLOORS = { si: "floors", usual: "floors", factor: 1 };
const page = { campaign: null, state: null, measured: new Map(), curves: null, replay: null, noReplay: "", system: null, replays: new Map(), work: {}, moved: "" };
const view = { run: "", beside: "" };

const loops = new Loops();
const histories = new Histories((index) => loops.mark(index), (ends, whole) => {
  loops.zoom(...(ends ?? [-Infinity, Infinity]));
  const [from, to] = ends ?? whole;
  [find("from").value, find("to").value] = [from.toFixed(2), to.toFixed(2)];
});
const link = new Link(hear, (open) => {
  if (!open) tellProblem("The workbench does not answer; it is tried again until it does. Nothing is lost.");
  else { page.measured.clear(); page.moved = ""; tellProblem(""); page.work = {}; working(); }
});
const ask = (message) => { tellProblem(""); link.send(message); };
const effects = new Effects(ask, link);

function hear(message) {
  const act = {
    campaign: () => { page.campaign = message; drawCampaign(); },
    state: () => { page.state = message; drawState(); },
    measured: () => page.measured.set(message.run, message),
    curves: () => { page.curves = message; drawCurves(); },
    replay: () => { page.replay = message; page.replays.set(message.run, message); readings(); drawHistory(); },
    watched: () => { page.replays.set(message.run, message); drawHistory(); },
    "no replay": () => { page.replay = null; page.noReplay = message.words; readings(); },
    system: () => { page.system = message.errors; readings(); },
    progress: () => working(lane(message), { ...message, heard: performance.now() }),
    ended: () => { working(lane(message), null); if (!["replay", "watch", "system", "open"].includes(message.job)) say(message.how === "done" ? `${message.job} is done` : `${message.job}: ${message.how}`); },
    problem: () => tellProblem(message.words),
    moved: () => { page.moved = message.words; tellProblem(""); },
    over: () => { link.stop(); tellProblem(message.words); },
  }[message.kind];
  act?.();
}

const readings = () => drawReadings(page.replay, page.noReplay, page.system, page.campaign?.at_floor);
const say = (words) => { find("news").textContent = words; };

/** Show what is wrong; a folder that was moved stays told until it is back. */
function tellProblem(words) {
  const shown = words || page.moved;
  find("problem").textContent = shown;
  find("problem").hidden = !shown;
}

const lane = (message) => (message.aside ? "aside" : "asked");
/** The work that is told of: what a user has asked for, else what is done aside. */
const shownWork = () => page.work.asked ?? page.work.aside ?? null;

// Work that is silent for a while is seen to go on.
setInterval(() => {
  const work = shownWork();
  if (work) find("work-seconds").textContent = `${(work.seconds + (performance.now() - work.heard) / 1000).toFixed(0)} s`;
}, 500);

function working(place, message) {
  if (place) page.work[place] = message;
  const work = shownWork();
  find("work").hidden = !work;
  find("cancel").hidden = work?.job === "open";
  if (work) {
    find("work-words").textContent = `${work.job}: ${work.words}`;
    find("work-share").value = work.share;
    find("work-seconds").textContent = `${work.seconds.toFixed(0)} s`;
  }
  const fitting = Object.values(page.work).some((each) => each?.job === "fit");
  find("controls").disabled = fitting;
  for (const id of ["fit", "accept", "undo", "redo"]) find(id).disabled = fitting;
  const next = find("go-on");
  if (next) next.disabled = fitting || Boolean(page.work.asked || next.dataset.asked);
  if (!fitting && page.state) [find("undo").disabled, find("redo").disabled] = [!page.state.undo, !page.state.redo];
}

function drawCampaign() {
  const { campaign } = page;
  document.title = `${campaign.name} – Slipwise workbench`;
  find("campaign").textContent = campaign.name;
  options(find("run"), [["", campaign.runs.map((r) => [r.name, r.role === "holdout" ? `${r.name} (held out)` : r.name])]]);
  options(find("beside"), [["", [["", "nothing"], ["before", "the model before"], ["paper", "the rated model"]]],
    ["model files", campaign.models.map((name) => [name, name])]]);
  const together = !campaign.pads.length; // no pad's friction was measured: only what all bearings carry is known
  const sums = together ? [["pads:0", "force of all bearings"]] : campaign.pads.length > 1 ? [["pads:sum", "friction, sum of the pads"]] : [];
  const pads = [...sums, ...campaign.pads.map((p, i) => [`pads:${i}`, `friction, pad ${p}`])];
  for (const [place, option] of [...find("shape").options].entries()) option.hidden = option.disabled = together && place > 0;
  if (together) [find("shape").value, find("shape").options[0].textContent] = ["loop", "force over slip"];
  const balances = Object.entries(campaign.relations).filter(([r]) => r !== "pads").map(([r, { name }]) => [`balance:${r}`, name]);
  options(find("history"), [[together ? "bearings" : "pads", pads], ["balances", balances], ["channels", Object.keys(campaign.channels).map((c) => [`channel:${c}`, c])]]);
}

function drawState() {
  const { state, campaign } = page;
  find("standing").textContent = [state.words, ...(state.fitted ? [] : ["not fitted"]), ...(state.accepted ? ["accepted"] : [])].join(", ");
  find("undo").title = state.undo ? `Undo: ${state.undo}` : "";
  find("redo").title = state.redo ? `Redo: ${state.redo}` : "";
  drawStages(campaign, state, ask);
  effects.show(campaign, state);
  working();
  say(`${state.words}. ${errorsInWords(state.errors)}`);
}

function drawCurves() {
  const { curves } = page, measured = page.measured.get(curves.run);
  if (!measured) return;
  drawErrors(curves.errors, page.campaign.at_floor);
  if (view.run !== curves.run) { view.run = curves.run; find("run").value = curves.run; histories.ends = null; loops.window = [-Infinity, Infinity]; view.drawn = ""; }
  const kept = page.besideArrays;
  const brings = Object.keys(curves.arrays).some((name) => name.startsWith("beside"));
  if (brings) page.besideArrays = { run: curves.run, relation: curves.relation, pads: curves.arrays.beside_pads, predicted: curves.arrays.beside_predicted };
  else if (kept && view.beside && kept.run === curves.run && kept.relation === curves.relation)
    Object.assign(curves.arrays, { beside_pads: kept.pads, beside_predicted: kept.predicted }); // while dragging they stay
  const drawn = [curves.run, find("shape").value, units.chosen(), document.documentElement.dataset.theme].join();
  if (drawn === view.drawn) loops.update(curves);
  else loops.show(measured, curves, find("shape").value, page.campaign.pad_area);
  view.drawn = drawn;
  drawHistory();
}

function drawHistory() {
  const { curves, campaign } = page, measured = curves && page.measured.get(curves.run);
  if (!measured) return;
  const [kind, name] = find("history").value.split(":"), time = measured.arrays.time;
  const sum = (columns) => columns && columns[0].map((_, i) => columns.reduce((all, c) => all + c[i], 0));
  let shown;
  if (kind === "pads") {
    const of = (columns) => columns && (name === "sum" ? sum(columns) : columns[Number(name)]);
    const floors = curves.relation === "pads" ? curves.floor : null;
    const floor = floors && (name === "sum" ? Math.hypot(...floors) : floors[Number(name)]);
    shown = { unit: campaign.pad_unit, measured: of(measured.arrays.force), model: of(curves.arrays.pads), beside: of(curves.arrays.beside_pads), floor };
  } else if (kind === "balance") {
    if (curves.relation !== name) return look();
    const unit = curves.unit === "1" ? FLOORS : campaign.relations[name].unit;
    shown = { unit, measured: sum(curves.arrays.measured), model: sum(curves.arrays.predicted), beside: sum(curves.arrays.beside_predicted), floor: curves.floor[0] };
  } else {
    const replayed = page.replays.get(curves.run)?.arrays[`channel:${name}`];
    shown = { unit: campaign.channels[name]?.unit ?? ONE, measured: measured.arrays[`channel:${name}`],
      model: replayed && replayed.length === time.length ? replayed : null, beside: null, floor: null };
  }
  histories.show({ name: find("history").selectedOptions[0].textContent, time, ...shown });
}

function look() {
  const [kind, name] = find("history").value.split(":");
  view.beside = find("beside").value;
  find("beside-key").hidden = !view.beside;
  find("beside-key").textContent = find("beside").selectedOptions[0]?.textContent ?? "";
  if (!view.beside) page.besideArrays = null;
  link.send({ do: "look", run: find("run").value, relation: kind === "balance" ? name : "pads", beside: view.beside, watches: kind === "channel" });
}

function redraw() {
  view.drawn = "";
  if (page.state) { drawState(); drawCurves(); readings(); }
}

for (const job of ["fit", "accept", "undo", "redo", "report", "cancel"]) find(job).addEventListener("click", () => ask({ do: job }));
for (const id of ["run", "beside"]) find(id).addEventListener("change", look);
find("history").addEventListener("change", () => { drawHistory(); if (!find("history").value.startsWith("balance")) look(); });
find("shape").addEventListener("change", drawCurves);
find("whole").addEventListener("click", () => histories.zoom());
for (const id of ["from", "to"]) find(id).addEventListener("change", () => {
  const [from, to] = [Number(find("from").value), Number(find("to").value)];
  if (to > from) histories.zoom(from, to);
});
find("units").value = units.chosen();
find("units").addEventListener("change", ({ target }) => { units.choose(target.value); redraw(); });
find("theme").value = localStorage.getItem("theme") ?? "";
const dress = () => { document.documentElement.dataset.theme = find("theme").value; };
find("theme").addEventListener("change", ({ target }) => { localStorage.setItem("theme", target.value); dress(); redraw(); });
dress();
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
document.addEventListener("keydown", (event) => {
  if (!(event.ctrlKey || event.metaKey) || event.key.toLowerCase() !== "z" || event.target.matches("input[type=number], input[type=search]")) return;
  event.preventDefault();
  ask({ do: event.shiftKey ? "redo" : "undo" });
});
// A phone shows the session and does not change it.
const narrow = matchMedia("(max-width: 44rem)");
const lock = () => { find("effects").inert = narrow.matches; };
narrow.addEventListener("change", lock);
lock();
