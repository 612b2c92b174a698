// The plots of the page: drawn as in pictures, and with values under the cursor, zoom, logarithmic axes,
// download. The cursor is one for all plots of the history.
import { historyPlots } from "./curves.js";
import { drawPlot, plotArea, strokeOf } from "./plot.js";
import { escaped, svgFile } from "./svg.js";
import { download, fileName, make, readable } from "./text.js";

const HEIGHT = 290; // px
const LEAST_WIDTH = 260;
const MOST_VALUES = 8; // in the line below a plot
const LEAST_DRAG = 6; // px; less is a click

const isDrawable = (plot, i, { y }) => Number.isFinite(y[i]) && (y[i] > 0 || !plot.isLog);

const ROUNDOFF = 1e-9; // share of x by which times of frames and rows may differ

/**
 * The row nearest to x that has a value which can be drawn. It is -1 where a curve has none, or where x lies
 * before its first or beyond its last.
 */
export function rowAt(plot, curve, x) {
  let [best, first, last] = [-1, Infinity, -Infinity];
  curve.x.forEach((value, i) => {
    if (!Number.isFinite(value) || !isDrawable(plot, i, curve)) return;
    first = Math.min(first, value);
    last = Math.max(last, value);
    if (best < 0 || Math.abs(value - x) < Math.abs(curve.x[best] - x)) best = i;
  });
  const slack = ROUNDOFF * Math.abs(x);
  return x >= first - slack && x <= last + slack ? best : -1;
}

/** "D = 0.25", with the row's own place where that is another than x: "D = 0.25 (t = 1)". */
export function readoutText(name, xName, [t, value], x) {
  const isElsewhere = t !== undefined && readable(t, 5) !== readable(x, 5);
  return `${name || "value"} = ${readable(value, 6)}${isElsewhere ? ` (${xName} = ${readable(t, 5)})` : ""}`;
}

/** All x of the curves, rising. */
const allX = (plot) => [...new Set(plot.curves.flatMap(({ x }) => x.filter(Number.isFinite)))].sort((a, b) => a - b);

/** One plot. `cursor` is shared: an EventTarget with `x` (undefined: none) that tells of a `change`. */
export class PlotView {
  constructor(plot, cursor, { momentOf = () => undefined, onChoose = () => {} } = {}) {
    Object.assign(this, { plot, cursor, momentOf, onChoose });
    this.picture = make("div", { class: "picture" });
    this.line = make("div", { class: "cursor", hidden: true });
    this.now = make("div", { class: "now", hidden: true });
    this.band = make("div", { class: "band", hidden: true });
    this.over = make("div", { class: "over" }, this.now, this.line, this.band);
    this.body = make("div", { class: "plot-body", tabindex: 0, role: "group",
      "aria-label": `${plot.title}; left and right move the cursor, + and − zoom, 0 shows all, Enter goes to the time` },
      this.picture, this.over);
    this.readout = make("div", { class: "readout", "aria-live": "polite" });
    this.element = make("figure", { class: "card plot" }, this.body, make("figcaption", {}, this.readout, this.tools()));
    this.listen();
    new IntersectionObserver(([entry]) => {
      this.isSeen = entry.isIntersecting;
      this.showMoment();
    }).observe(this.element);
  }

  tools() {
    this.logButton = make("button", {
      type: "button", class: "log", title: "Logarithmic axis of values", "aria-pressed": String(this.plot.isLog),
      click: () => this.toggleLog(),
    }, "log");
    const button = (name, title, click) => make("button", { type: "button", title, click }, name);
    return make("span", { class: "tools" }, this.logButton,
      button("⤢", "Show all (double click)", () => this.show(undefined)),
      button("SVG", "Download the picture", () => this.downloadSvg()),
      button("CSV", "Download the values", () => this.downloadCsv()));
  }

