// News of a run that goes on, from the server that the page came from.
import { fetched, Frames, Table, unpackedCuts, unpackedFrame } from "./data.js";
import { make, readable } from "./text.js";

const INTERVAL = 1000; // ms between two questions
const TABLES = ["history", "drops", "events", "timing", "reference"];

export class LiveRun {
  constructor(run) {
    this.run = {
      ...run,
      tables: Object.fromEntries(TABLES.map((name) => [name, new Table()])),
      frames: new Frames([], (k) => fetched(`/frame?number=${k}`), unpackedFrame),
      cuts: new Frames([], (k) => fetched(`/cut?number=${k}`), unpackedCuts),
    };
    this.bytes = Object.fromEntries(TABLES.map((name) => [name, 0]));
    this.phases = make("section", { class: "dynamic" });
    this.status = make("p", { class: "dynamic live", role: "status" }, "waiting for the first step …");
  }

  /** Asks once; returns what has come: {rows, frames, cuts}. */
  async ask() {
    const response = await fetch("/state", { cache: "no-store" });
    if (!response.ok) throw new Error(`state: ${response.status}`);
    const state = await response.json();
    const news = { rows: false, frames: false, cuts: false };
    for (const name of TABLES) {
      if (!(state.tables[name] > this.bytes[name])) continue;
      const text = await this.tail(name);
      this.bytes[name] += new TextEncoder().encode(text).length;
      this.run.tables[name].append(text);
      news.rows = true;
    }
    for (const kind of ["frames", "cuts"]) {
      const known = this.run[kind].entries.length;
      if (state[kind] <= known) continue;
      const list = await fetch(`/${kind}?from=${known}`, { cache: "no-store" });
      this.run[kind].entries.push(...(await list.json()));
      news[kind] = true;
    }
    this.show(state);
    return news;
  }

  /** New whole lines of a table. */
  async tail(name) {
    const response = await fetch(`/${name}.csv?from=${this.bytes[name]}`, { cache: "no-store" });
    const text = await response.text();
    return text.slice(0, text.lastIndexOf("\n") + 1);
  }

  show(state) {
    const { history, drops } = this.run.tables;
    const last = (table, name) => table.column(name).at(-1);
    const parts = [];
    if (history.length > 0) {
      const end = this.run.end ? ` of ${this.run.end}` : "";
      parts.push(`t = ${readable(last(history, "t"), 4)}${end}`, `step ${last(history, "step")}`);
      if (last(history, "drops") === 1) parts.push(`D = ${readable(last(drops, "D"), 4)}`);
      else parts.push(`${last(history, "drops")} drops`);
      parts.push(`${last(history, "surface_nodes")} surface nodes`);
    }
    this.isOver = state.status !== "running";
    this.setStatus(this.isOver ? `The run is ${state.status}` : "Running", parts);
  }

  /** Wall time by phase, as the report tells it at the end. */
  showPhases() {
    const { timing } = this.run.tables;
    const spent = timing.names.filter((name) => name !== "step" && name !== "t").map((name) => [
      name.replaceAll("_", " "), timing.column(name).reduce((sum, s) => sum + (Number.isFinite(s) ? s : 0), 0),
    ]);
    const longest = Math.max(...spent.map(([, seconds]) => seconds), 1e-9);
    const total = spent.reduce((sum, [, seconds]) => sum + seconds, 0) || 1;
    const row = ([name, seconds]) => make(
      "tr", {}, make("th", {}, name),
      make("td", { class: "phase" }, make("span", { style: `width:${((100 * seconds) / longest).toFixed(1)}%` })),
      make("td", { class: "n" }, `${readable(seconds, 3)} s`),
      make("td", { class: "n" }, `${Math.round((100 * seconds) / total)} %`),
    );
    this.phases.replaceChildren(
      make("h2", {}, "Time by phase"), make("div", { class: "card" }, make("table", {}, make("tbody", {}, ...spent.map(row)))),
    );
  }

  setStatus(word, parts = []) {
    this.status.replaceChildren(make("b", {}, word), parts.length ? ` · ${parts.join(" · ")}` : "");
    this.status.classList.toggle("over", word !== "Running");
  }

  /** Asks again and again; `onNews` hears of what has come. */
  async follow(onNews) {
    let misses = 0;
    while (!this.isOver && misses < 5) {
      try {
        const news = await this.ask();
        misses = 0;
        if (news.rows || news.frames || news.cuts) await onNews(news);
      } catch {
        ++misses;
      }
      await new Promise((resume) => setTimeout(resume, INTERVAL));
    }
    const where = "its folder holds report.html.";
    if (!this.isOver) this.setStatus(`The run has ended, or its server cannot be reached; ${where}`);
    else this.status.append(`; ${where}`);
  }
}
