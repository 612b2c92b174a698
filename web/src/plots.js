// The plots of the history: linked, with values under the mouse, zoom, logarithmic axes, download.
import uPlot from "uplot";
import { lineColor, variable } from "./colors.js";
import { curvesOf, plotsOf, referenceOf } from "./curves.js";
import { plotSvg } from "./plot-svg.js";
import { download, fileName, make, readable } from "./text.js";

const HEIGHT = 250;
const DASHES = [[], [6, 4], [2, 4], [8, 3, 2, 3]];

/** The curves of a plot for one or several runs, with how they are drawn. */
function styledCurves(plot, runs) {
  if (runs.length > 1) {
    return runs.flatMap((run, r) =>
      curvesOf(plot, run).map((curve) => ({
        ...curve,
        label: plot.quantities.length > 1 || curve.drop > 0 ? `${run.name}: ${curve.label}` : run.name,
        color: r, dash: curve.quantity,
      })),
    );
  }
  const curves = curvesOf(plot, runs[0]);
  const drops = [...new Set(curves.map((curve) => curve.drop))];
  const styled = curves.map((curve) => ({
    ...curve,
    color: drops.length > 1 ? drops.indexOf(curve.drop) : curve.quantity,
    dash: drops.length > 1 ? curve.quantity : 0,
  }));
  if (curves.length === 0) return styled;
  const references = referenceOf(plot, runs[0]).map((curve) => ({
    ...curve, label: `${curve.label}, reference`, isReference: true, dash: 2,
  }));
  return [...styled, ...references];
}

/**
 * One axis of times for all curves: rows [t, values of curve 0, …], null where a curve has none that can
 * be drawn.
 */
function joined(curves, isLog) {
  const isDrawable = (v) => Number.isFinite(v) && (v > 0 || !isLog);
  return uPlot.join(curves.map(({ t, values }) => [t, values.map((v) => (isDrawable(v) ? v : null))]));
}

class HistoryPlot {
  constructor(spec, runs, timeline, events) {
    Object.assign(this, { spec, runs, timeline, events, isLog: spec.log });
    this.curves = styledCurves(spec, runs);
    this.isLog &&= this.canBeLog();
    this.isDrawable = this.curves.some(({ values }) => values.some(Number.isFinite));
    if (!this.isDrawable) return;
    this.body = make("div", { class: "plot-body" });
    this.readout = make("div", { class: "readout", "aria-live": "off" });
    this.element = make("figure", { class: "card plot" }, this.heading(), this.readout, this.body);
    new IntersectionObserver(([entry]) => {
      this.isSeen = entry.isIntersecting;
      this.showMoment();
    }).observe(this.element);
  }

  heading() {
    const { title, unit } = this.spec;
    this.logButton = make("button", {
      type: "button", class: "log", title: "Logarithmic axis of values", "aria-pressed": String(this.isLog),
      click: () => this.toggleLog(),
    }, "log");
    const button = (name, title2, click) => make("button", { type: "button", title: title2, click }, name);
    return make(
      "figcaption", {},
      make("span", { class: "plot-title" }, title, " ", make("small", {}, unit ? `[${unit}]` : "")),
      make("span", { class: "tools" }, this.logButton,
        button("⤢", "Show all (double click)", () => this.unzoom()),
        button("SVG", "Download the picture", () => this.downloadSvg()),
        button("CSV", "Download the values", () => this.downloadCsv())),
    );
  }

  /** Draws (again, after a change of size, colours or axes). */
  draw() {
    const zoom = this.uplot && this.isZoomed ? { ...this.uplot.scales.x } : null;
    this.uplot?.destroy();
    this.data = joined(this.curves, this.isLog);
    this.uplot = new uPlot(this.options(), this.data, this.body);
    this.uplot.over.addEventListener("click", () => this.jump());
    this.now = make("div", { class: "now" });
    this.uplot.over.append(this.now);
    if (zoom) this.uplot.setScale("x", { min: zoom.min, max: zoom.max });
    this.showMoment();
  }

