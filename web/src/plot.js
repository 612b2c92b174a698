// A plot as SVG: {title, unit, xLabel, yLabel, curves, marks, isLog, includesZero, hasEqualScales, window,
// width, height}. A curve: {name, legend, x, y, color, dash, isReference, stroke}; it has a gap where x or y
// is not finite (or y not positive on a logarithmic axis), and a dot where a value stands between two gaps.
// `window`: [low, high] of x that is shown, all where there is none. Marks: [{x, label}].
import { NUM_CURVE_COLORS } from "./colors.js";
import { escaped, px } from "./svg.js";
import { linearTicks, logTicks } from "./ticks.js";

// In px; letters are 12 px high and about 6.6 px wide.
const LETTER_WIDTH = 6.6;
const TITLE_LINE = 18;
const LEGEND_LINE = 38;
const LINE_SAMPLE = 20;
const MARGIN = { right: 14, bottom: 38, side: 14 };

/** Beyond 10^±300 differences and quotients overflow. No result of a run is that large. */
const LARGEST_DRAWABLE = 1e300;

const isWithin = (value) => Math.abs(value) < LARGEST_DRAWABLE;

function isDrawable(plot, x, y) {
  return isWithin(x) && isWithin(y) && (!plot.isLog || y > 1 / LARGEST_DRAWABLE);
}

export function hasValues(plot) {
  return plot.curves.some(({ x, y }) => y.some((value, i) => isDrawable({ isLog: false }, x[i], value)));
}

class Extent {
  constructor(low = Infinity, high = -Infinity) {
    Object.assign(this, { low, high });
  }
  add(value) {
    this.low = Math.min(this.low, value);
    this.high = Math.max(this.high, value);
  }
  orElse(low, high) {
    return this.low > this.high ? new Extent(low, high) : this;
  }
}

/** The values that the lines of a curve have at the ends of a window. */
function valuesAtEnds(plot, { x, y }, ends) {
  const values = [];
  for (let i = 1; i < x.length; ++i) {
    if (!isDrawable(plot, x[i - 1], y[i - 1]) || !isDrawable(plot, x[i], y[i])) continue;
    for (const end of ends) {
      if ((x[i - 1] - end) * (x[i] - end) >= 0) continue;
      const share = (end - x[i - 1]) / (x[i] - x[i - 1]);
      // Lines are straight on the picture.
      values.push(plot.isLog ? Math.exp((1 - share) * Math.log(y[i - 1]) + share * Math.log(y[i])) : (1 - share) * y[i - 1] + share * y[i]);
    }
  }
  return values;
}

/** The smallest and largest values that are shown. */
function dataExtents(plot) {
  const [x, y] = [new Extent(), new Extent()];
  const [least, most] = plot.window ?? [-Infinity, Infinity];
  for (const curve of plot.curves) {
    curve.x.forEach((t, i) => {
      if (!(t >= least && t <= most)) return;
      // The x-axis includes gaps of y, so that all plots of a run have the same x-axis.
      if (isWithin(t)) x.add(t);
      if (isDrawable(plot, t, curve.y[i])) y.add(curve.y[i]);
    });
    if (plot.window) valuesAtEnds(plot, curve, plot.window).forEach((value) => y.add(value));
  }
  const extents = { x: plot.window ? new Extent(...plot.window) : x.orElse(0, 1), y: y.orElse(1, 10) };
  if (plot.includesZero && !plot.isLog) extents.y.add(0);
  return extents;
}

/** Widens one range until both axes have the same scale on the picture. */
function withEqualScales({ x, y }, width, height) {
  const slack = 1.08; // room between the curves and the frame
  const unit = slack * Math.max((x.high - x.low) / width, (y.high - y.low) / height, 1e-12);
  const around = ({ low, high }, length) =>
    new Extent(0.5 * (low + high) - 0.5 * unit * length, 0.5 * (low + high) + 0.5 * unit * length);
  return { x: around(x, width), y: around(y, height) };
}

const textWidth = (text) => LETTER_WIDTH * [...text].length;

