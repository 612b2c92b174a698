// The shapes as pictures: on paper, and on the screen where the 3-D view is not to be had.
import { commonView, drawColorBar, drawInterface, drawKey, KEY } from "./interface.js";
import { drawPlot } from "./plot.js";
import { coloringOf, sectionPlot, timeColors } from "./stills.js";
import { escaped, inlineSvg } from "./svg.js";
import { readable } from "./text.js";

const WIDTH = 320; // px, of a frame
const FRAMES = { one: 8, several: 4 }; // of one run, of each of several

/** A figure of a frame; `caption` is markup. */
export function frameFigure(frame, view, coloring, label, caption) {
  return `<figure>${inlineSvg(drawInterface(frame, view, coloring), view.width, view.height, label)}<figcaption>${caption}</figcaption></figure>`;
}

/** The key below figures of frames. */
export function keyFigure(view, coloring) {
  return `<div class="key">${inlineSvg(drawKey(view, coloring), KEY.width, KEY.height, "Scale of colours, length and axes")}</div>`;
}

/** The frames nearest to `count` times that are spread evenly up to `end`. */
function spreadFrames(run, count, end) {
  const [first] = run.frames.times;
  const numbers = Array.from({ length: count }, (_, k) => run.frames.nearest(first + ((end - first) * k) / (count - 1)));
  return [...new Set(numbers)].map((k) => run.frames.now(k)).filter(Boolean);
}

function sections(frames) {
  const plots = [2, 1].map((normal) => sectionPlot(frames, normal)).map((plot) =>
    `<figure class="card">${inlineSvg(drawPlot(plot), plot.width, plot.height, plot.title)}</figure>`);
  const bar = drawColorBar(timeColors(frames), "Sections through each drop’s centroid, by time t [1/G]", 24, 24, 420);
  const key = frames.length > 1 ? `<div class="key">${inlineSvg(bar, 560, 56, "Colours of time")}</div>` : "";
  return `<div class="plots sections">${plots.join("")}${key}</div>`;
}

function pictures(runs) {
  const shown = runs.filter((run) => run.frames.length > 0);
  const end = Math.min(...shown.map((run) => run.frames.times.at(-1)));
  const lists = shown.map((run) => spreadFrames(run, runs.length > 1 ? FRAMES.several : FRAMES.one, end));
  const view = commonView(lists.flat(), WIDTH);
  const coloring = coloringOf(shown.flatMap((run) => run.frames.entries));
  const rows = lists.map((frames, r) => {
    const name = runs.length > 1 ? `<h3>${escaped(shown[r].name)}</h3>` : "";
    const figures = frames.map((frame) => frameFigure(frame, view, coloring, `The interface at t = ${readable(frame.t, 3)}`,
      `<i>t</i> = ${readable(frame.t, 3)}`));
    return `<div class="card">${name}<div class="frames">${figures.join("")}</div></div>`;
  });
  const heading = runs.length > 1 ? "Shapes at equal times" : "The interface";
  return `<h2>${heading}</h2>${rows.join("")}${keyFigure(view, coloring)}${runs.length > 1 ? "" : sections(lists[0])}`;
}

/**
 * Draws the shapes into an element when they are wanted: before the page is printed, or at once where the
 * element is shown. All frames have to be ready.
 */
export function drawForPaper(element, runs) {
  let isDrawn = false;
  const draw = () => {
    if (isDrawn) return;
    isDrawn = true;
    element.innerHTML = pictures(runs);
  };
  if (!element.classList.contains("printed")) return draw();
  window.addEventListener("beforeprint", draw);
  matchMedia("print").addEventListener("change", ({ matches }) => matches && draw());
}
