// Numbers as people read them: kN, mm, MPa or SI, four significant figures.

let system = localStorage.getItem("units") || "usual";

export const chosen = () => system;

export function choose(name) {
  system = name;
  localStorage.setItem("units", name);
}

/** @param unit {si, usual, factor}: value [SI] = factor * value [usual] */
export const factor = (unit) => (system === "si" ? 1 : unit.factor);

export function label(unit) {
  const name = system === "si" ? unit.si : unit.usual;
  return name === "1" ? "" : name.replace("^2", "²").replace("^3", "³").replaceAll("*", " ");
}

export const value = (unit, si) => si / factor(unit);

/** Write a number with four significant figures, without zeros that say nothing. */
export function written(number, figures = 4) {
  if (number === null || number === undefined || !Number.isFinite(number)) return "–";
  const text = Number(number).toPrecision(figures);
  const short = text.includes("e") ? Number(text).toExponential() : String(Number(text));
  return short.replace("-", "−");
}

/** Write an error in floors. */
export const floors = (error) => (error === null || error === undefined ? "–" : error < 100 ? error.toFixed(2) : error.toFixed(0));
