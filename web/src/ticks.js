// The marks of an axis: {min, max, values, labels, factor}; the labels are to be multiplied by the factor
// ("×10⁻³"; "" where there is none).
const SUPERSCRIPTS = "⁰¹²³⁴⁵⁶⁷⁸⁹";

/** A whole number in raised digits. */
export function superscript(value) {
  return [...String(value)].map((c) => (c === "-" ? "⁻" : SUPERSCRIPTS[c])).join("");
}

/** 10 to a whole power, the nearest double: a product of tenths would not be. */
const powerOfTen = (exponent) => Number(`1e${exponent}`);

function exponentOf(value) {
  return Number(value.toExponential().split("e")[1]);
}

/** The smallest of 1, 2 or 5 times a power of ten that is not below `step`. */
function niceStep(step) {
  const power = powerOfTen(exponentOf(step));
  // Roundoff of the division must not push 2.0000000001 to 5.
  return ([1, 2, 5].find((factor) => step <= factor * power * (1 + 1e-9)) ?? 10) * power;
}

/** The exponent that all labels share: 0 unless they would have many zeros. */
function commonExponent(largest) {
  return largest === 0 || (largest >= 1e-2 && largest < 1e5) ? 0 : exponentOf(largest);
}

/** Widens a range that is a point, or so narrow that neighbouring marks would be the same double. */
function widened(low, high) {
  const largest = Math.max(Math.abs(low), Math.abs(high));
  if (high - low > Math.max(1e-9 * largest, 1e-300)) return [low, high];
  const half = largest > 1e-300 ? 0.1 * largest : 1; // below 1e-300 reciprocals overflow
  return [low - half, high + half];
}

/**
 * About `count` marks at 1, 2 or 5 times a power of ten around [low, high], both within ±1e300. The range
 * ends at marks where `isRounded`, else at the data. A range without extent is widened.
 */
export function linearTicks(dataLow, dataHigh, count, isRounded = true) {
  const [low, high] = widened(dataLow, dataHigh);
  const step = niceStep((high - low) / count);
  // Tolerance of a thousandth of a step: roundoff of the data must not lose a mark.
  const first = Math.floor(low / step + 1e-3);
  const last = Math.ceil(high / step - 1e-3);
  const ticks = { min: isRounded ? first * step : low, max: isRounded ? last * step : high, values: [], labels: [] };
  const exponent = commonExponent(Math.max(Math.abs(ticks.min), Math.abs(ticks.max)));
  const decimals = Math.min(100, Math.max(0, exponent - exponentOf(step * (1 + 1e-9))));
  for (let k = first; k <= last; ++k) {
    const value = k * step;
    if (value < ticks.min - 1e-3 * step || value > ticks.max + 1e-3 * step) continue;
    ticks.values.push(value);
    ticks.labels.push((value / powerOfTen(exponent) + 0).toFixed(decimals).replace("-", "−"));
  }
  ticks.factor = exponent === 0 ? "" : `×10${superscript(exponent)}`;
  return ticks;
}

/** 20 as "20", 2e-7 as "2×10⁻⁷". */
function oneDigit(value) {
  if (value >= 1e-4 && value < 1e6) return String(Number(value.toPrecision(1)));
  const [digit, exponent] = value.toExponential(0).split("e");
  return `${digit}×10${superscript(Number(exponent))}`;
}

/**
 * Marks at powers of ten around [low, high], 1e-300 < low ≤ high < 1e300. A short range also has marks at 2
 * and 5 times these powers.
 */
export function logTicks(low, high) {
  const first = Math.floor(Math.log10(low) + 1e-9);
  const last = Math.ceil(Math.log10(high) - 1e-9);
  const isShort = last - first <= 2;
  const stride = isShort ? 1 : Math.ceil((last - first) / 6); // an axis has room for about six labels
  let marks = [];
  for (let exponent = first; exponent <= last + stride; exponent += stride) {
    for (const factor of isShort ? [1, 2, 5] : [1]) {
      const value = factor * powerOfTen(exponent);
      if (marks.length > 1 && marks.at(-1).value > high * (1 - 1e-9)) break;
      if (value <= low * (1 + 1e-9)) marks = [];
      marks.push({ value, label: isShort ? oneDigit(value) : `10${superscript(exponent)}` });
    }
  }
  return {
    min: marks[0].value, max: marks.at(-1).value, factor: "",
    values: marks.map(({ value }) => value), labels: marks.map(({ label }) => label),
  };
}