/** Where the plot lies on the picture and what its axes cover: {left, right, top, bottom, x, y, toX, toY, ofX}. */
export function plotArea(plot) {
  const area = {
    left: MARGIN.side + 44, right: plot.width - MARGIN.right, bottom: plot.height - MARGIN.bottom,
    top: plot.curves.some(({ legend }) => legend) ? 52 : 36,
  };
  let extents = dataExtents(plot);
  if (plot.hasEqualScales) extents = withEqualScales(extents, area.right - area.left, area.bottom - area.top);
  const count = (length, spacing) => Math.max(2, Math.floor(length / spacing)); // one mark per `spacing` px
  area.y = plot.isLog
    ? logTicks(extents.y.low, extents.y.high)
    : linearTicks(extents.y.low, extents.y.high, count(area.bottom - area.top, 45), !plot.hasEqualScales);
  if (!plot.hasEqualScales) {
    area.left = MARGIN.side + Math.max(...area.y.labels.map(textWidth), 0) + 8 + (plot.yLabel ? 18 : 0);
  }
  area.x = linearTicks(extents.x.low, extents.x.high, count(area.right - area.left, 75), false);
  const { left, right, top, bottom, x, y } = area;
  const share = plot.isLog
    ? (value) => Math.log(value / y.min) / Math.log(y.max / y.min)
    : (value) => (value - y.min) / (y.max - y.min);
  area.toX = (value) => left + ((value - x.min) / (x.max - x.min)) * (right - left);
  area.ofX = (at) => x.min + ((at - left) / (right - left)) * (x.max - x.min);
  area.toY = (value) => bottom - share(value) * (bottom - top);
  return area;
}

function drawAxes(plot, { left, right, top, bottom, x, y, toX, toY }) {
  const text = (at, anchor, label, more = "") => `<text${more} ${at} text-anchor="${anchor}">${escaped(label)}</text>`;
  let grid = "";
  let labels = "";
  x.values.forEach((value, i) => {
    grid += `M${px(toX(value))} ${px(top)}V${px(bottom)}`;
    labels += text(`x="${px(toX(value))}" y="${px(bottom + 16)}"`, "middle", x.labels[i]);
  });
  y.values.forEach((value, i) => {
    grid += `M${px(left)} ${px(toY(value))}H${px(right)}`;
    labels += text(`x="${px(left - 7)}" y="${px(toY(value) + 4)}"`, "end", y.labels[i]);
  });
  if (y.factor) labels += text(`x="${px(right)}" y="${px(top - 6)}"`, "end", y.factor, ' class="small"');
  const xLabel = (plot.xLabel ?? "") + (x.factor ? ` (${x.factor})` : "");
  labels += text(`x="${px((left + right) / 2)}" y="${px(bottom + 33)}"`, "middle", xLabel);
  if (plot.yLabel) {
    labels += text(`transform="translate(${MARGIN.side} ${px((top + bottom) / 2)}) rotate(-90)"`, "middle", plot.yLabel);
  }
  return `<path class="grid" d="${grid}"/><path class="ax" d="M${px(left)} ${px(top)}V${px(bottom)}H${px(right)}"/>${labels}`;
}

/** The attributes of a curve's line. */
export function strokeOf({ color = 0, dash = 0, isReference, stroke }) {
  const classes = ["ln", isReference ? "ref" : stroke ? "" : `s${color % NUM_CURVE_COLORS}`, dash ? `d${dash}` : ""];
  return `class="${classes.filter(Boolean).join(" ")}"${stroke ? ` style="stroke:${stroke}"` : ""}`;
}

function drawHeading(plot, { right }) {
  const unit = plot.unit ? ` <tspan class="unit">[${escaped(plot.unit)}]</tspan>` : "";
  let text = `<text class="ttl" x="${MARGIN.side}" y="${TITLE_LINE}">${escaped(plot.title)}${unit}</text>`;
  let x = MARGIN.side;
  for (const curve of plot.curves) {
    if (!curve.legend) continue;
    const next = x + LINE_SAMPLE + 6 + textWidth(curve.legend) + 14;
    if (next > right + 14) break; // curves without room in the legend still have a tooltip
    text += `<path ${strokeOf(curve)} d="M${px(x)} ${LEGEND_LINE - 4}h${LINE_SAMPLE}"/>` +
      `<text x="${px(x + LINE_SAMPLE + 6)}" y="${LEGEND_LINE}">${escaped(curve.legend)}</text>`;
    x = next;
  }
  return text;
}

