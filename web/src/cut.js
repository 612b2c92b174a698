// The cut through the tetrahedral mesh, coloured by liquid, by quality or by a field: the picture that
// stills have, with zoom.
import { FIELDS, unitOf } from "./catalogue.js";
import { liquidOf, VIRIDIS_GRADIENT } from "./colors.js";
import { BEST_ANGLE, cutHeight, drawCut, liquidName, planeText } from "./cut-picture.js";
import { fieldsOf, rangeOf } from "./data.js";
import { make, readable } from "./text.js";

const WIDTH = 760; // px, of the picture at most
const OF_FIELD = "field "; // begins the names of colourings by a field

export class CutView {
  constructor(run) {
    this.run = run;
    this.cuts = run.cuts;
    this.fields = fieldsOf(this.cuts.entries, FIELDS);
    this.plane = 0;
    this.coloring = "liquid";
    this.at = this.cuts.length - 1;
    this.zoom = { scale: 1, x: 0, y: 0 };
    this.makeElement();
  }

  makeElement() {
    this.stage = make("div", { class: "cut-stage", role: "img", tabindex: 0,
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
      "figure", { class: "card cut" },
      make("div", { class: "controls" },
        make("label", {}, "Time ", this.timeSelect), make("label", {}, "Plane ", this.planeSelect),
        make("label", {}, "Colour ", colorSelect), this.key,
        make("button", { type: "button", click: () => this.resetZoom() }, "Show all")),
      this.stage, this.caption,
    );
    this.listen();
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
      make("option", { value: k, selected: k === this.plane }, planeText(cut))));
    this.draw();
  }

  listen() {
    this.stage.addEventListener("wheel", (event) => {
      event.preventDefault();
      const { left, top } = this.stage.getBoundingClientRect();
      this.zoomBy(event.deltaY < 0 ? 1.2 : 1 / 1.2, event.clientX - left, event.clientY - top);
    }, { passive: false });
    this.stage.addEventListener("pointerdown", (event) => this.stage.setPointerCapture(event.pointerId));
    this.stage.addEventListener("pointermove", (event) => {
      if (!this.stage.hasPointerCapture(event.pointerId)) return;
      this.move(event.movementX, event.movementY);
    });
    this.stage.addEventListener("keydown", (event) => {
      const { clientWidth: w, clientHeight: h } = this.stage;
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
    this.place();
  }

  move(dx, dy) {
    this.zoom = { ...this.zoom, x: this.zoom.x + dx, y: this.zoom.y + dy };
    this.place();
  }

  resetZoom() {
    this.zoom = { scale: 1, x: 0, y: 0 };
    this.place();
  }

  /** Draws the cut anew; zoom and place are those of its box alone (`place`). */
  draw() {
    const { cut } = this;
    const field = this.coloringField();
    const coloring = field ? { kind: "field", field: field.name, low: field.range[0], high: field.range[1] } : { kind: this.coloring };
    this.stage.innerHTML = `<svg>${drawCut(cut, coloring, WIDTH)}</svg>`;
    this.place();
    this.caption.textContent =
      `${cut.polygons} cells of the mesh at t = ${readable(cut.t, 4)} in the plane ${planeText(cut)}; ` +
      `${cut.axes[0]} to the right, ${cut.axes[1]} upwards. The wheel zooms.`;
    this.key.replaceChildren(...this.keyParts());
  }

  /** Shows the part of the picture that zoom and moves have chosen. */
  place() {
    const { scale, x, y } = this.zoom;
    const [width, height] = [WIDTH, cutHeight(this.cut, WIDTH)].map((length) => length / scale);
    const unit = this.unit();
    this.stage.firstChild.setAttribute("viewBox", `${-x * unit / scale} ${-y * unit / scale} ${width} ${height}`);
  }

  /** Lengths of the picture per px of the page. */
  unit() {
    return WIDTH / Math.max(1, this.stage.clientWidth);
  }

  /** The field that colours the cut, with its range over all times; undefined where none does. */
  coloringField() {
    const field = this.fields.find(({ name }) => OF_FIELD + name === this.coloring);
    return field && { ...field, range: rangeOf(this.cuts.entries, field.name) };
  }

  /** What the colours mean. */
  keyParts() {
    const scale = (low, high, unit) =>
      [low, make("span", { class: "bar", style: `background:${VIRIDIS_GRADIENT}` }), high, make("span", { class: "unit" }, unit)];
    if (this.coloring === "quality") return scale("0°", `${BEST_ANGLE}°`, "smallest dihedral angle");
    const field = this.coloringField();
    if (field) return scale(readable(field.range[0], 4), readable(field.range[1], 4), unitOf(field.unit, [this.run]));
    const chip = (color, label) => make("span", { class: "chip" }, make("i", { style: `background:${color}` }), label);
    const regions = [...new Set(this.cut.region)].sort((a, b) => a - b).slice(0, 7);
    return regions.map((region) => chip(`var(--liquid${liquidOf(region)})`, liquidName(this.cut, region)));
  }
}
