// What the tables of a run give for a plot of the catalogue, as the program computes it for its
// pictures (meniscus/report/history_curves.cpp).

/** The plots of runs: the catalogue, its plots of bulk scalars (named `*`) for each that the tables name. */
export function plotsOf(catalogue, runs) {
  return catalogue.flatMap((plot) => {
    const [first] = plot.quantities;
    if (!first.column.startsWith("*")) return [plot];
    return scalarNames(first.column.slice(1), runs.map((run) => run.tables[plot.table])).map((name) => {
      const named = (text) => text.replace("*", () => name);
      const quantities = plot.quantities.map(({ column, label }) => ({ column: named(column), label: named(label) }));
      return { ...plot, title: named(plot.title), quantities };
    });
  });
}

function scalarNames(suffix, tables) {
  const columns = tables.flatMap((table) => table?.names ?? []);
  return [...new Set(columns.filter((c) => c.endsWith(suffix)).map((c) => c.slice(0, -suffix.length)))];
}

/** [{label, drop, quantity, column, table, t, values}] of one run. */
export function curvesOf(plot, run) {
  const table = run.tables[plot.table];
  if (!table) return [];
  if (plot.derivation === "sum") return sumCurve(table);
  const curves = plot.table === "drops" ? dropCurves(plot, table) : plainCurves(plot, table);
  if (plot.derivation === "percent") {
    if (curves.length !== 2) return [];
    const [part, whole] = curves;
    return [{ ...part, values: part.values.map((v, i) => (100 * v) / Math.abs(whole.values[i])) }];
  }
  if (plot.derivation === "gap-at-zeros") {
    return curves.map((curve) => ({ ...curve, values: curve.values.map((v) => (v === 0 ? NaN : v)) }));
  }
  return curves;
}

/** The same columns of the reference. */
export function referenceOf(plot, run) {
  if (!run.tables.reference || plot.derivation !== "none") return [];
  return plainCurves(plot, run.tables.reference);
}

function plainCurves(plot, table) {
  return plot.quantities.flatMap(({ column, label }, quantity) =>
    table.has(column)
      ? [{ label, quantity, column, t: table.column("t"), values: table.column(column) }]
      : [],
  );
}

function dropCurves(plot, table) {
  const rows = new Map();
  table.column("drop").forEach((drop, i) => {
    if (!Number.isFinite(drop)) return;
    if (!rows.has(drop)) rows.set(drop, []);
    rows.get(drop).push(i);
  });
  const whole = plainCurves(plot, table);
  return [...rows.keys()].sort((a, b) => a - b).flatMap((drop) =>
    whole.map((curve) => ({
      ...curve, drop,
      label: rows.size === 1 ? curve.label : `${curve.label} of drop ${drop}`,
      t: rows.get(drop).map((i) => curve.t[i]),
      values: rows.get(drop).map((i) => curve.values[i]),
    })),
  );
}

function sumCurve(table) {
  const t = table.column("t");
  const values = t.map(() => 0);
  for (const name of table.names) {
    if (name === "step" || name === "t") continue;
    table.column(name).forEach((v, i) => {
      if (Number.isFinite(v)) values[i] += v;
    });
  }
  return t.length === 0 ? [] : [{ label: "wall time", quantity: 0, column: "", t, values }];
}
