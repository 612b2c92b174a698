#pragma once

#include <string>

namespace CLI {
class App;
}

namespace meniscus {

/// The manual page of the program in section 1, in the language of man(7): every command with the
/// options and sentences of its own help.
[[nodiscard]] std::string manual_page(const CLI::App& program);

/// Completion for bash: commands; options after a dash; names of examples, benchmarks and keys
/// where a command takes one; else files.
[[nodiscard]] std::string bash_completion(const CLI::App& program);

}  // namespace meniscus