  options() {
    const axis = {
      stroke: variable("--soft"), font: `12px ${variable("--font")}`, labelFont: `12px ${variable("--font")}`,
      grid: { stroke: variable("--grid"), width: 1 }, ticks: { show: false },
    };
    const values = (_, splits) => splits.map((v) => (v === null ? null : readable(v, 5)));
    return {
      width: Math.max(200, this.body.clientWidth), height: HEIGHT,
      legend: { show: false },
      cursor: {
        sync: { key: "history", setSeries: false, scales: ["x", null] },
        drag: { x: true, y: false },
        points: { size: 7 },
        dataIdx: (u, series, nearest) => this.nearestValue(series, nearest),
      },
      scales: { x: { time: false }, y: { distr: this.isLog ? 3 : 1, range: this.range() } },
      axes: [
        { ...axis, values, label: "time t [1/G]", labelSize: 16, labelGap: 0, size: 26, gap: 3 },
        { ...axis, values: this.isLog ? undefined : values, size: (u, labels) => this.axisSize(labels) },
      ],
      series: [{}, ...this.curves.map((curve) => this.series(curve))],
      hooks: {
        setCursor: [() => this.showValues()],
        drawAxes: [(u) => this.drawEvents(u)],
        setScale: [(u, key) => key === "x" && this.noteZoom(u)],
        draw: [() => this.moveNow()],
      },
    };
  }

  /** At least from 0 where the quantity is one of those; a constant gets some room. */
  range() {
    if (this.isLog) return undefined;
    return (u, low, high) => {
      const least = this.spec.zero ? Math.min(0, low) : low;
      const most = this.spec.zero ? Math.max(0, high) : high;
      const room = Math.max(0.06 * (most - least), 1e-3 * Math.max(Math.abs(most), Math.abs(least)), 1e-300);
      return [this.spec.zero && least === 0 ? 0 : least - room, this.spec.zero && most === 0 ? 0 : most + room];
    };
  }

  series(curve) {
    const color = curve.isReference ? variable("--soft") : lineColor(curve.color);
    const isSparse = curve.values.length < 30 && curve.isReference;
    return {
      label: curve.label, stroke: color, width: curve.isReference ? 1.5 : 2, dash: DASHES[curve.dash % 4],
      spanGaps: false, points: { show: isSparse || curve.values.length === 1, size: 6, fill: color },
    };
  }

  axisSize(labels) {
    const longest = Math.max(3, ...(labels ?? []).map((label) => (label ?? "").length));
    return 14 + 7 * longest;
  }

  canBeLog() {
    return this.curves.some(({ values }) => values.some((v) => v > 0));
  }

  /** The row nearest to the mouse in which the curve has a value. */
  nearestValue(series, nearest) {
    const values = this.data[series];
    if (series === 0 || values[nearest] != null) return nearest;
    for (let d = 1; d < values.length; ++d) {
      if (values[nearest - d] != null) return nearest - d;
      if (values[nearest + d] != null) return nearest + d;
    }
    return nearest;
  }

  /** The values under the mouse, or those of the moment the 3-D view shows. */
  showValues() {
    const isHovered = this.uplot.cursor.idx != null;
    const entries = this.curves.map((curve, k) => {
      const row = isHovered ? this.nearestValue(k + 1, this.uplot.cursor.idx) : this.rowAt(this.timeline.t, k + 1);
      const value = this.data[k + 1][row];
      const color = curve.isReference ? "var(--soft)" : `var(--curve${curve.color % 6})`;
      return make(
        "span", { class: "value", "data-curve": curve.label, "data-t": this.data[0][row], "data-value": value ?? "",
          title: `t = ${this.data[0][row]}: ${value}` },
        make("i", { style: `border-top:2px ${["solid", "dashed", "dotted", "dashed"][curve.dash % 4]} ${color}` }),
        `${curve.label} = ${readable(value, 6)}`,
      );
    });
    const t = isHovered ? this.data[0][this.uplot.cursor.idx] : this.timeline.t;
    this.readout.replaceChildren(make("span", { class: "value-t" }, `t = ${readable(t, 5)}`), ...entries.slice(0, 8));
  }

