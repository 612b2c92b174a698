#pragma once

#include "meniscus/app/commands.hpp"

namespace meniscus {

/// Exit status 0: done. Status 1: the run could not go on to its end, but left a checkpoint.
/// Status 2: the input was wrong, nothing is written.
///
/// A program that extends meniscus passes `set_up`, which prepares the state of each new run
/// (`RunArguments::set_up`).
[[nodiscard]] int run_command_line(int argc, char** argv, const SetUp& set_up = {});

}  // namespace meniscus
