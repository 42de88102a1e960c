import { element } from "./dom";

/** Something in the picture that can be pointed at. */
export interface Target {
  text: string;
  choose: () => void;
}

/** px; a pointer that has moved farther between down and up has turned the picture. */
const kClickPixels = 4;

/** Tells what the pointer rests on in the picture, and chooses it at a click. `find`: what is at a place, px. */
export function watchPointer(
  container: HTMLElement,
  canvas: HTMLElement,
  find: (x: number, y: number) => Target | null,
): void {
  const tip = element("div", { class: "tip", hidden: true });
  container.append(tip);
  let down: [number, number] | null = null;
  const hide = (): void => {
    tip.hidden = true;
    canvas.style.cursor = "";
  };
  canvas.addEventListener("pointerdown", (event) => {
    down = [event.offsetX, event.offsetY];
    hide();
  });
  canvas.addEventListener("pointermove", (event) => {
    const target = event.buttons === 0 ? find(event.offsetX, event.offsetY) : null;
    if (!target) return hide();
    tip.textContent = target.text;
    tip.hidden = false;
    canvas.style.cursor = "pointer";
    const left = Math.min(event.offsetX + 12, container.clientWidth - tip.offsetWidth - 4);
    tip.style.transform = `translate(${Math.max(0, left)}px, ${Math.max(0, event.offsetY - tip.offsetHeight - 10)}px)`;
  });
  canvas.addEventListener("pointerleave", hide);
  canvas.addEventListener("pointerup", (event) => {
    const [x, y] = [event.offsetX, event.offsetY];
    if (down && Math.hypot(x - down[0], y - down[1]) < kClickPixels) find(x, y)?.choose();
    down = null;
  });
}
