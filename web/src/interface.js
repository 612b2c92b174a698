// Pictures of an interface as SVG, in parallel projection: the faces turned to the viewer, farthest first.
import { hex, viridis } from "./colors.js";
import { nodesOfFace, numFaces, pointOfFace } from "./surface.js";
import { escaped, px } from "./svg.js";
import { readable } from "./text.js";
import { linearTicks } from "./ticks.js";
import { cross, dot, minus, unit } from "./vectors.js";

/** Where pictures, and at first the 3-D view, look from: 20° above the flow plane, 17° beside it. */
export const FIRST_VIEW = unit([0.3, 0.38, 1]);
/** Where the light comes from, to the right, up and toward the viewer: over the left shoulder. */
export const LIGHT = [-0.45, 0.6, 0.75];
/** Brightness of a side without light, what full light adds, and the share of white there. */
export const SHADING = { dark: 0.72, lit: 0.36, white: 0.16 };

const MARGIN = 10; // px around the widest frame
const SUBPIXEL = 0.1; // px; points are whole multiples: short text, finer than any screen
const EDGE_WHITENESS = 0.2; // of edges against their face, so that the mesh shows but does not dominate
const PLAIN = [115, 158, 191]; // colour of a frame without the field
const SILHOUETTE_PARTS = 4; // pieces of the edges of a curved face that is partly turned away

/** Axes of the picture in space: right, up, and toward the viewer; y points upwards. */
export function camera(toward = FIRST_VIEW) {
  const right = unit(cross([0, 1, 0], toward));
  return { right, up: cross(toward, right), toward };
}

const project = ({ right, up, toward }, x) => [dot(right, x), dot(up, x), dot(toward, x)];

function boxOf(frame, axes) {
  const [low, high] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
  for (const points of [frame.position, frame.middles ?? []]) {
    for (let i = 0; i < points.length; i += 3) {
      project(axes, points.slice(i, i + 3)).forEach((value, k) => {
        low[k] = Math.min(low[k], value);
        high[k] = Math.max(high[k], value);
      });
    }
  }
  return { low, high };
}

/** A view of all frames in which each fits into the width: the camera, `scale` in px, width and height. */
export function commonView(frames, width, toward = FIRST_VIEW) {
  const axes = camera(toward);
  const sizes = frames.map((frame) => boxOf(frame, axes)).map(({ low, high }) => minus(high, low));
  const [breadth, rise] = [0, 1].map((k) => Math.max(1e-12, ...sizes.map((size) => size[k])));
  const scale = (width - 2 * MARGIN) / Math.max(breadth, rise); // no picture is taller than wide
  return { ...axes, scale, width, height: Math.ceil(scale * rise + 2 * MARGIN) };
}

const tint = (color, share) => color.map((part) => part + share * (255 - part));

function litColor(color, view, n) {
  const light = unit([0, 1, 2].map((k) => LIGHT[0] * view.right[k] + LIGHT[1] * view.up[k] + LIGHT[2] * view.toward[k]));
  const share = Math.max(0, dot(n, light));
  const shaded = color.map((part) => Math.min(255, (SHADING.dark + SHADING.lit * share) * part));
  return tint(shaded, SHADING.white * share * share);
}

function faceColor(frame, f, coloring) {
  const values = coloring && frame.values[coloring.field];
  if (!values) return PLAIN;
  const mean = [0, 1, 2].reduce((sum, k) => sum + values[frame.index[3 * f + k]] / 3, 0);
  return viridis((mean - coloring.low) / (coloring.high - coloring.low));
}

/** Twice the area of the triangle abc on the picture; positive where it is turned to the viewer. */
const turned = ([ax, ay], [bx, by], [cx, cy]) => (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);

/**
 * Whether a face on the picture (its nodes as projected) is turned to the viewer: "whole", "none" or, of a
 * curved one, "part". At its nodes, ∂x/∂b × ∂x/∂c toward the viewer decides.
 */
