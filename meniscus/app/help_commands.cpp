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

}  // namespace

int explain_command(const std::string& key) {
  fmt::print("{}\n", key.empty() ? explain() : explain(key));
  return 0;
}

int examples_command(const std::string& name, bool is_overwrite) {
  if (name.empty()) {
    for (const ExampleCase& example : examples())
      fmt::print("{:<24} {}\n", example.name, headline(example.text));
    return 0;
  }
  const std::string_view text = example_text(name);
  const std::filesystem::path file = name + ".toml";
  if (std::filesystem::exists(file) && !is_overwrite)
    reject_input("{} exists already; give --overwrite to replace it", file.string());
  try {
    io::write_file(file, text);
  } catch (const RunFailure& failure) {
    throw InvalidInput(failure.what());  // the user chose the folder, and nothing is lost
  }
  fmt::print("wrote {}; run it with: meniscus run {}\n", file.string(), file.string());
  return 0;
}

}  // namespace meniscus
