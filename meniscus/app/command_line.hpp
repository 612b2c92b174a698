#pragma once

namespace meniscus {

/// Exit status: 0 done; 1 the run could not go on to its end (a checkpoint is left); 2 the input
/// was wrong (nothing is written).
[[nodiscard]] int run_command_line(int argc, char** argv);

}  // namespace meniscus
