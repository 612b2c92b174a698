#include "meniscus/app/interrupt.hpp"

#include <csignal>
#include <initializer_list>

namespace meniscus {
namespace {

volatile std::sig_atomic_t interrupted = 0;

extern "C" void note_interrupt(int) { interrupted = 1; }

}  // namespace

void ignore_write_signals() {
  for (const int signal : {SIGXFSZ, SIGPIPE}) std::signal(signal, SIG_IGN);
}

void watch_for_interrupts() {
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1}) std::signal(signal, note_interrupt);
}

bool is_interrupted() { return interrupted != 0; }

}  // namespace meniscus
