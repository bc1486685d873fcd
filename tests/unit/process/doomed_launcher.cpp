// SPDX-License-Identifier: Apache-2.0
// doomed_launcher GUARDIAN [--timeouts SIGTERM SIGKILL] [--log FILE] [--clean-up SCRIPT] [--forgotten SCRIPT]
//                 [--leave] [--exit CODE] [--end-by-sigterm] SCRIPT…
//
// Puts a guardian above itself, starts a shell for each script and waits for its first line. Prints the process numbers
// of guardian, launcher and shells. Then it waits to be killed. With --exit it exits with CODE at SIGUSR1, when the
// test has seen the shells run. The timeouts are milliseconds. A clean-up is forgotten when it is taken back. With
// --leave, what the shells leave goes on. With --end-by-sigterm it waits for SIGTERM and ends in order.
#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include "base/processes/process_mark.hpp"
#include "launcher/process/guardian/guardian.hpp"
#include "launcher/process/process_runner.hpp"

int main(int argc, char** argv) {
  if (argc < 2) {
    return EXIT_FAILURE;
  }
  launch::Guardian guardian = launch::Guardian::put_above({argv, argv + argc}, argv[1]);
  guardian.wait_until_ready();
  fmt::print("{}\n{}\n", guardian.pid(), ::getpid());
  launch::ProcessSpec spec;
  spec.name = "shell";
  spec.output = *launch::OutputRouting::from_mode("both");
  spec.environment = {{"PATH", "/usr/bin:/bin"}};
  std::optional<int> exit_code;
  bool ends_by_sigterm = false;
  sigset_t awaited;
  sigemptyset(&awaited);
  std::vector<std::string> scripts;
  for (int i = 2; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--timeouts") {
      spec.sigterm_timeout = std::chrono::milliseconds(std::atol(argv[++i]));
      spec.sigkill_timeout = std::chrono::milliseconds(std::atol(argv[++i]));
    } else if (word == "--log") {
      guardian.set_log(argv[++i]);
    } else if (word == "--clean-up") {
      guardian.add_clean_up({"/bin/sh", "-c", argv[++i]});
    } else if (word == "--forgotten") {
      guardian.remove_clean_up(guardian.add_clean_up({"/bin/sh", "-c", argv[++i]}));
    } else if (word == "--leave") {
      spec.environment.insert_or_assign(launch::kLeaveRunningVariable, "1");
    } else if (word == "--exit") {
      exit_code = std::atoi(argv[++i]);
      sigaddset(&awaited, SIGUSR1);
    } else if (word == "--end-by-sigterm") {
      ends_by_sigterm = true;
      sigaddset(&awaited, SIGTERM);
    } else {
      scripts.push_back(word);
    }
  }
  ::sigprocmask(SIG_BLOCK, &awaited, nullptr);
  const auto runner = launch::make_posix_process_runner();
  std::vector<launch::Process> processes;
  for (const std::string& script : scripts) {
    spec.argv = {"/bin/sh", "-c", script};
    spec.mark = guardian.mark(fmt::format("shell-{}", processes.size() + 1), spec);
    processes.push_back(runner->spawn(spec));
    guardian.note(processes.size(), processes.back().pid, fmt::format("shell-{}", processes.size()), spec);
    for (char byte = 0; byte != '\n';) {
      static_cast<void>(!::read(processes.back().out.get(), &byte, 1));
    }
    fmt::print("{}\n", processes.back().pid);
  }
  std::fflush(stdout);
  if (!exit_code && !ends_by_sigterm) {
    ::pause();
  }
  int signal = 0;
  ::sigwait(&awaited, &signal);
  return exit_code.value_or(EXIT_SUCCESS);
}
