#include "meniscus/app/command_line.hpp"

int main(int argc, char** argv) { return meniscus::run_command_line(argc, argv); }