function visibility(nodes) {
  if (nodes.length === 3) return turned(...nodes) > 0 ? "whole" : "none";
  const places = [[1, 0, 0], [0, 1, 0], [0, 0, 1], [0.5, 0.5, 0], [0, 0.5, 0.5], [0.5, 0, 0.5]];
  const count = places.filter(([a, b, c]) => {
    const along = (weights) => [0, 1].map((k) => weights.reduce((sum, w, i) => sum + w * nodes[i][k], 0));
    const slopeA = 4 * a - 1;
    const byB = along([-slopeA, 4 * b - 1, 0, 4 * (a - b), 4 * c, -4 * c]);
    const byC = along([-slopeA, 0, 4 * c - 1, -4 * b, 4 * b, 4 * (a - c)]);
    return byB[0] * byC[1] - byB[1] * byC[0] > 0;
  }).length;
  return count === 6 ? "whole" : count === 0 ? "none" : "part";
}

const rounded = ([x, y]) => [Math.round(x / SUBPIXEL) + 0, Math.round(y / SUBPIXEL) + 0];
const step = (a, b) => `${b[0] - a[0]} ${b[1] - a[1]}`;

/** The outline of a face: straight edges, or the parabolas that curved ones are in projection, exactly. */
function outline(nodes) {
  const points = nodes.map(rounded);
  const [a, b, c] = points;
  if (points.length === 3) return `M${a[0]} ${a[1]}l${step(a, b)} ${step(b, c)}z`;
  const bend = (from, to, middle) => rounded([0, 1].map((k) => 2 * nodes[middle][k] - 0.5 * (nodes[from][k] + nodes[to][k])));
  const controls = [bend(0, 1, 3), bend(1, 2, 4), bend(2, 0, 5)];
  return `M${a[0]} ${a[1]}q${step(a, controls[0])} ${step(a, b)} ${step(b, controls[1])} ${step(b, c)} ${step(c, controls[2])} ${step(c, a)}z`;
}

/** The border of the small flat pieces of a curved face that are turned to the viewer: by point, those after it. */
function visibleBorder(points, n) {
  const number = ([i, j]) => i * (n + 1) + j;
  const after = new Map();
  const add = (corners) => {
    const numbers = corners.map(number);
    if (turned(...numbers.map((k) => points[k])) >= 0) return; // y points downwards here
    numbers.forEach((from, k) => {
      const to = numbers[(k + 1) % 3];
      const back = after.get(to)?.indexOf(from) ?? -1;
      if (back >= 0) after.get(to).splice(back, 1); // between two pieces
      else after.set(from, [...(after.get(from) ?? []), to]);
    });
  };
  for (let i = 0; i < n; ++i) {
    for (let j = 0; i + j < n; ++j) {
      add([[i, j], [i + 1, j], [i, j + 1]]);
      if (i + j + 1 < n) add([[i + 1, j], [i + 1, j + 1], [i, j + 1]]);
    }
  }
  return after;
}

/** What is seen of a curved face that is partly turned away, and of its edges, as paths. */
function visiblePart(nodes) {
  const n = SILHOUETTE_PARTS;
  const flat = nodes.map(([x, y]) => [x, y, 0]);
  const points = [];
  for (let i = 0; i <= n; ++i) for (let j = 0; i + j <= n; ++j) points[i * (n + 1) + j] = pointOfFace(flat, (n - i - j) / n, i / n, j / n);
  const after = visibleBorder(points, n);
  const sides = (k) => { // which edges of the face a point lies on
    const [i, j] = [Math.floor(k / (n + 1)), k % (n + 1)];
    return [j === 0, i + j === n, i === 0];
  };
  const isOnEdge = (a, b) => sides(a).some((isOn, side) => isOn && sides(b)[side]);
  let [face, edges] = ["", ""];
  for (const [start, ends] of after) {
    while (ends.length > 0) {
      face += `M${rounded(points[start]).join(" ")}l`;
      let isDrawing = false;
      for (let from = start, to; (to = after.get(from)?.pop()) !== undefined; from = to) {
        const along = step(rounded(points[from]), rounded(points[to]));
        face += `${along} `;
        if (isOnEdge(from, to)) edges += isDrawing ? ` ${along}` : `M${rounded(points[from]).join(" ")}l${along}`;
        isDrawing = isOnEdge(from, to);
      }
      face = `${face.trimEnd()}z`;
    }
  }
  return { face, edges };
}

function drawFace({ nodes, isWhole, fill, stroke }) {
  if (isWhole) return `<path fill="${fill}" stroke="${stroke}" d="${outline(nodes)}"/>`;
  const { face, edges } = visiblePart(nodes);
  if (!face) return "";
  return `<path fill="${fill}" stroke="${fill}" d="${face}"/>` + (edges ? `<path fill="none" stroke="${stroke}" d="${edges}"/>` : "");
}

