// SPDX-License-Identifier: Apache-2.0
// launch-agent: `launch agent` on another machine (agent.hpp). It is a program of its own, so that nothing of the
// launch engine is loaded there.
#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <stdlib.h>
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "base/environment/own_environment.hpp"
#include "base/processes/process_mark.hpp"
#include "launcher/process/event_loop.hpp"
#include "launcher/process/guardian/guardian.hpp"
#include "launcher/process/process_runner.hpp"
#include "programs/agent/agent.hpp"
#include "programs/agent/agent_relay.hpp"

namespace {

using launch::UniqueFd;

constexpr int kOutOfTheWay = 10;

// The launcher's end of standard input and output. Children and guardians have standard error in their place, so that
// the launcher sees at once when this process has gone, and nothing else can write between its messages.
UniqueFd take_away(int fd, int replacement) {
  UniqueFd taken(::fcntl(fd, F_DUPFD_CLOEXEC, kOutOfTheWay));
  ::dup2(replacement, fd);
  return taken;
}

int run_agent() {
  const UniqueFd nothing(::open("/dev/null", O_RDWR | O_CLOEXEC));
  UniqueFd in = take_away(STDIN_FILENO, nothing.get());
  UniqueFd out = take_away(STDOUT_FILENO, STDERR_FILENO);
  std::optional<launch::Guardian> guardian(launch::Guardian::put_above({"launch", "agent"}));
  const std::string mark = guardian->mark("launch agent", {});
  ::setenv(launch::kMarkVariable, mark.c_str() + std::string_view(launch::kMarkVariable).size() + 1, 1);
  ::signal(SIGPIPE, SIG_IGN);
  for (const int signal : {SIGINT, SIGQUIT, SIGTERM, SIGHUP}) {
    ::signal(signal, SIG_DFL);
  }
  // Never destroyed: a thread may still wait for a command.
  auto* const loop = launch::make_sd_event_loop().release();
  const auto runner = launch::make_posix_process_runner();
  guardian->wait_until_ready();
  int code = 0;
  {
    launch::Agent agent(*loop, *runner, *guardian, std::move(in), std::move(out), LAUNCH_VERSION);
    code = agent.run();
    if (std::optional<launch::Agent::Return> back = agent.take_return()) {
      sigset_t none;
      ::sigemptyset(&none);
      ::sigprocmask(SIG_SETMASK, &none, nullptr);  // the loop, which takes signals, does not run any more
      code =
          launch::relay_to_agent(launch::own_environment(), back->request, std::move(back->in), std::move(back->out));
    }
  }
  guardian.reset();
  std::fflush(stderr);
  ::_exit(code);
}

}  // namespace

int main(int argc, char** argv) {
  const bool wants_help = argc > 1 && (std::string_view(argv[1]) == "--help" || std::string_view(argv[1]) == "-h");
  if (wants_help) {
    std::fputs(
        "Usage: launch agent\n\n"
        "Starts processes for a launch on another machine, which speaks with it through standard input and output.\n"
        "A launch starts it by the `connect` of a <machine> (docs/machines.md).\n",
        stdout);
    return EXIT_SUCCESS;
  }
  if (argc > 1 || ::isatty(STDIN_FILENO) == 1) {
    std::fputs("launch agent: error: it is started by a launch, through the connect of a <machine>, not by hand\n",
               stderr);
    return 2;
  }
  try {
    return run_agent();
  } catch (const std::exception& error) {
    fmt::print(stderr, "launch agent: error: {}\n", error.what());
    return EXIT_FAILURE;
  }
}