  draw() {
    const width = Math.max(LEAST_WIDTH, this.body.clientWidth);
    Object.assign(this.plot, { width, height: HEIGHT });
    this.area = plotArea(this.plot);
    const { left, right, top, bottom } = this.area;
    this.picture.innerHTML =
      `<svg viewBox="0 0 ${width} ${HEIGHT}" role="img" aria-label="${escaped(this.plot.title)}">${drawPlot(this.plot, this.area)}</svg>`;
    Object.assign(this.over.style, { left: `${left}px`, top: `${top}px`, width: `${right - left}px`, height: `${bottom - top}px` });
    this.showMoment(true);
  }

  /** x under a place of the page. */
  xAt(clientX) {
    return this.area.ofX(this.area.left + clientX - this.over.getBoundingClientRect().left);
  }

  listen() {
    const { over, body } = this;
    let start; // of a drag
    over.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      start = event.clientX;
      over.setPointerCapture(event.pointerId);
    });
    over.addEventListener("pointermove", (event) => {
      this.cursor.move(this.nearest(this.xAt(event.clientX)));
      if (start === undefined) return;
      const edge = over.getBoundingClientRect().left;
      const [from, to] = [Math.min(start, event.clientX), Math.max(start, event.clientX)];
      this.band.hidden = to - from < LEAST_DRAG;
      Object.assign(this.band.style, { left: `${from - edge}px`, width: `${to - from}px` });
    });
    over.addEventListener("pointerup", (event) => {
      if (start === undefined || event.button !== 0) return; // pressed elsewhere, or another button
      const [from, to] = [Math.min(start, event.clientX), Math.max(start, event.clientX)];
      start = undefined;
      this.band.hidden = true;
      if (to - from < LEAST_DRAG) this.onChoose(this.nearest(this.xAt(event.clientX)));
      else this.show([this.xAt(from), this.xAt(to)]);
    });
    over.addEventListener("pointercancel", () => {
      start = undefined;
      this.band.hidden = true;
    });
    over.addEventListener("pointerleave", () => this.cursor.move(undefined));
    over.addEventListener("dblclick", () => this.show(undefined));
    body.addEventListener("keydown", (event) => this.onKey(event));
    body.addEventListener("blur", () => this.cursor.move(undefined));
  }

  onKey(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const keys = {
      ArrowLeft: () => this.step(-1), ArrowRight: () => this.step(1), "+": () => this.zoom(0.5), "=": () => this.zoom(0.5),
      "-": () => this.zoom(2), 0: () => this.show(undefined), Enter: () => this.onChoose(this.shownX()),
    };
    if (!keys[event.key]) return;
    event.preventDefault();
    event.stopPropagation();
    keys[event.key]();
  }

  /** The x nearest to a place that any curve has. */
  nearest(x) {
    return allX(this.plot).reduce((best, each) => (Math.abs(each - x) < Math.abs(best - x) ? each : best), Infinity);
  }

  /** The cursor's x, or that of the moment; of a plot that knows none the first. */
  shownX() {
    return this.cursor.x ?? this.momentOf() ?? allX(this.plot)[0];
  }

  step(by) {
    const all = allX(this.plot);
    const at = all.indexOf(this.nearest(this.shownX()));
    this.cursor.move(all[Math.max(0, Math.min(all.length - 1, at + by))]);
  }

  zoom(factor) {
    const { min, max } = this.area.x;
    const [x, half] = [this.shownX(), (factor * (max - min)) / 2];
    const all = allX(this.plot);
    if (2 * half >= all.at(-1) - all[0]) this.show(undefined);
    else this.show([x - half, x + half]);
  }

  /** Shows a window of x, or all. */
  show(window) {
    this.plot.window = window;
    this.draw();
  }

  toggleLog() {
    const canBeLog = this.plot.curves.some(({ y }) => y.some((v) => v > 0));
    this.plot.isLog = !this.plot.isLog && canBeLog;
    this.logButton.setAttribute("aria-pressed", String(this.plot.isLog));
    this.draw();
  }

  /** The values at the cursor, or at the moment that the 3-D view shows; of a plot out of sight if `always`. */
  showMoment(always = false) {
    if (!this.area || (!this.isSeen && !always)) return;
    const place = (line, x) => {
      line.hidden = !(x >= this.area.x.min && x <= this.area.x.max);
      line.style.transform = `translateX(${(this.area.toX(x) - this.area.left).toFixed(1)}px)`;
    };
    place(this.line, this.cursor.x);
    place(this.now, this.momentOf());
    const x = this.shownX();
    const xName = this.plot.xName ?? "t";
    const entries = this.plot.curves.slice(0, MOST_VALUES).map((curve) => {
      const row = rowAt(this.plot, curve, x);
      const [t, value] = [curve.x[row], curve.y[row]];
      const sample = make("i", {});
      sample.innerHTML = `<svg width="16" height="4"><path ${strokeOf(curve)} d="M0 2h16"/></svg>`;
      return make("span", { class: "value", "data-curve": curve.name, "data-t": t ?? "", "data-value": value ?? "",
        title: row < 0 ? `${curve.name} has no value there` : `${curve.name} = ${value} at ${t}` },
        sample, readoutText(curve.name, xName, [t, value], x));
    });
    this.readout.replaceChildren(make("span", { class: "value-t" }, `${xName} = ${readable(x, 5)}`), ...entries);
  }

  /** New curves, of a run that goes on; zoom and axes stay. */
  extend(plot) {
    this.plot = { ...plot, window: this.plot.window, isLog: this.plot.isLog };
    this.draw();
  }

  downloadSvg() {
    download(`${fileName(this.plot.title)}.svg`, svgFile(drawPlot(this.plot, this.area), this.plot.width, this.plot.height), "image/svg+xml");
  }

  downloadCsv() {
    const quoted = (text) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
    const { curves } = this.plot;
    const columns = curves.map((curve) => new Map(curve.x.map((x, i) => [x, curve.y[i]])));
    const lines = [[this.plot.xName ?? "t", ...curves.map(({ name }) => quoted(name))].join(",")];
    for (const x of allX(this.plot)) {
      lines.push([x, ...columns.map((column) => (Number.isFinite(column.get(x)) ? column.get(x) : ""))].join(","));
    }
    download(`${fileName(this.plot.title)}.csv`, `${lines.join("\n")}\n`, "text/csv");
  }
}

