// The moment the page shows, and the controls that move it: slider, play, marks of events.
import { make, readable } from "./text.js";

const FRAMES_PER_SECOND = 12;

export class Timeline extends EventTarget {
  /** `times`: of all moments there are, rising; `events`: [{t, label, …}]. */
  constructor(times, events) {
    super();
    this.times = times;
    this.events = events;
    this.at = 0;
    this.makeElement();
    this.update();
  }

  get t() {
    return this.times[this.at] ?? 0;
  }

  makeElement() {
    this.playButton = make("button", { class: "play", type: "button", click: () => this.toggle() });
    this.slider = make("input", {
      type: "range", min: 0, step: 1, value: 0, "aria-label": "Time",
      input: () => this.set(Number(this.slider.value)),
    });
    this.marks = make("div", { class: "marks" });
    this.output = make("output", { class: "time" });
    const step = (by, label, sign) =>
      make("button", { type: "button", title: label, "aria-label": label, click: () => this.step(by) }, sign);
    this.element = make(
      "div", { class: "timeline" }, this.playButton, step(-1, "Frame before (←)", "‹"),
      make("div", { class: "track" }, this.slider, this.marks), step(1, "Next frame (→)", "›"), this.output,
    );
  }

  /** New moments, of a run that goes on; who looks at the last one goes with it. */
  extend(times, events) {
    const wasAtEnd = this.at >= this.times.length - 1;
    this.times = times;
    this.events = events;
    this.update();
    if (wasAtEnd && !this.isPlaying) this.set(times.length - 1);
  }

  update() {
    this.slider.max = Math.max(0, this.times.length - 1);
    this.element.classList.toggle("single", this.times.length < 2);
    this.marks.replaceChildren(...this.events.map((event) => this.mark(event)));
    this.show();
  }

  mark(event) {
    const share = this.position(event.t) / Math.max(1, this.times.length - 1);
    return make("button", {
      type: "button", class: `mark ${event.kind}`, style: `left:${(100 * share).toFixed(2)}%`,
      title: event.label, "aria-label": `Go to ${event.label}`,
      click: () => this.goTo(event),
    });
  }

  /** Where a time lies among the frames, between them too. */
  position(t) {
    const after = this.times.findIndex((time) => time >= t);
    if (after < 0) return Math.max(0, this.times.length - 1);
    if (after === 0) return 0;
    const [a, b] = [this.times[after - 1], this.times[after]];
    return after - 1 + (b > a ? (t - a) / (b - a) : 1);
  }

  goTo(event) {
    this.pause();
    this.set(Math.round(this.position(event.t)));
    this.dispatchEvent(new CustomEvent("event", { detail: event }));
  }

  setTime(t) {
    this.set(Math.round(this.position(t)));
  }

  set(at) {
    const next = Math.max(0, Math.min(this.times.length - 1, at));
    if (next === this.at) return;
    this.at = next;
    this.show();
    this.dispatchEvent(new Event("change"));
  }

  step(by) {
    this.pause();
    this.set(this.at + by);
  }

  show() {
    this.slider.value = this.at;
    const text = `t = ${readable(this.t, 4)}`;
    this.slider.setAttribute("aria-valuetext", text);
    this.output.textContent = text;
    this.playButton.textContent = this.isPlaying ? "❚❚" : "▶";
    this.playButton.setAttribute("aria-label", this.isPlaying ? "Pause (space)" : "Play (space)");
    this.playButton.title = this.isPlaying ? "Pause (space)" : "Play (space)";
  }

  toggle() {
    if (this.isPlaying) this.pause();
    else this.play();
  }

  play() {
    if (this.times.length < 2) return;
    if (this.at === this.times.length - 1) this.set(0);
    this.isPlaying = true;
    this.show();
    this.timer = setInterval(() => {
      if (this.at === this.times.length - 1) this.pause();
      else this.set(this.at + 1);
    }, 1000 / FRAMES_PER_SECOND);
  }

  pause() {
    clearInterval(this.timer);
    this.isPlaying = false;
    this.show();
  }

  /** Keys of the whole page, unless they belong to what has the focus. */
  onKey(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return false;
    const keys = {
      " ": () => this.toggle(),
      ArrowLeft: () => this.step(-1),
      ArrowRight: () => this.step(1),
      Home: () => this.step(-this.times.length),
      End: () => this.step(this.times.length),
    };
    keys[event.key]?.();
    return event.key in keys;
  }
}
