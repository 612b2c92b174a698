#include "meniscus/app/interrupt.hpp"

#include <csignal>
#include <initializer_list>

namespace meniscus {
namespace {

volatile std::sig_atomic_t interrupted = 0;

extern "C" void note_interrupt(int) { interrupted = 1; }

}  // namespace

void watch_for_interrupts() {
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1}) std::signal(signal, note_interrupt);
  // A file that would pass RLIMIT_FSIZE is an ordinary write error, like a full disk.
  std::signal(SIGXFSZ, SIG_IGN);
}

bool is_interrupted() { return interrupted != 0; }

}  // namespace meniscus
