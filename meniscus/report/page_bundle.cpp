#include "meniscus/report/page_bundle.hpp"

namespace meniscus::report {
namespace {

// cmake/PageBundle.cmake makes these two raw strings, empty where node or npm was not found.
// They are longer than what every compiler must accept.
#pragma GCC diagnostic ignored "-Woverlength-strings"
const char script[] =
#include "meniscus/report/page_script_generated.inc"
    ;
const char sheet[] =
#include "meniscus/report/page_sheet_generated.inc"
    ;

}  // namespace

std::string_view page_script() { return {script, sizeof(script) - 1}; }
std::string_view page_sheet() { return {sheet, sizeof(sheet) - 1}; }

}  // namespace meniscus::report
