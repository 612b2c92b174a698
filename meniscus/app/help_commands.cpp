#include <filesystem>

#include <fmt/format.h>

#include "meniscus/app/commands.hpp"
#include "meniscus/case/examples.hpp"
#include "meniscus/case/explain.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/io/atomic_file.hpp"

namespace meniscus {
namespace {

/// The first comment line of an example, which says what it shows.
std::string_view headline(std::string_view text) {
  const std::string_view line = text.substr(0, text.find('\n'));
  const std::size_t start = line.find_first_not_of("# ");
  return start == std::string_view::npos ? line : line.substr(start);
}

void require_absent(const std::string& file, bool is_overwrite) {
  if (std::filesystem::exists(file) && !is_overwrite)
    reject_input("{} exists already; give --overwrite to replace it", file);
}

void write(const std::string& file, std::string_view text) {
  try {
    io::write_file(file, text);
  } catch (const RunFailure& failure) {
    throw InvalidInput(failure.what());  // the user chose the folder, and nothing is lost
  }
}

}  // namespace

int explain_command(const std::string& key) {
  fmt::print("{}\n", key.empty() ? explain() : explain(key));
  return 0;
}

int examples_command(const std::string& name, bool is_overwrite) {
  if (name.empty()) {
    for (const ExampleCase& each : examples())
      fmt::print("{:<24} {}\n", each.name, headline(each.text));
    return 0;
  }
  const ExampleCase& chosen = example(name);
  const std::string file = name + ".toml", script = name + ".py";
  const bool has_script = !chosen.script.empty();
  require_absent(file, is_overwrite);
  if (has_script) require_absent(script, is_overwrite);
  write(file, chosen.text);
  if (has_script) write(script, chosen.script);
  if (has_script)
    fmt::print("wrote {0} and {1}; run it with: python3 {1} && meniscus run {0}\n", file, script);
  else
    fmt::print("wrote {0}; run it with: meniscus run {0}\n", file);
  return 0;
}

}  // namespace meniscus
