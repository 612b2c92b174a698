#include "meniscus/report/page.hpp"

#include <fmt/format.h>

#include "meniscus/report/page_bundle.hpp"
#include "meniscus/report/page_style.hpp"
#include "meniscus/report/text.hpp"

namespace meniscus::report {
namespace {

// Where pictures are missing, the page says why.
constexpr std::string_view unbuilt_note =
    "<p class=\"lead\">This page has no pictures: the program was built without node and npm. "
    "Install both, build again and run <code>meniscus report</code> on this folder.</p>\n";
constexpr std::string_view no_script_note =
    "<noscript><p class=\"lead\">The pictures of this page need scripts. "
    "<code>meniscus report --svg</code> writes them as files.</p></noscript>\n";

/// The content security policy: the page loads nothing, so that it is the same wherever it is
/// stored. Scripts are inline. Only a live page may send requests, and only to its own server.
std::string policy(bool is_live) {
  return fmt::format("default-src 'none'; style-src 'unsafe-inline'{}{}",
                     has_page_bundle() ? "; script-src 'unsafe-inline'" : "",
                     is_live ? "; connect-src 'self'" : "");
}

std::string_view units_text(PageUnits units) {
  switch (units) {
    case PageUnits::of_rate:
      return "Lengths in R₀, times in 1/G, stresses in μG; G is the rate of strain or shear, μ the "
             "outer viscosity.";
    case PageUnits::at_rest:
      return "Lengths in R₀, times in μR₀/σ, stresses in σ/R₀; σ is the tension, μ the outer "
             "viscosity.";
    case PageUnits::both:
      return "Lengths in R₀, times in 1/G, stresses in μG; G is the rate of strain or shear, μ the "
             "outer viscosity. In a quiescent flow times are in μR₀/σ, stresses in σ/R₀; σ is the "
             "tension.";
  }
  return {};
}

}  // namespace

std::string whole_page(const PageParts& parts) {
  const bool has_script = has_page_bundle() && !parts.data.empty();
  const std::string script =
      has_script ? fmt::format("{}<script>{}</script>\n", parts.data, page_script()) : "";
  const std::string_view note = !has_page_bundle() && !parts.data.empty() ? unbuilt_note
                                : has_script                              ? no_script_note
                                                                          : "";
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"{}\"/>\n"
      "<title>{}</title>\n<style>{}{}</style>\n</head>\n"
      "<body>\n<main>\n{}{}<footer>{} The figures behind the plots are in history.csv and "
      "drops.csv beside this page, the meshes in the .pvd files.</footer>\n</main>\n{}</body>\n"
      "</html>\n",
      policy(parts.is_live), markup_text(parts.title), page_style(), page_sheet(), parts.content,
      note, units_text(parts.units), script);
}

}  // namespace meniscus::report
