// Scales of colour, the same as in the pictures of the program.

// Ten equidistant colours of matplotlib's viridis (S. van der Walt and N. Smith, 2015; CC0).
const VIRIDIS = [
  [68, 1, 84], [72, 40, 120], [62, 73, 137], [49, 104, 142], [38, 130, 142],
  [31, 158, 137], [53, 183, 121], [110, 206, 88], [181, 222, 43], [253, 231, 37],
];

/** Viridis at s in [0, 1] as three numbers in [0, 255]. */
export function viridis(s) {
  const at = Math.min(1, Math.max(0, Number.isFinite(s) ? s : 0)) * (VIRIDIS.length - 1);
  const k = Math.min(Math.floor(at), VIRIDIS.length - 2);
  const w = at - k;
  return VIRIDIS[k].map((part, i) => Math.round((1 - w) * part + w * VIRIDIS[k + 1][i]));
}

export function css([r, g, b]) {
  return `rgb(${r},${g},${b})`;
}

/** All of the scale from left to right, for a bar. */
export const VIRIDIS_GRADIENT = `linear-gradient(to right,${VIRIDIS.map(css).join(",")})`;

/** A style sheet's variable, as the page shows it now. */
export function variable(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

/** The lines' colours (Okabe and Ito, told apart with every kind of colour vision). */
export function lineColor(k) {
  return variable(`--curve${k % 6}`);
}

/** The liquids of a cut: the matrix, then the drops in turn. */
export function liquidColor(region) {
  return variable(region === 0 ? "--liquid0" : `--liquid${1 + ((region - 1) % 6)}`);
}
