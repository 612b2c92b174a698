// A plot as it is seen, zoomed or not, as a file for a paper.
import { escaped } from "./text.js";

const WIDTH = 560;
const HEIGHT = 340;
const BOX = { left: 70, right: WIDTH - 16, top: 56, bottom: HEIGHT - 44 };

function positions(uplot) {
  const { x, y } = uplot.scales;
  const isLog = y.distr === 3;
  const scale = (value) => (isLog ? Math.log10(value) : value);
  const low = scale(y.min);
  const high = scale(y.max);
  return {
    toX: (t) => BOX.left + ((t - x.min) / (x.max - x.min)) * (BOX.right - BOX.left),
    toY: (v) => BOX.bottom - ((scale(v) - low) / (high - low)) * (BOX.bottom - BOX.top),
    isInside: (t) => t >= x.min && t <= x.max,
    isDrawable: (v) => v != null && (!isLog || v > 0),
  };
}

function axes(uplot, { toX, toY }, xLabel) {
  const [x, y] = uplot.axes;
  const text = (at, anchor, label) => `<text ${at} text-anchor="${anchor}">${escaped(String(label))}</text>`;
  let grid = "";
  let labels = "";
  x._splits.forEach((t, i) => {
    if (x._values[i] == null) return;
    grid += `M${toX(t).toFixed(1)} ${BOX.top}V${BOX.bottom}`;
    labels += text(`x="${toX(t).toFixed(1)}" y="${BOX.bottom + 17}"`, "middle", x._values[i]);
  });
  y._splits.forEach((v, i) => {
    if (y._values[i] == null || y._values[i] === "") return;
    grid += `M${BOX.left} ${toY(v).toFixed(1)}H${BOX.right}`;
    labels += text(`x="${BOX.left - 7}" y="${(toY(v) + 4).toFixed(1)}"`, "end", y._values[i]);
  });
  labels += text(`x="${(BOX.left + BOX.right) / 2}" y="${HEIGHT - 8}"`, "middle", xLabel);
  return `<path d="${grid}" stroke="#e4e7eb" fill="none"/><path d="M${BOX.left} ${BOX.top}V${BOX.bottom}H${BOX.right}" stroke="#9aa3ad" fill="none"/>${labels}`;
}

function path(t, values, { toX, toY, isInside, isDrawable }) {
  let d = "";
  let command = "M";
  t.forEach((time, i) => {
    if (!isInside(time)) command = "M";
    else if (isDrawable(values[i])) {
      d += `${command}${toX(time).toFixed(2)} ${toY(values[i]).toFixed(2)}`;
      command = "L";
    }
  });
  return d;
}

/** `curves`: [{label, color, dash, values}] on the times of the plot. */
export function plotSvg(uplot, { title, unit }, curves, events) {
  const place = positions(uplot);
  const t = uplot.data[0];
  const stroke = ({ color, dash }) => `stroke="${color}" stroke-width="1.8" fill="none" stroke-dasharray="${dash.join(" ")}"`;
  let legend = "";
  let at = 14;
  for (const curve of curves) {
    legend += `<path d="M${at} 37h20" ${stroke(curve)}/><text x="${at + 26}" y="41">${escaped(curve.label)}</text>`;
    at += 46 + 6.6 * curve.label.length;
  }
  const marks = events.filter((event) => place.isInside(event.t)).map((event) =>
    `<path d="M${place.toX(event.t).toFixed(1)} ${BOX.top}V${BOX.bottom}" stroke="#9aa3ad" stroke-dasharray="4 3"><title>${escaped(event.label)}</title></path>`);
  const lines = curves.map((curve) => `<path d="${path(t, curve.values, place)}" ${stroke(curve)}/>`);
  return `<?xml version="1.0" encoding="UTF-8"?>
<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${WIDTH} ${HEIGHT}" width="${WIDTH}" height="${HEIGHT}" font-family="Helvetica,Arial,sans-serif" font-size="12" fill="#1b2027"><rect width="${WIDTH}" height="${HEIGHT}" fill="#fff"/>
<text x="14" y="20" font-size="14" font-weight="600">${escaped(title)}${unit ? ` [${escaped(unit)}]` : ""}</text>
${axes(uplot, place, "time t [1/G]")}${marks.join("")}${lines.join("")}${curves.length > 1 ? legend : ""}
</svg>
`;
}
