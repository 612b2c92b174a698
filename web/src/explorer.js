// The interface in 3-D with its controls: of one run, or of several side by side at equal times.
import { Vector3 } from "three";
import { FIELDS, unitOf } from "./catalogue.js";
import { VIRIDIS_GRADIENT } from "./colors.js";
import { fieldsOf, rangeOf } from "./data.js";
import { make, readable } from "./text.js";
import { View3D } from "./view3d.js";

/** The box around all frames of all runs. */
function boxOf(entries) {
  const low = [0, 1, 2].map((k) => Math.min(...entries.map((entry) => entry.low[k])));
  const high = [0, 1, 2].map((k) => Math.max(...entries.map((entry) => entry.high[k])));
  return { low, high };
}

/** Whether drops travel so far that a view of the whole way would show them small. */
function travels(entries) {
  const size = ({ low, high }) => Math.max(...high.map((value, k) => value - low[k]));
  return size(boxOf(entries)) > 1.6 * Math.max(...entries.map(size));
}

const VIEWS = [
  ["Oblique", "the view of the pictures", undefined],
  ["x–y", "along the z-axis", new Vector3(0, 0, 1)],
  ["x–z", "along the y-axis", new Vector3(0, 1, 0)],
  ["y–z", "along the x-axis", new Vector3(1, 0, 0)],
];

export class Explorer {
  constructor(runs, timeline) {
    this.runs = runs;
    this.timeline = timeline;
    this.fields = fieldsOf(this.entries(), FIELDS);
    this.field = this.fields[0]?.name;
    this.requests = runs.map(() => 0);
    this.makeViews();
    this.makeControls();
    this.element = make(
      "section", { class: "dynamic explorer card", "aria-label": "The interface in 3-D" },
      this.stages, this.timeline.element, this.controls, this.notes(),
    );
    this.useRange();
    timeline.addEventListener("change", () => this.show());
    timeline.addEventListener("event", ({ detail }) => this.lookAt(detail));
  }

  entries() {
    return this.runs.flatMap((run) => run.frames.entries);
  }

  makeViews() {
    this.isFollowing = travels(this.entries());
    const box = this.viewedBox();
    this.views = this.runs.map((run) => {
      const view = new View3D(box, `The interface of ${run.title || run.name}`, (turned) => this.link(turned));
      view.isFollowing = this.isFollowing;
      if (this.runs.length > 1) {
        view.caption = make("span", { class: "stage-caption" });
        view.element.append(make("span", { class: "stage-title" }, run.name), view.caption);
      }
      return view;
    });
    this.stages = make("div", { class: `stages of${this.runs.length}` }, ...this.views.map((v) => v.element));
  }

  /** All that is to be seen; while the drops are followed, the largest frame alone. */
  viewedBox() {
    const entries = this.entries();
    if (!this.isFollowing) return boxOf(entries);
    const half = Math.max(...entries.flatMap(({ low, high }) => high.map((value, k) => value - low[k]))) / 2;
    return { low: [-half, -half, -half], high: [half, half, half] };
  }

  link(turned) {
    for (const view of this.views) if (view !== turned) view.copyView(turned);
  }

  makeControls() {
    this.select = make(
      "select", { id: "field", change: () => this.setField(this.select.value) },
      ...this.fields.map(({ name, label }) => make("option", { value: name }, label)),
    );
    const check = (label, isOn, onChange) => {
      const box = make("input", { type: "checkbox", checked: isOn, change: () => onChange(box.checked) });
      return make("label", { class: "check" }, box, label);
    };
    const opacity = make("input", {
      type: "range", min: 0.1, max: 1, step: 0.05, value: 1, "aria-label": "Opacity", class: "opacity",
      input: () => this.views.forEach((view) => view.setOpacity(Number(opacity.value))),
    });
    const lookButtons = VIEWS.map(([name, title, toward]) =>
      make("button", { type: "button", title: `Look ${title}`, click: () => this.lookFrom(toward) }, name),
    );
    this.controls = make(
      "div", { class: "controls" },
      make("label", {}, "Colour ", this.select), this.makeColorBar(),
      check("Wireframe", false, (isOn) => this.views.forEach((view) => view.setWireframe(isOn))),
      check("Follow", this.isFollowing, (isOn) => this.setFollowing(isOn)),
      make("label", {}, "Opacity ", opacity), make("span", { class: "group" }, ...lookButtons),
    );
  }

