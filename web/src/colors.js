// All colours: the scale of values, curves and liquids, by day and by night.

// Ten equidistant colours of matplotlib's viridis (S. van der Walt and N. Smith, 2015; CC0): lightness rises
// evenly, readable without colour vision.
const VIRIDIS = [
  [68, 1, 84], [72, 40, 120], [62, 73, 137], [49, 104, 142], [38, 130, 142],
  [31, 158, 137], [53, 183, 121], [110, 206, 88], [181, 222, 43], [253, 231, 37],
];

/** Viridis at s (values beyond [0, 1] as at its ends) as three numbers in [0, 255]. */
export function viridis(s) {
  const at = Math.min(1, Math.max(0, Number.isFinite(s) ? s : 0)) * (VIRIDIS.length - 1);
  const k = Math.min(Math.floor(at), VIRIDIS.length - 2);
  const w = at - k;
  return VIRIDIS[k].map((part, i) => Math.round((1 - w) * part + w * VIRIDIS[k + 1][i]));
}

/** "#rrggbb". */
export function hex(color) {
  return `#${color.map((part) => Math.round(Math.min(255, Math.max(0, part))).toString(16).padStart(2, "0")).join("")}`;
}

/** All of the scale from left to right, for a bar. */
export const VIRIDIS_GRADIENT = `linear-gradient(to right,${VIRIDIS.map(hex).join(",")})`;

/**
 * Lines and liquids. Lines have the colours of Okabe and Ito, darker by day where they need it: told apart
 * with every kind of colour vision, 3 : 1 or more against the paper.
 */
export const PALETTES = {
  light: {
    paper: "#ffffff", ink: "#1b2027", text: "#4a525c", faint: "#68717c", grid: "#e4e7eb", axis: "#8a939d", cell: "#5c6671",
    curves: ["#0072b2", "#d55e00", "#00875f", "#b5548a", "#a87200", "#2a86c4"],
    liquids: ["#eef1f5", "#8fc1e3", "#f3b58a", "#8fd6bb", "#dfb3cd", "#ecd08a", "#b9c4d0"],
  },
  dark: {
    paper: "#15191e", ink: "#e8ebee", text: "#a9b3be", faint: "#8a949f", grid: "#2a3038", axis: "#6b7681", cell: "#98a2ad",
    curves: ["#56a8e0", "#f08a4b", "#35c79b", "#e39ac4", "#f0c04a", "#9ad1f5"],
    liquids: ["#20262d", "#2f6288", "#8a5630", "#2b7059", "#7a4a66", "#7c6424", "#4d5864"],
  },
};
export const NUM_CURVE_COLORS = PALETTES.light.curves.length;
export const NUM_DASHES = 4; // of one colour; a second round of the colours has as many others

/** Which of the liquids' colours a region has: the matrix the first, drops the others in turn. */
export function liquidOf(region) {
  return region <= 0 ? 0 : 1 + ((region - 1) % (PALETTES.light.liquids.length - 1));
}

function rulesOf({ paper, ink, text, faint, grid, axis, cell, curves, liquids }) {
  return [
    `svg text{fill:${text}}`, `svg .bg{fill:${paper}}`, `svg .ttl{fill:${ink}}`, `svg .unit,svg .small{fill:${faint}}`,
    `svg .grid{stroke:${grid}}`, `svg .ax,svg .mk{stroke:${axis}}`, `svg .ref{stroke:${faint}}`, `svg .fref{fill:${faint}}`,
    `svg .cut .liquid{stroke:${cell}}`, `svg .cut .values{stroke:${paper}}`,
    ...curves.map((color, k) => `svg .s${k}{stroke:${color}}svg .f${k}{fill:${color}}`),
    ...liquids.map((color, k) => `svg .q${k}{fill:${color}}`),
  ].join("\n");
}

/** The style sheet of all pictures, by day and by night. */
export function pictureStyle() {
  return `
svg text{font-family:"Source Sans 3","Source Sans Pro",system-ui,-apple-system,"Segoe UI",Roboto,
"Helvetica Neue",Arial,"DejaVu Sans",sans-serif;font-size:12px;font-variant-numeric:tabular-nums}
svg .ttl{font-size:14px;font-weight:600}
svg .unit{font-weight:400}
svg .small{font-size:11px}
svg .grid,svg .ax,svg .mk{stroke-width:1;fill:none}
svg .mk{stroke-dasharray:2 3}
svg .ln{fill:none;stroke-width:1.8;stroke-linejoin:round;stroke-linecap:round}
svg .mesh{stroke-linejoin:round}
svg .d1{stroke-dasharray:6 3.5}
svg .d2{stroke-dasharray:1.5 3.5}
svg .d3{stroke-dasharray:8 3 2 3}
svg .d4{stroke-dasharray:14 3}
svg .d5{stroke-dasharray:10 2 1.5 2 1.5 2}
svg .d6{stroke-dasharray:1.5 7}
svg .d7{stroke-dasharray:3 3}
${rulesOf(PALETTES.light)}
@media screen and (prefers-color-scheme:dark){
${rulesOf(PALETTES.dark)}
}
`;
}

/** The same colours as variables of a page's style sheet. */
export function pageVariables() {
  const variables = ({ curves, liquids }) =>
    [...curves.map((color, k) => `--curve${k}:${color}`), ...liquids.map((color, k) => `--liquid${k}:${color}`)].join(";");
  return `:root{${variables(PALETTES.light)}}
@media screen and (prefers-color-scheme:dark){:root{${variables(PALETTES.dark)}}}
`;
}
