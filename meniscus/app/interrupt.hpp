#pragma once

namespace meniscus {

/// A full disk or a closed pipe shall be an error of a write, not a signal that ends the program.
void ignore_write_signals();
/// From here on Ctrl-C, SIGTERM and SIGUSR1 ask the run to stop after its step.
void watch_for_interrupts();
[[nodiscard]] bool is_interrupted();

}  // namespace meniscus
