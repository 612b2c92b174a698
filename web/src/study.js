// The page of a study: plots against its axes, and the last shapes of its runs.
import { embeddedRun, takenElement } from "./data.js";
import { commonView } from "./interface.js";
import { Cursor, PlotView } from "./plots.js";
import { frameFigure, keyFigure } from "./printed.js";
import { coloringOf } from "./stills.js";
import { escaped } from "./svg.js";
import { make, readable } from "./text.js";

const WIDTH = 220; // px, of a shape

/** A plot of the program's JSON, where null stands for no value; no axis has a place for points without x. */
export const withGaps = (plot) => ({
  ...plot, xName: plot.xLabel,
  curves: plot.curves.map((curve) => ({
    ...curve, x: curve.x.filter((v) => v !== null),
    y: curve.y.filter((_, i) => curve.x[i] !== null).map((v) => v ?? NaN),
  })),
});

/** Which plots lack points, and why; "" where none does. */
export function pointsLeftOut(plots) {
  const axes = plots.filter(({ curves }) => curves.some(({ x }) => x.includes(null))).map(({ xLabel }) => xLabel);
  return axes.length === 0 ? "" : `Not drawn: runs whose ${[...new Set(axes)].join(" or ")} is no finite number; the table has them.`;
}

function addPlots(app, plots) {
  const cursor = new Cursor();
  const views = plots.map((plot) => new PlotView(withGaps(plot), cursor));
  cursor.addEventListener("change", () => views.forEach((view) => view.showMoment(true)));
  const note = pointsLeftOut(plots);
  app.append(make("h2", {}, "Against the axes"), ...(note ? [make("p", { class: "notes" }, note)] : []), make("div", { class: "plots" }, ...views.map(({ element }) => element)));
  const draw = () => views.forEach((view) => view.draw());
  new ResizeObserver(draw).observe(app);
  draw();
  return views;
}

async function addShapes(app, run, shapes) {
  const frames = await run.frames.all();
  const view = commonView(frames, WIDTH);
  const coloring = coloringOf(run.frames.entries);
  const figures = frames.map((frame, k) => {
    const { name, link, outcome } = shapes[k];
    const title = link ? `<a href="${escaped(link)}">${escaped(name)}</a>` : escaped(name);
    return frameFigure(frame, view, coloring, name, `${title}<br>${escaped(outcome)}, <i>t</i> = ${readable(frame.t, 3)}`);
  });
  const place = make("div", {});
  place.innerHTML = `<h2>Shapes at the end</h2><div class="card"><div class="frames">${figures.join("")}</div></div>${keyFigure(view, coloring)}`;
  app.append(place);
}

/** `study`: {plots: as plot.js draws them, runs: one, whose frames are the shapes, shapes: [{name, link, outcome}]}. */
export async function showStudy(app, { plots, runs: [entry], shapes }) {
  const run = await embeddedRun(entry, 0, takenElement);
  if (plots.length > 0) addPlots(app, plots);
  if (shapes.length > 0) await addShapes(app, run, shapes);
  performance.mark("ready");
}
