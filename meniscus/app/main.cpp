#include "meniscus/app/command_line.hpp"
#include "meniscus/core/memory.hpp"

int main(int argc, char** argv) {
  meniscus::keep_freed_memory();
  return meniscus::run_command_line(argc, argv);
}
