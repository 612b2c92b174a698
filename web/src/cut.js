// The cut through the tetrahedral mesh, coloured by liquid, by quality or by a field.
import { css, liquidColor, variable, viridis, VIRIDIS_GRADIENT } from "./colors.js";
import { fieldsOf, rangeOf } from "./data.js";
import { make, readable } from "./text.js";

const BEST_ANGLE = 60; // degrees; the regular tetrahedron has 70.5, a good mesh little above 60

const OF_FIELD = "field "; // begins the names of colourings by a field

export class CutView {
  constructor(run, fields) {
    this.cuts = run.cuts;
    this.fields = fieldsOf(this.cuts.entries, fields);
    this.plane = 0;
    this.coloring = "liquid";
    this.at = this.cuts.length - 1;
    this.zoom = { scale: 1, x: 0, y: 0 };
    this.makeElement();
  }

  makeElement() {
    this.canvas = make("canvas", { role: "img", tabindex: 0,
      "aria-label": "Cut through the tetrahedral mesh; + and − zoom, arrow keys move" });
    this.timeSelect = make("select", { change: () => this.choose({ at: Number(this.timeSelect.value) }) });
    this.planeSelect = make("select", { change: () => this.choose({ plane: Number(this.planeSelect.value) }) });
    const colorSelect = make(
      "select", { id: "cut-coloring", change: () => this.choose({ coloring: colorSelect.value }) },
      make("option", { value: "liquid" }, "liquid"), make("option", { value: "quality" }, "quality of the cells"),
      ...this.fields.map(({ name, label }) => make("option", { value: OF_FIELD + name }, label)),
    );
    this.key = make("span", { class: "colorbar" });
    this.caption = make("figcaption", {});
    this.fillTimes();
    this.element = make(
      "figure", { class: "dynamic card cut" },
      make("div", { class: "controls" },
        make("label", {}, "Time ", this.timeSelect), make("label", {}, "Plane ", this.planeSelect),
        make("label", {}, "Colour ", colorSelect), this.key,
        make("button", { type: "button", click: () => this.resetZoom() }, "Show all")),
      make("div", { class: "cut-stage" }, this.canvas), this.caption,
    );
    this.listen();
    new ResizeObserver(() => this.draw()).observe(this.element);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.draw());
  }

  fillTimes() {
    this.timeSelect.replaceChildren(...this.cuts.entries.map((entry, k) =>
      make("option", { value: k, selected: k === this.at }, `t = ${readable(entry.t, 4)}`)));
  }

  /** A new cut has come; who looks at the last one sees it. */
  extend() {
    const wasLast = this.at >= this.timeSelect.options.length - 1;
    if (wasLast) this.at = this.cuts.length - 1;
    this.fillTimes();
    if (wasLast) this.show();
  }

  choose(change) {
    Object.assign(this, change);
    return this.show();
  }

  async show() {
    const at = this.at;
    const planes = await this.cuts.get(at);
    if (at !== this.at) return;
    this.cut = planes[this.plane];
    this.planeSelect.replaceChildren(...planes.map((cut, k) =>
      make("option", { value: k, selected: k === this.plane }, `${"xyz"[cut.normal]} = ${readable(Math.abs(cut.offset) < 1e-9 ? 0 : cut.offset, 3)}`)));
    this.draw();
  }

  listen() {
    this.canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.zoomBy(event.deltaY < 0 ? 1.2 : 1 / 1.2, event.offsetX, event.offsetY);
    }, { passive: false });
    this.canvas.addEventListener("pointerdown", (event) => this.canvas.setPointerCapture(event.pointerId));
    this.canvas.addEventListener("pointermove", (event) => {
      if (!this.canvas.hasPointerCapture(event.pointerId)) return;
      this.move(event.movementX, event.movementY);
    });
    this.canvas.addEventListener("keydown", (event) => {
      const { clientWidth: w, clientHeight: h } = this.canvas;
      const keys = {
        "+": () => this.zoomBy(1.2, w / 2, h / 2), "=": () => this.zoomBy(1.2, w / 2, h / 2),
        "-": () => this.zoomBy(1 / 1.2, w / 2, h / 2), ArrowLeft: () => this.move(30, 0),
        ArrowRight: () => this.move(-30, 0), ArrowUp: () => this.move(0, 30), ArrowDown: () => this.move(0, -30),
      };
      if (!keys[event.key]) return;
      event.preventDefault();
      event.stopPropagation();
      keys[event.key]();
    });
  }

  zoomBy(factor, x, y) {
    const scale = Math.min(40, Math.max(1, this.zoom.scale * factor));
    const share = scale / this.zoom.scale;
    this.zoom = { scale, x: x - share * (x - this.zoom.x), y: y - share * (y - this.zoom.y) };
    this.draw();
  }

  move(dx, dy) {
    this.zoom = { ...this.zoom, x: this.zoom.x + dx, y: this.zoom.y + dy };
    this.draw();
  }

  resetZoom() {
    this.zoom = { scale: 1, x: 0, y: 0 };
    this.draw();
  }

  draw() {
    if (!this.cut || this.isDue) return;
    this.isDue = true;
    requestAnimationFrame(() => {
      this.isDue = false;
      this.drawNow();
    });
  }

  drawNow() {
    const { cut, canvas } = this;
    const [left, bottom, right, top] = cut.window;
    const width = Math.min(this.element.querySelector(".cut-stage").clientWidth, 760);
    const height = Math.round((width * (top - bottom)) / Math.max(right - left, 1e-12));
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    Object.assign(canvas, { width: width * ratio, height: height * ratio });
    Object.assign(canvas.style, { width: `${width}px`, height: `${height}px` });
    const unit = (width / (right - left)) * this.zoom.scale;
    const context = canvas.getContext("2d");
    context.setTransform(ratio, 0, 0, ratio, this.zoom.x * ratio, this.zoom.y * ratio);
    this.drawPolygons(context, (x) => (x - left) * unit, (y) => (top - y) * unit);
    this.describe();
  }

  /** The field that colours the cut, with its range over all times; undefined where none does. */
  coloringField() {
    const field = this.fields.find(({ name }) => OF_FIELD + name === this.coloring);
    return field && { ...field, range: rangeOf(this.cuts.entries, field.name) };
  }

  /** A function from a polygon's number to its colour. */
  polygonColors() {
    const { cut } = this;
    if (this.coloring === "liquid") {
      const liquids = Array.from({ length: 7 }, (_, region) => liquidColor(region));
      return (p) => liquids[cut.region[p] === 0 ? 0 : 1 + ((cut.region[p] - 1) % 6)];
    }
    if (this.coloring === "quality") return (p) => css(viridis(cut.quality[p] / BEST_ANGLE));
    const { name, range: [low, high] } = this.coloringField();
    return (p) => css(viridis((cut.values[name]?.[p] - low) / (high - low)));
  }

  drawPolygons(context, toX, toY) {
    const { cut } = this;
    const colorOf = this.polygonColors();
    context.lineWidth = 0.7;
    context.strokeStyle = variable(this.coloring === "liquid" ? "--soft" : "--card");
    let first = 0;
    for (let p = 0; p < cut.polygons; ++p) {
      context.beginPath();
      for (let k = 0; k < cut.corners[p]; ++k) context.lineTo(toX(cut.x[first + k]), toY(cut.y[first + k]));
      context.closePath();
      first += cut.corners[p];
      context.fillStyle = colorOf(p);
      context.fill();
      context.stroke();
    }
  }

  describe() {
    const { cut } = this;
    this.caption.textContent =
      `${cut.polygons} cells of the mesh at t = ${readable(cut.t, 4)} in the plane ${"xyz"[cut.normal]} = ` +
      `${readable(Math.abs(cut.offset) < 1e-9 ? 0 : cut.offset, 3)}; ${cut.axes[0]} to the right, ${cut.axes[1]} upwards. The wheel zooms.`;
    this.key.replaceChildren(...this.keyParts());
  }

  /** What the colours mean. */
  keyParts() {
    const scale = (low, high, unit) =>
      [low, make("span", { class: "bar", style: `background:${VIRIDIS_GRADIENT}` }), high, make("span", { class: "unit" }, unit)];
    if (this.coloring === "quality") return scale("0°", `${BEST_ANGLE}°`, "smallest dihedral angle");
    const field = this.coloringField();
    if (field) return scale(readable(field.range[0], 4), readable(field.range[1], 4), field.unit);
    const chip = (color, label) => make("span", { class: "chip" }, make("i", { style: `background:${color}` }), label);
    const regions = [...new Set(this.cut.region)].sort((a, b) => a - b).slice(0, 7);
    return regions.map((region) => chip(liquidColor(region), region === 0 ? "matrix" : `drop ${region - 1}`));
  }
}
