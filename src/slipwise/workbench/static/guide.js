// The one step that leads on from here, offered as a sentence and a button; whoever follows it ends at an accepted model.

import { find, make } from "./dom.js";
import { floors } from "./units.js";

/** Give the error of a balance by which it is judged: of held-out runs, where any are. */
export const judged = (error) => error.now.held_out ?? error.now.fitted;

const same = (a, b) => JSON.stringify(a) === JSON.stringify(b);
const labelOf = (s) => (s.group ? `${s.effect}[${s.group}]` : s.effect);

/**
 * Say what to do next: {words, button, message}; without a button where nothing is left to be done here.
 * @param atFloor an error up to this is at the noise floor [floors]
 */
export function nextStep(state, atFloor) {
  const labels = state.effects.map((e) => e.label);
  const { explain, discover, next } = state.findings;
  const worst = state.errors.reduce((a, b) => (judged(b) > judged(a) ? b : a));
  const left = judged(worst) <= atFloor ? "every balance is at its noise floor" : `${worst.name} is left at ${floors(judged(worst))} floors`;
  const current = explain && same(explain.of, labels);
  const missing = (explain?.suggestion ?? []).filter((s) => !labels.includes(labelOf(s)));
  const follows = explain && explain.of.every((label) => labels.includes(label));
  const accept = { words: `Fitted: ${left}. Accept keeps this model as model.toml.`, button: "Accept", message: { do: "accept" } };

  if (!state.fitted) return { words: state.words === "opened" ? "A fit brings the model as near to the measurement as it comes." : "The model was changed: a fit shows how far the error falls.", button: "Fit", message: { do: "fit" } };
  const matters = explain?.effects.length || judged(worst) > atFloor;
  if (missing.length && follows && matters) {
    const names = missing.map((s) => s.effect).join(" and ");
    if (!explain.effects.length)
      return { words: `Nothing that matters is missing. ${names} ${missing.length > 1 ? "are" : "is"} there and hardly changes what an engineer reads off; ${left}. Accept keeps the model as it is.`, button: `Add ${names}`, message: { do: "take" } };
    return { words: `The diagnosis names ${names}.`, button: `Add ${names}`, message: { do: "take" } };
  }
  if (current) {
    const law = same(discover?.of, labels) && discover.files?.length;
    if (explain.leftover === "unknown" && law) return { words: discover.words, button: "Add this law", message: { do: "law" } };
    if (explain.leftover === "unknown" && !same(discover?.of, labels))
      return { words: "No effect of the catalogue explains what is left.", button: "Find a law for it", message: { do: "discover" } };
    if (!state.accepted) return accept;
    if (explain.verdict === "ambiguous" && !same(next?.of, labels))
      return { words: "Several effects explain this campaign as well; another motion may tell them apart.", button: "Propose a motion", message: { do: "next" } };
    return { words: `Nothing is missing that this campaign can show: ${left}, and the model is accepted.` };
  }
  const added = state.words === "fitted" && explain && follows && labels.length > explain.of.length;
  if (added && !state.accepted) return accept;
  if (added && judged(worst) <= atFloor) return { words: "Accepted: every balance is at its noise floor." };
  return { words: `Fitted: ${left}. The search for what is missing takes a minute or two.`, button: "Find what is missing", message: { do: "explain" } };
}

/** A step is asked for once: what it leads to draws another button, however long the answer takes. */
function once(button, act) {
  if (button.dataset.asked) return;
  button.dataset.asked = "yes";
  button.disabled = true;
  button.setAttribute("aria-busy", "true");
  act();
}

export function drawGuide(state, atFloor, ask) {
  const { words, button, message } = nextStep(state, atFloor);
  find("suggestion").replaceChildren(make("h3", {}, "Next step"), make("p", { id: "guide-words" }, words),
    ...(button ? [make("button", { id: "go-on", class: "main edits", onclick: (event) => once(event.currentTarget, () => ask(message)) }, button)] : []));
}
