// Pieces of SVG as text, of numbers that are rounded: equal data give equal bytes.
import { pictureStyle } from "./colors.js";

/** A text for HTML and SVG, also between quotes; control characters, which XML lacks, are left out. */
export function escaped(text) {
  return String(text)
    .replace(/[^\P{Cc}\n\t]/gu, "")
    .replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll(">", "&gt;").replaceAll('"', "&quot;");
}

/** A length in px to a tenth. */
export function px(length) {
  return String(Math.round(10 * length) / 10 + 0); // + 0: no minus before a zero
}

/** A group of the content, moved by (x, y). */
export function moved(content, x, y) {
  return `<g transform="translate(${px(x)} ${px(y)})">${content}</g>`;
}

/** The content as an `svg` element of a page; screen readers read `label`. */
export function inlineSvg(content, width, height, label) {
  return `<svg viewBox="0 0 ${px(width)} ${px(height)}" role="img" aria-label="${escaped(label)}">${content}</svg>`;
}

/** The content as a whole .svg file with the style sheet of all pictures. */
export function svgFile(content, width, height) {
  const size = `width="${px(width)}" height="${px(height)}"`;
  return `<?xml version="1.0" encoding="UTF-8"?>
<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${px(width)} ${px(height)}" ${size}><style>${pictureStyle()}</style><rect class="bg" ${size}/>${content}</svg>
`;
}
