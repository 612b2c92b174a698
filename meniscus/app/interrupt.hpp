#pragma once

namespace meniscus {

/// From here on Ctrl-C, SIGTERM and SIGUSR1 ask the run to stop after its step.
void watch_for_interrupts();
[[nodiscard]] bool is_interrupted();

}  // namespace meniscus
