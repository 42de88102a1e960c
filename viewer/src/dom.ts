/** An element with attributes and children. Attributes that are `false` are left out. */
export function element<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Record<string, string | boolean> = {},
  ...children: (Node | string)[]
): HTMLElementTagNameMap[K] {
  const result = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes))
    if (value !== false) result.setAttribute(name, value === true ? "" : value);
  result.append(...children);
  return result;
}

/** A button of one picture. `name` is what screen readers say and what shows when the pointer rests on it. */
export function iconButton(name: string, key: string, path: string, onClick: () => void): HTMLButtonElement {
  const button = element("button", { type: "button", class: "icon", "aria-label": name, title: `${name} (${key})` });
  setIcon(button, path);
  button.addEventListener("click", onClick);
  return button;
}

export function setIcon(button: HTMLButtonElement, path: string): void {
  button.innerHTML = `<svg viewBox="0 0 24 24" aria-hidden="true"><path d="${path}"/></svg>`;
}

export const kIcons = {
  play: "M7 4v16l13-8z",
  pause: "M6 4h4v16H6zM14 4h4v16h-4z",
  previous: "M5 4h3v16H5zM20 4v16L9 12z",
  next: "M16 4h3v16h-3zM4 4v16l11-8z",
  theme: "M12 3a9 9 0 1 0 0 18zM12 1.5a10.500 10.500 0 1 1 0 21 10.500 10.500 0 0 1 0-21m0 2a8.500 8.500 0 1 0 0 17 8.500 8.500 0 0 0 0-17",
  all: "M3 3h7v2H5v5H3zM14 3h7v7h-2V5h-5zM3 14h2v5h5v2H3zM19 14h2v7h-7v-2h5z",
  scene: "M6 2h9l4 4v16H5V2zm1 2v16h10V8h-4V4zm2 7h6v1.500H9zm0 3.500h6V16H9z",
  help: "M11 17h2v2h-2zM12 4a5 5 0 0 0-5 5h2a3 3 0 1 1 4.500 2.600C12 12.500 11 13.300 11 15h2c0-1 .6-1.400 1.500-2A5 5 0 0 0 12 4",
};

/** A switch with its name. */
export function checkbox(name: string, key: string, isOn: boolean, onChange: (isOn: boolean) => void): HTMLLabelElement {
  const input = element("input", { type: "checkbox" });
  input.checked = isOn;
  input.addEventListener("change", () => onChange(input.checked));
  return element("label", { class: "option", title: key ? `${name} (${key})` : name }, input, name);
}