function drawMarks(plot, { top, bottom, x, toX }) {
  return (plot.marks ?? []).filter((mark) => mark.x >= x.min && mark.x <= x.max).map((mark) =>
    `<path class="mk" d="M${px(toX(mark.x))} ${px(top)}V${px(bottom)}"><title>${escaped(mark.label)}</title></path>`).join("");
}

// A plot is about 500 px wide, so two points per pixel show everything.
const MOST_POINTS = 1000;

/** Both ends of a line and the lowest and highest point of each bucket of neighbours: no spike is lost. */
function minMaxEnvelope(points) {
  if (points.length <= MOST_POINTS) return points;
  const kept = [points[0]];
  const buckets = MOST_POINTS / 2;
  for (let b = 0; b < buckets; ++b) {
    const bucket = points.slice(Math.floor((b * points.length) / buckets), Math.floor(((b + 1) * points.length) / buckets));
    let [low, high] = [0, 0];
    bucket.forEach(([, y], i) => {
      if (y < bucket[low][1]) low = i;
      if (y >= bucket[high][1]) high = i;
    });
    kept.push(bucket[Math.min(low, high)]);
    if (low !== high) kept.push(bucket[Math.max(low, high)]);
  }
  return [...kept, points.at(-1)];
}

/** The pieces of a line between its gaps (null): {line: the `d` of its path, dots: the lone points}. */
export function curvePath(points) {
  const path = { line: "", dots: [] };
  let piece = [];
  for (const point of [...points, null]) {
    if (point) {
      piece.push(point);
      continue;
    }
    if (piece.length === 1) path.dots.push(piece[0]);
    else if (piece.length > 1) path.line += `M${minMaxEnvelope(piece).map(([x, y]) => `${px(x)} ${px(y)}`).join("L")}`;
    piece = [];
  }
  return path;
}

/** The points of a curve on the picture; of a window also the next ones beyond it. */
function picturePoints(plot, { x, y }, { toX, toY }) {
  const [least, most] = plot.window ?? [-Infinity, Infinity];
  return x.map((value, i) => {
    const isBeyond = (value < least && !(x[i + 1] >= least)) || (value > most && !(x[i - 1] <= most));
    return isDrawable(plot, value, y[i]) && !isBeyond ? [toX(value), toY(y[i])] : null;
  });
}

function drawCurve(plot, curve, area) {
  const { line, dots } = curvePath(picturePoints(plot, curve, area));
  const title = curve.name ? `<title>${escaped(curve.name)}</title>` : "";
  const path = line ? `<path ${strokeOf(curve)} d="${line}">${title}</path>` : "";
  const fill = curve.stroke ? `fill="${curve.stroke}"`
    : `class="${curve.isReference ? "fref" : `f${(curve.color ?? 0) % NUM_CURVE_COLORS}`}"`;
  return path + dots.map(([x, y]) => `<circle ${fill} cx="${px(x)}" cy="${px(y)}" r="3">${title}</circle>`).join("");
}

/** A nested svg element shows no more than its box. */
function clipped(content, { left, right, top, bottom }) {
  const box = [left, top, right - left, bottom - top].map(px);
  return `<svg x="${box[0]}" y="${box[1]}" width="${box[2]}" height="${box[3]}" viewBox="${box.join(" ")}">${content}</svg>`;
}

/** The plot as the content of an `svg` element of its size: frame, grid, marks, curves, legend. */
export function drawPlot(plot, area = plotArea(plot)) {
  const curves = plot.curves.map((curve) => drawCurve(plot, curve, area)).join("");
  return drawAxes(plot, area) + drawMarks(plot, area) + (plot.window ? clipped(curves, area) : curves) + drawHeading(plot, area);
}
