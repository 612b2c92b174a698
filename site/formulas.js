// How MathJax 2 typesets the formulas of a page, which are scripts of the type math/tex: as SVG, without fonts or a menu.
window.MathJax = {
  extensions: ["TeX/AMSmath.js", "TeX/AMSsymbols.js", "AssistiveMML.js"],
  jax: ["input/TeX", "output/SVG"],
  showMathMenu: false,
  messageStyle: "none",
  SVG: { styles: { ".md-typeset .MathJax_SVG svg": { "max-width": "none" } } }, // the theme's 100 % is nothing here
};