/** The place under the mouse, for all plots that share it. */
export class Cursor extends EventTarget {
  move(x) {
    if (x === this.x) return;
    this.x = x;
    this.dispatchEvent(new Event("change"));
  }
}

/** All plots of the history that runs have values for, with the moment that the timeline shows. */
export class History {
  constructor(runs, timeline, events) {
    Object.assign(this, { runs, timeline, events, cursor: new Cursor(), plots: [] });
    this.element = make("section", { class: "history", "aria-label": "History" });
    this.addPlots();
    this.cursor.addEventListener("change", () => this.showMoment(true));
    timeline.addEventListener("change", () => this.showMoment());
    let width = 0;
    new ResizeObserver(() => {
      if (this.element.clientWidth !== width) this.draw();
      width = this.element.clientWidth;
    }).observe(this.element);
  }

  addPlots() {
    const groups = new Map();
    this.plots = historyPlots(this.runs, this.events()).map((plot) => {
      const view = new PlotView(plot, this.cursor, {
        momentOf: () => (this.timeline.times.length > 0 ? this.timeline.t : undefined),
        onChoose: (t) => this.timeline.setTime(t),
      });
      if (!groups.has(plot.group)) groups.set(plot.group, make("div", { class: "plots" }));
      groups.get(plot.group).append(view.element);
      return view;
    });
    this.element.replaceChildren(...[...groups].flatMap(([name, group]) => [make("h2", {}, name), group]));
  }

  draw() {
    this.plots.forEach((plot) => plot.draw());
  }

  /** Once for all changes of the moment before the next picture. */
  showMoment(always = false) {
    this.isForAll ||= always;
    if (this.isDue) return;
    this.isDue = true;
    requestAnimationFrame(() => {
      this.plots.forEach((plot) => plot.showMoment(this.isForAll));
      this.isDue = this.isForAll = false;
    });
  }

  extend() {
    const plots = historyPlots(this.runs, this.events());
    if (plots.length !== this.plots.length) {
      this.addPlots();
      this.draw();
    } else {
      plots.forEach((plot, k) => this.plots[k].extend(plot));
    }
  }
}
