// News of a run that goes on, from the server that the page came from.
import { fetched, Frames, Table, unpackedCuts, unpackedFrame } from "./data.js";
import { make, readable } from "./text.js";

const INTERVAL = 1000; // ms between two questions
const MOST_MISSES = 5; // questions in turn that nobody answers
const TABLES = ["history", "drops", "events", "timing", "reference"];
const PARTS = ["frames", "cuts"];
const LINE_END = 10;

export class LiveRun {
  /** `id` is that of the run which the page came from: its server refuses parts of another. */
  constructor(run, id) {
    this.id = id;
    this.run = {
      ...run,
      tables: Object.fromEntries(TABLES.map((name) => [name, new Table()])),
      frames: new Frames([], (k) => fetched(this.url("frame", "number", k)), unpackedFrame),
      cuts: new Frames([], (k) => fetched(this.url("cut", "number", k)), unpackedCuts),
    };
    this.bytes = Object.fromEntries(TABLES.map((name) => [name, 0]));
    this.phases = make("section", { class: "dynamic" });
    this.status = make("p", { class: "dynamic live", role: "status" }, "waiting for the first step …");
  }

  url(path, argument, value) {
    return `/${path}?${argument}=${value}&run=${this.id}`;
  }

  /** Asks once; returns what has come: {rows, frames, cuts}. */
  async ask() {
    const state = await (await answered("/state")).json();
    if (!this.isOurs(state)) {
      this.isAnother = true;
      location.reload();
      return {};
    }
    const news = { rows: false, frames: false, cuts: false };
    let isWhole = true;
    for (const name of TABLES) {
      if (state.tables[name] === this.bytes[name]) continue;
      const { hasRows, hasAll } = await this.appendTail(name, state.tables[name]);
      news.rows ||= hasRows;
      isWhole &&= hasAll;
    }
    for (const kind of PARTS) {
      const known = this.run[kind].entries.length;
      if (state[kind] === known) continue;
      const list = await answered(this.url(kind, "from", known));
      this.run[kind].entries.push(...(await list.json()));
      news[kind] = true;
    }
    this.show(state);
    this.isWhole = isWhole;
    return news;
  }

  /** Whether a state follows those before: the same run, and nothing has become shorter. */
  isOurs(state) {
    return state.run === this.id && TABLES.every((name) => state.tables[name] >= this.bytes[name]) &&
      PARTS.every((kind) => state[kind] >= this.run[kind].entries.length);
  }

  /** Adds the new whole lines of a table; `size`: what it has in all. Answers are limited in length. */
  async appendTail(name, size) {
    const response = await answered(this.url(`${name}.csv`, "from", this.bytes[name]));
    const bytes = new Uint8Array(await response.arrayBuffer());
    const hasAll = this.bytes[name] + bytes.length >= size;
    // The run's own tables grow by lines; people may leave out the last line break of a reference.
    const end = name === "reference" && hasAll ? bytes.length : bytes.lastIndexOf(LINE_END) + 1;
    this.bytes[name] += end;
    this.run.tables[name].append(new TextDecoder().decode(bytes.subarray(0, end)));
    return { hasRows: end > 0, hasAll };
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
    if (this.isOver) this.setBadge(state.status);
  }

  /** The word beside the title, which the server wrote when the run began. */
  setBadge(status) {
    const badge = document.querySelector("header .status");
    if (!badge) return;
    const [word] = status.split(":");
    badge.textContent = word;
    badge.className = `status ${["done", "failed"].includes(word) ? word : "other"}`;
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

  /** Asks again and again until the run is over and all of it has come; `onNews` hears of what has come. */
  async follow(onNews) {
    let misses = 0;
    let news = {};
    while (!this.isAnother && misses < MOST_MISSES) {
      try {
        const more = await this.ask();
        misses = 0;
        Object.keys(more).forEach((kind) => (news[kind] ||= more[kind]));
        if (this.isOver && !this.isWhole && more.rows) continue; // a server whose run is over does not wait for long
        const told = news;
        news = {};
        if (told.rows || told.frames || told.cuts) await onNews(told);
      } catch {
        ++misses;
      }
      if (this.isOver && this.isWhole) break;
      await new Promise((resume) => setTimeout(resume, INTERVAL));
    }
    if (this.isAnother) return;
    const where = "its folder holds report.html.";
    if (!this.isOver) this.setStatus(`The run has ended, or its server cannot be reached; ${where}`);
    else this.status.append(this.isWhole ? `; ${where}` : `; its last rows have not come; ${where}`);
  }
}

/** What the server answers; throws where it refuses. */
async function answered(url) {
  const response = await fetch(url, { cache: "no-store" });
  if (!response.ok) throw new Error(`${url}: ${response.status}`);
  return response;
}
