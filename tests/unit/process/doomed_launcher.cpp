// SPDX-License-Identifier: Apache-2.0
// doomed_launcher GUARDIAN GRACE_MILLISECONDS SCRIPT...: starts a guarded shell for each script, prints the pids of
// guardian and shells, and waits to be killed.
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "launcher/process/guardian/guardian.hpp"

int main(int argc, char** argv) {
  if (argc < 3) {
    return EXIT_FAILURE;
  }
  launch::Guardian guardian(argv[1], std::chrono::milliseconds(std::atol(argv[2])));
  const auto posix = launch::make_posix_process_runner();
  launch::GuardedProcessRunner runner(*posix, guardian);
  std::vector<launch::Process> processes;
  fmt::print("{}\n", guardian.pid());
  for (int i = 3; i < argc; ++i) {
    launch::ProcessSpec spec;
    spec.name = "shell";
    spec.argv = {"/bin/sh", "-c", argv[i]};
    spec.environment = {{"PATH", "/usr/bin:/bin"}};
    processes.push_back(runner.spawn(spec));
    // The script prints a line when it is ready.
    char byte = 0;
    while (::read(processes.back().out.get(), &byte, 1) != 1) {
    }
    fmt::print("{}\n", processes.back().pid);
  }
  std::fflush(stdout);
  ::pause();
}
