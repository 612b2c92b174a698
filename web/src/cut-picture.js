// Pictures of a cut through the tetrahedra as SVG.
import { hex, liquidOf, viridis } from "./colors.js";
import { readable } from "./text.js";

export const BEST_ANGLE = 60; // degrees; the regular tetrahedron has 70.5, a good mesh little above 60
const SUBPIXEL = 0.1; // px; points are whole multiples

/** "z = 0.5", the plane of a cut. */
export function planeText(cut) {
  return `${"xyz"[cut.normal]} = ${readable(Math.abs(cut.offset) < 1e-9 ? 0 : cut.offset, 3)}`;
}

/** Height of the window of a cut that is `width` px wide. */
export function cutHeight(cut, width) {
  const [left, bottom, right, top] = cut.window;
  return Math.ceil((width * (top - bottom)) / Math.max(right - left, 1e-12));
}

/** What is drawn of polygon p: the attribute with its colour. */
function fillOf(cut, coloring) {
  if (coloring.kind === "liquid") return (p) => `class="q${liquidOf(cut.region[p])}"`;
  if (coloring.kind === "quality") return (p) => `fill="${hex(viridis(cut.quality[p] / BEST_ANGLE))}"`;
  const values = cut.values[coloring.field];
  return (p) => `fill="${hex(viridis((values?.[p] - coloring.low) / (coloring.high - coloring.low)))}"`;
}

/**
 * A cut, `width` px wide. `coloring`: {kind: "liquid"}, {kind: "quality"} or {kind: "field", field, low,
 * high}. A nested svg element leaves out what reaches beyond the window.
 */
export function drawCut(cut, coloring, width) {
  const [left, , right, top] = cut.window;
  const scale = width / Math.max(right - left, 1e-12) / SUBPIXEL;
  const height = cutHeight(cut, width);
  const fill = fillOf(cut, coloring);
  let paths = "";
  let corner = 0;
  for (let p = 0; p < cut.polygons; ++p) {
    const points = Array.from({ length: cut.corners[p] }, (_, k) =>
      `${Math.round(scale * (cut.x[corner + k] - left)) + 0} ${Math.round(scale * (top - cut.y[corner + k])) + 0}`);
    corner += cut.corners[p];
    paths += `<path ${fill(p)} d="M${points.join("L")}z"/>`;
  }
  return `<svg width="${width}" height="${height}" viewBox="0 0 ${width / SUBPIXEL} ${height / SUBPIXEL}"><g class="cut" stroke-width="5"><g class="${coloring.kind === "liquid" ? "liquid" : "values"}">${paths}</g></g></svg>`;
}

/** "drop 3", what a region is; ids of drops are never used twice, so that after an event they skip numbers. */
export function liquidName(cut, region) {
  if (region === 0) return "matrix";
  const drop = cut.drops[region - 1] ?? -1;
  return drop < 0 ? `region ${region}` : `drop ${drop}`;
}

/** The key to the colours of the liquids of a cut, from (x, y) to the right. */
export function drawLiquidKey(cut, x, y) {
  const regions = [...new Set(cut.region)].sort((a, b) => a - b).slice(0, 5);
  return regions.map((region, k) => {
    const name = region > 0 && cut.drops.length === 1 ? "drop" : liquidName(cut, region);
    return `<rect class="ax" x="${x + 80 * k}" y="${y - 10}" width="12" height="12"/><rect class="q${liquidOf(region)}" x="${x + 80 * k}" y="${y - 10}" width="12" height="12"/><text x="${x + 80 * k + 18}" y="${y}">${name}</text>`;
  }).join("");
}
