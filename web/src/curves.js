// From the tables of runs to plots of their history.
import { CATALOGUE, unitOf } from "./catalogue.js";
import { NUM_CURVE_COLORS, NUM_DASHES } from "./colors.js";
import { hasValues } from "./plot.js";
import { readable } from "./text.js";

const MOST_DROPS_IN_LEGEND = 6; // the number of colours

/** The plots of runs: the catalogue, its plots of bulk scalars (named `*`) for each that the tables name. */
export function specsOf(runs) {
  return CATALOGUE.flatMap((spec) => {
    const [first] = spec.quantities;
    if (!first.column.startsWith("*")) return [spec];
    return scalarNames(first.column.slice(1), runs.map((run) => run.tables[spec.table])).map((name) => {
      const named = (text) => text.replace("*", () => name);
      const quantities = spec.quantities.map(({ column, label }) => ({ column: named(column), label: named(label) }));
      return { ...spec, title: named(spec.title), quantities };
    });
  });
}

function scalarNames(suffix, tables) {
  const columns = tables.flatMap((table) => table?.names ?? []);
  return [...new Set(columns.filter((c) => c.endsWith(suffix)).map((c) => c.slice(0, -suffix.length)))];
}

/** [{label, drop, quantity, x, y}] of one run; `drop` is -1 where a table has none. */
function curvesOf(spec, run) {
  const table = run.tables[spec.table];
  if (!table) return [];
  if (spec.derivation === "sum") return sumCurve(table);
  const curves = spec.table === "drops" ? dropCurves(spec, table) : plainCurves(spec, table);
  if (spec.derivation === "percent") {
    if (curves.length !== 2) return [];
    const [part, whole] = curves;
    return [{ ...part, y: part.y.map((v, i) => (100 * v) / Math.abs(whole.y[i])) }];
  }
  if (spec.derivation === "gap-at-zeros") {
    return curves.map((curve) => ({ ...curve, y: curve.y.map((v) => (v === 0 ? NaN : v)) }));
  }
  return curves;
}

/** The same columns of the reference. */
function referencesOf(spec, run) {
  return run.tables.reference && !spec.derivation ? plainCurves(spec, run.tables.reference) : [];
}

function plainCurves(spec, table) {
  return spec.quantities.flatMap(({ column, label }, quantity) =>
    table.has(column) && table.has("t")
      ? [{ label, quantity, drop: -1, x: table.column("t"), y: table.column(column) }]
      : [],
  );
}

function dropCurves(spec, table) {
  const rows = new Map();
  table.column("drop").forEach((drop, i) => {
    if (!Number.isFinite(drop)) return;
    if (!rows.has(drop)) rows.set(drop, []);
    rows.get(drop).push(i);
  });
  const whole = plainCurves(spec, table);
  return [...rows.keys()].sort((a, b) => a - b).flatMap((drop) =>
    whole.map((curve) => ({
      ...curve, drop,
      label: rows.size === 1 ? curve.label : `${curve.label} of drop ${drop}`,
      x: rows.get(drop).map((i) => curve.x[i]),
      y: rows.get(drop).map((i) => curve.y[i]),
    })),
  );
}

function sumCurve(table) {
  const x = table.column("t");
  const y = x.map(() => 0);
  for (const name of table.names) {
    if (name === "step" || name === "t") continue;
    table.column(name).forEach((v, i) => {
      if (Number.isFinite(v)) y[i] += v;
    });
  }
  return x.length === 0 ? [] : [{ label: "wall time", quantity: 0, drop: -1, x, y }];
}

/**
 * The curves of one run. With one drop or none, colours tell quantities apart; with several, colours tell
 * drops and dashes quantities apart.
 */
function curvesOfRun(spec, run) {
  const curves = curvesOf(spec, run);
  const drops = [...new Set(curves.map(({ drop }) => drop))];
  const isSingle = drops.length <= 1;
  const hasSeveral = spec.quantities.length > 1 && !spec.derivation;
  const styled = curves.map(({ label, quantity, drop, x, y }) => {
    const rank = drops.indexOf(drop);
    const isNamed = isSingle ? hasSeveral : quantity === 0 && rank < MOST_DROPS_IN_LEGEND;
    return {
      name: label, x, y, color: isSingle ? quantity : rank, dash: isSingle ? 0 : quantity,
      legend: isNamed ? (isSingle ? label : `drop ${drop}`) : "",
    };
  });
  if (curves.length === 0) return styled;
  const references = referencesOf(spec, run).map(({ label, x, y }, i) => ({
    name: `${label}, reference`, legend: i === 0 ? "reference" : "", x, y, dash: 2, isReference: true,
  }));
  return [...styled, ...references];
}

/** The curves of several runs: colours tell runs apart, dashes quantities; a second round of colours has its own. */
function curvesOfRuns(spec, runs) {
  return runs.flatMap((run, r) => curvesOf(spec, run).map(({ label, drop, quantity, x, y }, i) => ({
    name: spec.quantities.length > 1 || drop > 0 ? `${run.name}: ${label}` : run.name,
    legend: i === 0 ? run.name : "", x, y, color: r,
    dash: (quantity % NUM_DASHES) + NUM_DASHES * (Math.floor(r / NUM_CURVE_COLORS) % 2),
  })));
}

/** A plot of the history of one run, or of several in one; marks at its events. */
export function historyPlot(spec, runs, events) {
  const curves = runs.length > 1 ? curvesOfRuns(spec, runs) : curvesOfRun(spec, runs[0]);
  const isOfDrops = runs.length === 1 && new Set(curves.map(({ color }) => color)).size > 1 && curves.some(({ dash }) => dash === 1);
  const [first, second, third] = spec.quantities.map(({ label }) => label);
  const { group, title, isLog, includesZero } = spec;
  return {
    group, unit: unitOf(spec.unit, runs), isLog, includesZero, curves,
    title: isOfDrops && third ? `${title}: ${first} solid, ${second} dashed, ${third} dotted` : title,
    xLabel: `time t [${unitOf("1/G", runs)}]`,
    marks: events.map(({ t, label }) => ({ x: t, label })),
    width: 560, height: 300,
  };
}

/** All plots of the history that runs have values for. */
export function historyPlots(runs, events) {
  return specsOf(runs).map((spec) => historyPlot(spec, runs, events)).filter(hasValues);
}

/** Rows of events.csv: [{t, kind, label, x}], x the place. */
export function eventsOf(table) {
  if (!table || !table.names.includes("t")) return [];
  const kinds = table.texts("kind");
  const number = (name, i) => table.column(name)[i];
  return table.column("t").flatMap((t, i) =>
    Number.isFinite(t)
      ? [{
          t, kind: kinds[i] ?? "event", label: `${kinds[i] ?? "event"} at t = ${readable(t, 4)}`,
          x: [number("x", i), number("y", i), number("z", i)],
        }]
      : [],
  );
}
