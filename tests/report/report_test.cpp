#include "meniscus/report/report.hpp"

#include <cstdlib>

#include <gtest/gtest.h>

#include "tests/report/synthetic_run.hpp"
namespace meniscus {
TEST(Report, Look) {
  const std::filesystem::path f = "/tmp/look";
  test::write_synthetic_run(f / "one", {});
  test::write_synthetic_run(f / "two", {.num_drops = 2});
  for (auto d : {"one", "two"}) {
    write_report(f / d);
    write_interface_svg(f / d, f / d / "i.svg");
    write_history_svg(f / d, f / d / "h.svg");
  }
}
}  // namespace meniscus