/**
 * A frame as the content of an `svg` element of the view's size, its middle in the middle. `coloring`:
 * {field, low, high}, or nothing for a plain surface. The faces are lit from the upper left.
 */
export function drawInterface(frame, view, coloring) {
  const { low, high } = boxOf(frame, view);
  const center = [0, 1].map((k) => 0.5 * (low[k] + high[k]));
  const seen = [];
  for (let f = 0; f < numFaces(frame); ++f) {
    const inSpace = nodesOfFace(frame, f);
    const projected = inSpace.map((x) => project(view, x));
    const isSeen = visibility(projected);
    if (isSeen === "none") continue;
    const n = unit(cross(minus(inSpace[1], inSpace[0]), minus(inSpace[2], inSpace[0])));
    const color = litColor(faceColor(frame, f, coloring), view, n);
    seen.push({
      depth: projected[0][2] + projected[1][2] + projected[2][2], isWhole: isSeen === "whole",
      nodes: projected.map(([x, y]) => [0.5 * view.width + view.scale * (x - center[0]), 0.5 * view.height - view.scale * (y - center[1])]),
      fill: hex(color), stroke: hex(tint(color, EDGE_WHITENESS)),
    });
  }
  seen.sort((a, b) => a.depth - b.depth); // stable
  return `<g class="mesh" transform="scale(${SUBPIXEL})" stroke-width="6">${seen.map(drawFace).join("")}</g>`;
}

/** A scale of colours with marks and a label, `width` px long, its upper left corner at (x, y). */
export function drawColorBar({ low, high, first = 0, last = 1 }, label, x, y, width) {
  const strips = 64; // finer than the eye resolves on this length
  let text = "";
  for (let i = 0; i < strips; ++i) {
    const overlap = i + 1 < strips ? 1.2 : 0; // so that no seam shows
    text += `<rect x="${px(x + (width * i) / strips)}" y="${px(y)}" width="${px(width / strips + overlap)}" height="10" fill="${hex(viridis(first + ((last - first) * (i + 0.5)) / strips))}"/>`;
  }
  const ticks = linearTicks(low, high, 5, false);
  ticks.values.forEach((value, i) => {
    const at = px(x + (width * (value - low)) / (high - low));
    text += `<text class="small" x="${at}" y="${px(y + 24)}" text-anchor="middle">${escaped(ticks.labels[i])}</text>`;
  });
  const factor = ticks.factor ? ` (${ticks.factor})` : "";
  return `${text}<text x="${px(x)}" y="${px(y - 7)}">${escaped(label)}${factor}</text>`;
}

/** The longest of 1, 2 and 5 times a power of ten that is not above `room`. */
export function longestRoundLength(room) {
  const power = Number(`1e${Math.floor(Math.log10(room))}`);
  return [5, 2, 1].map((digit) => digit * power).find((length) => length <= room) ?? power;
}

/** The arrows of the axes x, y, z around (x, y) as SVG, `arrow` px long where they lie in the picture. */
export function drawAxes({ right, up }, x, y, arrow) {
  return ["x", "y", "z"].map((name, k) => {
    const [dx, dy] = [arrow * right[k], -arrow * up[k]];
    return `<path class="ax" d="M${px(x)} ${px(y)}l${px(dx)} ${px(dy)}"/><text class="small" font-style="italic" x="${px(x + 1.4 * dx)}" y="${px(y + 1.4 * dy + 4)}" text-anchor="middle">${name}</text>`;
  }).join("");
}

/** Size of the key of a picture, in px. */
export const KEY = { width: 560, height: 62 };

/** The key of pictures of an interface: colours, the length R0 and the axes of the view. */
export function drawKey(view, coloring) {
  const colors = coloring
    ? drawColorBar(coloring, `${coloring.label}${coloring.unit ? ` [${coloring.unit}]` : ""}`, 10, 24, 260) : "";
  const shown = longestRoundLength(120 / view.scale);
  const length = shown * view.scale;
  const name = shown === 1 ? "R₀" : `${readable(shown, 1)} R₀`;
  return `${colors}<path class="ax" d="M310 29h${px(length)}m0 -4v8m-${px(length)} 0v-8"/><text x="${px(310 + length / 2)}" y="17" text-anchor="middle">${name}</text>${drawAxes(view, 490, 44, 26)}`;
}