  /** The row with a value nearest to a time. */
  rowAt(t, series) {
    const times = this.data[0];
    let [low, high] = [0, times.length - 1];
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (times[middle] <= t) low = middle;
      else high = middle;
    }
    return this.nearestValue(series, t - times[low] <= times[high] - t ? low : high);
  }

  drawEvents(u) {
    const { ctx } = u;
    ctx.save();
    ctx.strokeStyle = variable("--event");
    ctx.lineWidth = devicePixelRatio;
    ctx.setLineDash([4, 3]);
    for (const { t } of this.events()) {
      if (t < u.scales.x.min || t > u.scales.x.max) continue;
      const x = Math.round(u.valToPos(t, "x", true)) + 0.5;
      ctx.beginPath();
      ctx.moveTo(x, u.bbox.top);
      ctx.lineTo(x, u.bbox.top + u.bbox.height);
      ctx.stroke();
    }
    ctx.restore();
  }

  /** A line at the moment the 3-D view shows: an element, as a plot takes long to draw again. */
  moveNow() {
    const u = this.uplot;
    if (!u || !this.now) return;
    const { t, times } = this.timeline;
    this.now.hidden = times.length < 2 || t < u.scales.x.min || t > u.scales.x.max;
    this.now.style.transform = `translateX(${u.valToPos(t, "x").toFixed(1)}px)`;
  }

  showMoment() {
    if (!this.uplot || !this.isSeen) return;
    this.moveNow();
    if (this.uplot.cursor.idx == null) this.showValues();
  }

  jump() {
    if (this.uplot.cursor.idx != null) this.timeline.setTime(this.data[0][this.uplot.cursor.idx]);
  }

  noteZoom(u) {
    const t = u.data[0];
    this.isZoomed = u.scales.x.min > t[0] || u.scales.x.max < t[t.length - 1];
  }

  unzoom() {
    this.uplot.setScale("x", { min: this.data[0][0], max: this.data[0].at(-1) });
  }

  toggleLog() {
    this.isLog = !this.isLog && this.canBeLog();
    this.logButton.setAttribute("aria-pressed", String(this.isLog));
    this.draw();
  }

  /** New rows have come. */
  extend() {
    this.curves = styledCurves(this.spec, this.runs);
    if (this.uplot?.series.length !== this.curves.length + 1) return this.draw();
    this.data = joined(this.curves, this.isLog);
    this.uplot.setData(this.data, !this.isZoomed);
    this.showValues();
  }

  downloadSvg() {
    const colors = this.curves.map((curve) => (curve.isReference ? "#5c6671" : PRINT_COLORS[curve.color % 6]));
    const text = plotSvg(this.uplot, this.spec, this.curves.map((curve, k) => ({
      label: curve.label, color: colors[k], dash: DASHES[curve.dash % 4], values: this.data[k + 1],
    })), this.events());
    download(`${fileName(this.spec.title)}.svg`, text, "image/svg+xml");
  }

  downloadCsv() {
    const quoted = (text) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
    const lines = [["t", ...this.curves.map((curve) => quoted(curve.label))].join(",")];
    this.data[0].forEach((t, i) => lines.push(this.data.map((column) => column[i] ?? "").join(",")));
    download(`${fileName(this.spec.title)}.csv`, `${lines.join("\n")}\n`, "text/csv");
  }
}

// As in the style sheet by day: a file is printed or pasted into a paper.
const PRINT_COLORS = ["#0072b2", "#d55e00", "#009e73", "#b5548a", "#c98a00", "#3a9bdc"];

/** All plots of the catalogue that the runs have values for. */
export class History {
  constructor(catalogue, runs, timeline, events) {
    this.element = make("section", { class: "dynamic history", "aria-label": "History" });
    Object.assign(this, { catalogue, runs, timeline, events, plots: [] });
    this.addPlots();
    timeline.addEventListener("change", () => this.showMoment());
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.draw());
    let width = 0;
    new ResizeObserver(() => {
      if (this.element.clientWidth !== width) this.draw();
      width = this.element.clientWidth;
    }).observe(this.element);
  }

  addPlots() {
    const groups = new Map();
    this.plots = [];
    for (const spec of plotsOf(this.catalogue, this.runs)) {
      const plot = new HistoryPlot(spec, this.runs, this.timeline, this.events);
      if (!plot.isDrawable) continue;
      this.plots.push(plot);
      if (!groups.has(spec.group)) groups.set(spec.group, make("div", { class: "plots" }));
      groups.get(spec.group).append(plot.element);
    }
    this.element.replaceChildren(...[...groups].flatMap(([name, group]) => [make("h2", {}, name), group]));
  }

  draw() {
    this.plots.forEach((plot) => plot.draw());
  }

  /** Once for all changes of the moment before the next picture. */
  showMoment() {
    if (this.isDue) return;
    this.isDue = true;
    requestAnimationFrame(() => {
      this.isDue = false;
      this.plots.forEach((plot) => plot.showMoment());
    });
  }

  extend() {
    const drawable = plotsOf(this.catalogue, this.runs).filter((spec) =>
      styledCurves(spec, this.runs).some(({ values }) => values.some(Number.isFinite)),
    );
    if (drawable.length !== this.plots.length) {
      this.addPlots();
      this.draw();
    } else {
      this.plots.forEach((plot) => plot.extend());
    }
  }
}
