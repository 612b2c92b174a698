#include "meniscus/report/svg_plot.hpp"

namespace meniscus::report {

std::string_view plot_style() {
  return R"(
svg text{font-family:"Source Sans 3","Source Sans Pro",system-ui,-apple-system,"Segoe UI",Roboto,
"Helvetica Neue",Arial,"DejaVu Sans",sans-serif;font-size:12px;fill:#4a525c;font-variant-numeric:tabular-nums}
svg .bg{fill:#ffffff}
svg .ttl{font-size:14px;font-weight:600;fill:#1b2027}
svg .unit{font-weight:400;fill:#6b7480}
svg .small{font-size:11px;fill:#6b7480}
svg .grid{stroke:#e4e7eb;stroke-width:1;fill:none}
svg .ax{stroke:#9aa3ad;stroke-width:1;fill:none}
svg .mk{stroke:#9aa3ad;stroke-width:1;stroke-dasharray:2 3;fill:none}
svg .ln{fill:none;stroke-width:1.8;stroke-linejoin:round;stroke-linecap:round}
svg .mesh{stroke-linejoin:round}
svg .d1{stroke-dasharray:6 3.5}
svg .d2{stroke-dasharray:1.5 3.5}
svg .s0{stroke:#0072b2}svg .f0{fill:#0072b2}
svg .s1{stroke:#d55e00}svg .f1{fill:#d55e00}
svg .s2{stroke:#009e73}svg .f2{fill:#009e73}
svg .s3{stroke:#b5548a}svg .f3{fill:#b5548a}
svg .s4{stroke:#c98a00}svg .f4{fill:#c98a00}
svg .s5{stroke:#3a9bdc}svg .f5{fill:#3a9bdc}
@media screen and (prefers-color-scheme:dark){
svg text{fill:#a9b3be}
svg .bg{fill:#15191e}
svg .ttl{fill:#e8ebee}
svg .unit,svg .small{fill:#8a949f}
svg .grid{stroke:#2a3038}
svg .ax,svg .mk{stroke:#5c6672}
svg .s0{stroke:#56a8e0}svg .f0{fill:#56a8e0}
svg .s1{stroke:#f08a4b}svg .f1{fill:#f08a4b}
svg .s2{stroke:#35c79b}svg .f2{fill:#35c79b}
svg .s3{stroke:#e39ac4}svg .f3{fill:#e39ac4}
svg .s4{stroke:#f0c04a}svg .f4{fill:#f0c04a}
svg .s5{stroke:#9ad1f5}svg .f5{fill:#9ad1f5}
}
)";
}

}  // namespace meniscus::report
