// Pictures of a run that stand alone, as texts of .svg files; undefined where the run has nothing to show.
import { BEST_ANGLE, cutHeight, drawCut, drawLiquidKey, planeText } from "./cut-picture.js";
import { eventsOf, historyPlot, historyPlots, specsOf } from "./curves.js";
import { FIELDS } from "./catalogue.js";
import { rangeOf } from "./data.js";
import { hex, viridis } from "./colors.js";
import { commonView, drawColorBar, drawInterface, drawKey, KEY } from "./interface.js";
import { drawPlot, hasValues } from "./plot.js";
import { sectionThroughCentroids } from "./section.js";
import { escaped, moved, px, svgFile } from "./svg.js";
import { readable } from "./text.js";

const COLUMNS = 3;
const FRAME_WIDTH = 320; // px
const CAPTION_HEIGHT = 26;
const CUT = { width: 460, gap: 20, margin: 10, keyHeight: 64 };

/** How pictures of frames are coloured: by curvature over all of them; undefined where one has none. */
export function coloringOf(entries) {
  const range = rangeOf(entries, FIELDS[0].name);
  if (!range || !entries.every(({ ranges }) => ranges[FIELDS[0].name])) return undefined;
  return { ...FIELDS[0], field: FIELDS[0].name, low: range[0], high: range[1] };
}

function caption(t, x, y) {
  return `<text x="${px(x)}" y="${px(y)}" text-anchor="middle">t = ${readable(t, 3)}</text>`;
}

/** All frames of a run, in rows of three, each with its time below. */
export async function interfaceStill(run) {
  const frames = await run.frames.all();
  if (frames.length === 0) return undefined;
  const view = commonView(frames, FRAME_WIDTH);
  const coloring = coloringOf(run.frames.entries);
  const width = Math.max(FRAME_WIDTH * Math.min(COLUMNS, frames.length), KEY.width);
  const rowHeight = view.height + CAPTION_HEIGHT;
  const height = rowHeight * Math.ceil(frames.length / COLUMNS);
  const content = frames.map((frame, i) => {
    const [x, y] = [FRAME_WIDTH * (i % COLUMNS), rowHeight * Math.floor(i / COLUMNS)];
    return moved(drawInterface(frame, view, coloring), x, y) + caption(frame.t, x + FRAME_WIDTH / 2, y + view.height + 12);
  });
  const key = moved(drawKey(view, coloring), (width - KEY.width) / 2, height);
  return svgFile(content.join("") + key, width, height + KEY.height);
}

/** All plots of the history, in two columns, each group on rows of its own. */
export async function historyStill(run) {
  const plots = historyPlots([run], eventsOf(run.tables.events));
  if (plots.length === 0) return undefined;
  let [content, x, y, width] = ["", 0, 0, 0];
  plots.forEach((plot, i) => {
    content += moved(drawPlot(plot), x, y);
    width = Math.max(width, x + plot.width);
    const isEndOfRow = x > 0 || plots[i + 1]?.group !== plot.group;
    if (isEndOfRow) y += plot.height;
    x = isEndOfRow ? 0 : plot.width;
  });
  return svgFile(content, width, y);
}

/** D(t), with the reference where the run has one. */
export async function deformationStill(run) {
  const plot = historyPlot(specsOf([run])[0], [run], eventsOf(run.tables.events));
  if (!hasValues(plot)) return undefined;
  Object.assign(plot, { width: 640, height: 400 });
  return svgFile(drawPlot(plot), plot.width, plot.height);
}

function drawCutPair(cut, t) {
  const height = cutHeight(cut, CUT.width);
  const right = CUT.width + CUT.gap;
  return drawCut(cut, { kind: "liquid" }, CUT.width) + moved(drawCut(cut, { kind: "quality" }, CUT.width), right, 0) +
    `<text x="0" y="${height + 18}">t = ${readable(t, 3)}, plane ${escaped(planeText(cut))}</text>` +
    drawLiquidKey(cut, 0, height + 42) +
    drawColorBar({ low: 0, high: BEST_ANGLE }, "Smallest dihedral angle of the cells [°]", right, height + 22, 260);
}

/** The first cut of every volume mesh, by liquid on the left and by quality on the right. */
export async function meshStill(run) {
  const cuts = (await run.cuts.all()).map((planes) => planes[0]);
  if (cuts.length === 0) return undefined;
  let [content, y] = ["", CUT.margin];
  for (const cut of cuts) {
    content += moved(drawCutPair(cut, cut.t), CUT.margin, y);
    y += cutHeight(cut, CUT.width) + CUT.keyHeight;
  }
  return svgFile(content, 2 * (CUT.margin + CUT.width) + CUT.gap, y);
}

/** The pictures of a film, one a frame: width and height are even, as video codecs require. */
export async function* filmStills(run) {
  const [width, leastHeight, mostHeight] = [800, 240, 520];
  const view = commonView(await run.frames.all(), width);
  if (view.height > mostHeight) Object.assign(view, { scale: (view.scale * mostHeight) / view.height, height: mostHeight });
  view.height = Math.max(view.height, leastHeight);
  const coloring = coloringOf(run.frames.entries);
  const height = 2 * Math.ceil((view.height + CAPTION_HEIGHT + KEY.height) / 2);
  const key = moved(drawKey(view, coloring), (width - KEY.width) / 2, view.height + CAPTION_HEIGHT);
  for (const frame of await run.frames.all()) {
    yield svgFile(drawInterface(frame, view, coloring) + caption(frame.t, width / 2, view.height + 12) + key, width, height);
  }
}

/** The range of colours for the times of frames, and a plot of their sections with a plane. */
export function sectionPlot(frames, normal) {
  const times = timeColors(frames);
  const isFlowPlane = normal === 2;
  return {
    title: isFlowPlane ? "Sections in the x–y plane" : "Sections in the x–z plane",
    xLabel: "x [R₀]", yLabel: isFlowPlane ? "y [R₀]" : "z [R₀]", hasEqualScales: true, width: 560, height: 400,
    curves: frames.map((frame) => {
      const share = (frame.t - times.low) / (times.high - times.low);
      return { ...sectionThroughCentroids(frame, normal), stroke: hex(viridis(times.first + (times.last - times.first) * share)) };
    }),
  };
}

/** The ends of viridis are left out: dark is faint on a dark page, yellow on a light one. */
export function timeColors(frames) {
  const low = frames[0].t;
  return { low, high: Math.max(frames.at(-1).t, low + 1e-12), first: 0.25, last: 0.85 };
}
