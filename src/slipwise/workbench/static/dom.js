// Making elements without any text ever being taken for markup.

/** Make an element; attributes that begin with "on" are listeners, others that are false or null are left out. */
export function make(name, attributes = {}, ...children) {
  const element = document.createElement(name);
  for (const [key, given] of Object.entries(attributes)) {
    if (key.startsWith("on")) element.addEventListener(key.slice(2), given);
    else if (given !== false && given !== null && given !== undefined) element.setAttribute(key, given === true ? "" : given);
  }
  element.append(...children.filter((child) => child !== null && child !== undefined && child !== ""));
  return element;
}

export const find = (id) => document.getElementById(id);

/** Put options into a list, groups as [label, options]; the choice stays if it is still there. */
export function options(list, groups, chosen) {
  const before = chosen ?? list.value;
  list.replaceChildren(...groups.flatMap(([label, all]) => {
    const made = all.map(([value, words]) => make("option", { value }, words));
    return label && made.length ? [make("optgroup", { label }, ...made)] : made;
  }));
  if ([...list.options].some((option) => option.value === before)) list.value = before;
}

/** Give the value of a custom property of the style sheet. */
export const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
