// What is shown of a run: the plots of its history, and the fields that colour an interface or a cut.

// A `*` in titles, columns and labels stands for the name of a bulk scalar: each has plots of its own. How
// columns become curves (`derivation`): "" each as it is; "percent" the first in per cent of the magnitude of the second; "sum"
// all columns but step and t, added; "gap-at-zeros" a 0 stands for no value. `unit` is that of the values.

// Of flows that impose a rate G; `unitOf` has those of quiescent ones.
const plot = (table, title, unit, columns, more = {}) => ({
  table, title, unit, derivation: "", isLog: false, includesZero: false, ...more,
  quantities: Object.entries(columns).map(([column, label]) => ({ column, label })),
});
const drops = (...rest) => plot("drops", ...rest);
const history = (...rest) => plot("history", ...rest);
const fromZero = { includesZero: true };

const GROUPS = {
  Shape: [
    drops("Deformation D = (L − B)/(L + B)", "", { D: "D" }, fromZero),
    drops("Half lengths", "R₀", { L: "L", B: "B", W: "W" }),
    drops("Inclination of L to the flow", "°", { angle_deg: "θ" }),
    drops("Largest mean curvature H", "1/R₀", { H_max: "H" }),
    drops("Volume drift V/V₀ − 1", "", { volume_drift: "V/V₀ − 1" }, fromZero),
    drops("Shift that restores the volume", "R₀", { volume_correction: "shift" }),
  ],
  Surfactant: [
    drops("Concentration Γ over the initial one", "", { surfactant_min: "least", surfactant_max: "largest" }),
    drops("Least tension over that at Γ = 1", "", { tension_min: "σ/σ₁" }),
  ],
  Inertia: [
    drops("Velocity of the drop, the mean over its volume", "GR₀",
      { velocity_x: "v_x", velocity_y: "v_y", velocity_z: "v_z" }, fromZero),
    drops("Reynolds number of the drop's motion", "", { reynolds: "Re" }),
    drops("Sphericity", "", { sphericity: "area of the sphere over its own" }),
    history("Kinetic energy of all liquids", "μGR₀³", { kinetic_energy: "energy" }, fromZero),
  ],
  "Temperature and species": [
    history("*: amount", "R₀³", { "*_total": "amount" }),
    drops("*: amount in the drops", "R₀³", { "*_amount": "amount" }),
    history("*: amount gained per time", "R₀³G", { "*_boundary_rate": "through the boundary", "*_source_rate": "from sources" }),
    history("*: range", "", { "*_min": "least", "*_max": "largest" }),
    drops("*: Nusselt number", "", { "*_nusselt": "Nu" }),
    drops("*: Sherwood number", "", { "*_sherwood": "Sh" }),
  ],
  "Energy and stress": [
    history("Power", "μG²R₀³", { power_in: "power in", dissipation: "dissipation",
      surface_rate: "rate of surface energy", kinetic_rate: "rate of kinetic energy" }),
    history("Energy residual over power in", "%", { power_residual: "residual", power_in: "power in" },
      { includesZero: true, derivation: "percent" }),
    history("Shear stress (xy) added by the drops", "μG", { stress_xy: "xy" }),
    history("Normal stress differences added by the drops", "μG", { N1: "N₁", N2: "N₂" }),
  ],
  "Mesh and solver": [
    history("Size of the meshes", "", { surface_nodes: "surface nodes", nodes: "nodes", tetrahedra: "tetrahedra" }, { isLog: true }),
    history("Time step Δt", "1/G", { dt: "Δt" }, { derivation: "gap-at-zeros" }), // no step led to the first row
    history("Linear iterations per step", "", { linear_iterations: "iterations" }, fromZero),
    history("Smallest dihedral angle", "°", { min_dihedral_deg: "angle" }, fromZero),
    history("Smallest gap", "R₀", { min_gap: "gap" }, { isLog: true }),
    plot("timing", "Wall time per step", "s", { "": "wall time" }, { includesZero: true, derivation: "sum" }),
  ],
};

// Units in a quiescent flow, where G stands for σ/(μR₀).
const UNITS_AT_REST = {
  "1/G": "μR₀/σ", "GR₀": "σ/μ", "μG": "σ/R₀", "μGR₀³": "σR₀²", "R₀³G": "R₀²σ/μ", "μG²R₀³": "σ²R₀/μ",
};

/** A unit of the catalogue in the flows of runs; where they differ, both. */
export function unitOf(unit, runs) {
  const units = runs.map(({ isQuiescent }) => (isQuiescent ? (UNITS_AT_REST[unit] ?? unit) : unit));
  return [...new Set(units)].join(" or ");
}

/** All plots; those of one group follow each other. */
export const CATALOGUE = Object.entries(GROUPS).flatMap(([group, plots]) => plots.map((entry) => ({ group, ...entry })));

/** Arrays of the frames with their names for readers; the first that frames have is shown at first. */
export const FIELDS = [
  { name: "curvature", label: "Curvature κ = k₁ + k₂", unit: "1/R₀" },
  { name: "normal_velocity", label: "Normal velocity v·n", unit: "GR₀" },
  { name: "pressure_jump", label: "Pressure jump p_out − p_in", unit: "μG" },
  { name: "pressure", label: "Pressure p", unit: "μG" },
  { name: "surfactant", label: "Surfactant concentration Γ", unit: "" },
  { name: "node_density", label: "Nodes per area", unit: "1/R₀²" },
];