  makeColorBar() {
    const bound = (label) =>
      make("input", { type: "text", inputmode: "decimal", class: "bound", "aria-label": label,
        change: () => this.setRange(Number(this.low.value), Number(this.high.value)) });
    this.low = bound("Lowest value of the colours");
    this.high = bound("Highest value of the colours");
    this.unit = make("span", { class: "unit" });
    this.auto = make("button", {
      type: "button", title: "Colours for the values of the whole run", click: () => this.useRange(),
    }, "Auto");
    return make(
      "span", { class: "colorbar" }, this.low,
      make("span", { class: "bar", style: `background:${VIRIDIS_GRADIENT}` }), this.high, this.unit, this.auto,
    );
  }

  notes() {
    const notes = new Set(this.runs.flatMap((run) => run.notes ?? []));
    return make("p", { class: "notes" }, [...notes].join(" "));
  }

  setField(name) {
    this.field = name;
    this.useRange();
    this.show();
  }

  /** The range of the field over all frames there are. */
  useRange() {
    const range = rangeOf(this.entries(), this.field);
    if (!range) return;
    this.isAuto = true;
    this.applyRange(...range);
  }

  setRange(low, high) {
    if (!Number.isFinite(low) || !Number.isFinite(high) || high <= low) return this.useRange();
    this.isAuto = false;
    this.applyRange(low, high);
  }

  applyRange(low, high) {
    this.low.value = readable(low, 4).replaceAll("−", "-");
    this.high.value = readable(high, 4).replaceAll("−", "-");
    const { unit } = this.fields.find(({ name }) => name === this.field);
    this.unit.textContent = unitOf(unit, this.runs);
    this.views.forEach((view) => view.setRange(low, high));
  }

  setFollowing(isOn) {
    this.isFollowing = isOn;
    this.views.forEach((view) => {
      view.isFollowing = isOn;
      view.box = this.viewedBox();
      view.lookFrom();
    });
  }

  lookFrom(toward) {
    this.views.forEach((view) => view.lookFrom(toward));
  }

  /** The place of an event in the middle. */
  lookAt({ x }) {
    if (!x.every(Number.isFinite)) return;
    this.views.forEach((view) => view.moveTarget(new Vector3(...x)));
    this.views.forEach((view) => view.draw());
  }

  /** The frames of the moment; a late one never takes the place of a newer. */
  show() {
    return Promise.all(this.runs.map(async (run, r) => {
      if (run.frames.length === 0) return;
      const k = run.frames.nearest(this.timeline.t);
      const request = ++this.requests[r];
      const frame = run.frames.now(k) ?? (await run.frames.get(k));
      if (request !== this.requests[r]) return;
      this.views[r].show(frame, this.field);
      if (this.views[r].caption) this.views[r].caption.textContent = `t = ${readable(frame.t, 4)}`;
    }));
  }

  /** New frames have come. */
  extend() {
    if (this.isAuto) this.useRange();
    const box = this.viewedBox();
    const view = this.views[0];
    const grows = box.low.some((value, k) => value < view.box.low[k] - 1e-9) ||
      box.high.some((value, k) => value > view.box.high[k] + 1e-9);
    this.views.forEach((each) => {
      each.box = box;
      if (grows && !each.isFollowing) each.fit(new Vector3(...box.low), new Vector3(...box.high));
      each.draw();
    });
  }
}
