#include "meniscus/report/page_bundle.hpp"

namespace meniscus::report {
namespace {

// cmake/PageBundle.cmake makes these raw strings, empty where node or npm was not found.
// They are longer than what every compiler must accept.
#pragma GCC diagnostic ignored "-Woverlength-strings"
const char script[] =
#include "meniscus/report/page_script_generated.inc"
    ;
const char sheet[] =
#include "meniscus/report/page_sheet_generated.inc"
    ;

const char drawer[] =
#include "meniscus/report/drawer_script_generated.inc"
    ;
static_assert(sizeof(drawer) < 128 * 1024, "Linux takes no longer argument for `node -e`");

}  // namespace

std::string_view page_script() { return {script, sizeof(script) - 1}; }
std::string_view page_sheet() { return {sheet, sizeof(sheet) - 1}; }

std::string_view drawer_script() { return {drawer, sizeof(drawer) - 1}; }

}  // namespace meniscus::report
