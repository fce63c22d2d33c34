// One small box that says in full what a cell has no room for, on hover and on keyboard focus.
import { h } from "../dom";

const box = h("div", { class: "full-text", role: "tooltip", hidden: true });

/** Shows `text` below `at`; null hides it. */
export function fullText(text: string | null, at?: DOMRect): void {
  box.hidden = text === null || !at;
  if (text === null || !at) return;
  if (!box.isConnected) document.body.append(box);
  box.textContent = text;
  const left = Math.min(Math.max(at.left, 6), window.innerWidth - box.offsetWidth - 6);
  const below = at.bottom + 4 + box.offsetHeight < window.innerHeight;
  box.style.left = `${Math.max(6, left)}px`;
  box.style.top = `${below ? at.bottom + 2 : at.top - box.offsetHeight - 2}px`;
}
