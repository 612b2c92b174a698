// The page: what report.html, comparisons, studies and the live view do in the browser.
import "./page.css";
import { pageVariables, pictureStyle } from "./colors.js";
import { eventsOf } from "./curves.js";
import { CutView } from "./cut.js";
import { embeddedRun, pageData, takenElement } from "./data.js";
import { Explorer } from "./explorer.js";
import { LiveRun } from "./live.js";
import { History } from "./plots.js";
import { drawForPaper } from "./printed.js";
import { showStudy } from "./study.js";
import { download, make } from "./text.js";
import { Timeline } from "./timeline.js";

const app = document.getElementById("app");

/** All moments at which any run has a frame; of several runs no later than the shortest. */
function timesOf(runs) {
  const lists = runs.map((run) => run.frames.times).filter((times) => times.length > 0);
  if (lists.length === 0) return [];
  const end = Math.min(...lists.map((times) => times.at(-1)));
  const all = [...new Set(lists.flat())].sort((a, b) => a - b);
  return lists.length === 1 ? all : all.filter((t) => t <= end);
}

/** The 3-D view; without WebGL the pictures for paper stand in its place. */
function addExplorer(page, runs) {
  try {
    page.explorer = new Explorer(runs, page.timeline);
  } catch {
    app.append(make("p", { class: "dynamic notice" },
      "This browser shows no 3-D view (WebGL is missing or switched off)."));
    page.paper?.classList.remove("printed");
    return;
  }
  app.append(make("h2", { class: "dynamic" }, runs.length > 1 ? "Shapes at equal times" : "The interface"));
  app.append(page.explorer.element);
}

function addCut(page, run) {
  if (run.cuts.length === 0 || page.cut) return;
  page.cut = new CutView(run);
  page.cutPlace.replaceChildren(make("h2", {}, "A cut through the mesh"), page.cut.element);
  return page.cut.show();
}

function addHistory(page, runs) {
  const events = () => runs.flatMap((run) => eventsOf(run.tables.events));
  page.history = new History(runs, page.timeline, events);
  page.historyPlace.replaceChildren(page.history.element);
  page.history.draw();
}

/** Copying and saving the case, beside its text. */
function addCaseButtons(run) {
  const text = run.case_text;
  const summary = [...document.querySelectorAll("summary")].find((s) => s.textContent === "Case file");
  if (!text || !summary) return;
  const copy = make("button", { type: "button", id: "copy-case", click: async (event) => {
    event.preventDefault();
    copy.textContent = (await copied(text)) ? "Copied" : "Copying was refused";
    setTimeout(() => (copy.textContent = "Copy"), 2000);
  } }, "Copy");
  const save = make("button", { type: "button", click: (event) => {
    event.preventDefault();
    download((run.case_file.split("/").at(-1) || "case.toml"), text, "application/toml");
  } }, "Download");
  summary.append(make("span", { class: "dynamic tools" }, copy, save));
}

async function copied(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch { // not where the page is no secure place, or the reader forbids it
    const area = make("textarea", { style: "position:fixed;opacity:0" });
    area.value = text;
    document.body.append(area);
    area.select();
    const isDone = document.execCommand("copy");
    area.remove();
    return isDone;
  }
}

function listenForKeys(timeline) {
  document.addEventListener("keydown", (event) => {
    if (event.target.closest?.("input, select, textarea, button, summary, a")) return;
    if (timeline.onKey(event)) event.preventDefault();
  });
}

function newPage(runs) {
  const page = { timeline: new Timeline(timesOf(runs), runs.flatMap((run) => eventsOf(run.tables.events))) };
  page.cutPlace = make("div");
  page.historyPlace = make("div");
  listenForKeys(page.timeline);
  return page;
}

async function showRuns({ runs: entries }) {
  const runs = await Promise.all(entries.map((entry, number) => embeddedRun(entry, number, takenElement)));
  const page = newPage(runs);
  if (runs.some((run) => run.frames.length > 0)) {
    page.paper = make("section", { class: "printed" });
    addExplorer(page, runs);
    app.append(page.paper);
  }
  app.append(page.cutPlace, page.historyPlace);
  page.timeline.set(page.timeline.times.length - 1); // how it ended is what most want to see first
  await page.explorer?.show();
  await Promise.all(page.explorer?.views.map((view) => view.frame && view.drawn) ?? []);
  performance.mark("first-picture");
  addHistory(page, runs);
  if (runs.length === 1) {
    await addCut(page, runs[0]);
    addCaseButtons(runs[0]);
  }
  window.meniscus = page; // for tests, and for the curious
  performance.mark("ready");
  for (const run of runs) await run.frames.prepare();
  if (page.paper) drawForPaper(page.paper, runs);
  performance.mark("prepared");
}

async function showLive({ runs: [entry], id }) {
  const live = new LiveRun(entry, id);
  const { run } = live;
  const page = newPage([run]);
  const viewPlace = make("div");
  app.append(live.status, viewPlace, page.cutPlace, page.historyPlace, live.phases);
  window.meniscus = page;
  addCaseButtons(entry);
  await live.follow(async (news) => {
    const events = eventsOf(run.tables.events);
    if (news.frames || news.rows) page.timeline.extend(run.frames.times, events);
    if (news.frames && !page.explorer && !page.hasNoView) {
      addExplorer(page, [run]);
      page.hasNoView = !page.explorer;
      viewPlace.append(...app.querySelectorAll(":scope > h2, :scope > .explorer, :scope > .notice"));
      await page.explorer?.show();
    } else if (news.frames) {
      page.explorer?.extend();
    }
    if (news.rows) live.showPhases();
    if (news.cuts && page.cut) page.cut.extend();
    else if (news.cuts) await addCut(page, run);
    if (news.rows && page.history) page.history.extend();
    else if (news.rows) addHistory(page, [run]);
  });
}

document.head.append(make("style", {}, pictureStyle() + pageVariables()));
const data = pageData();
const SHOW = { report: showRuns, comparison: showRuns, live: showLive, study: (study) => showStudy(app, study) };
document.documentElement.classList.add(`${data.kind}-page`);
SHOW[data.kind](data).catch((error) => {
  app.prepend(make("p", { class: "notice" }, `This page could not be shown in full: ${error.message}`));
});
