#pragma once

namespace meniscus {

/// Ignores SIGPIPE and SIGXFSZ: a closed pipe or an exceeded file size is then an error of the
/// write.
void ignore_write_signals();
/// Makes Ctrl-C, SIGTERM and SIGUSR1 ask the run to stop after the current step.
void watch_for_interrupts();
[[nodiscard]] bool is_interrupted();

}  // namespace meniscus
