// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/lttng/installed_program.hpp"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <system_error>

#include "base/environment/own_environment.hpp"
#include "base/environment/own_prefix.hpp"
#include "base/files/pipe.hpp"
#include "base/processes/spawn.hpp"
#include "tracing/record/lttng/session_daemon.hpp"

namespace tracing {
namespace {

namespace fs = std::filesystem;

// LTTng-UST waits three times so long for a session daemon that has been stopped, and with the user's own timeout maybe
// for ever.
constexpr const char* kRegisterTimeout = "1000";  // ms
constexpr std::chrono::seconds kLongestRun{5};

bool succeeded(int status) {
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

std::optional<fs::path> installed_program(const std::string& name) {
  const fs::path program = launch::own_library_file(name);
  std::error_code ignored;
  return fs::exists(program, ignored) ? std::optional(program) : std::nullopt;
}

bool run_program(const fs::path& program) {
  try {
    return succeeded(launch::wait_for(launch::spawn({
        .program = program.string(),
        .argv = {program.string()},
        .descriptors = {{STDIN_FILENO, launch::kDevNull},
                        {STDOUT_FILENO, launch::kDevNull},
                        {STDERR_FILENO, launch::kDevNull}},
    })));
  } catch (const std::system_error&) {
    return false;
  }
}

void run_traced(const fs::path& program) {
  if (!session_daemon_can_answer()) {
    return;
  }
  launch::Environment environment = launch::own_environment();
  environment.insert_or_assign("LTTNG_UST_REGISTER_TIMEOUT", kRegisterTimeout);
  try {
    const pid_t pid = launch::spawn({
        .program = program.string(),
        .argv = {program.string()},
        .environment = &environment.variables(),
        .descriptors = {{STDIN_FILENO, launch::kDevNull},
                        {STDOUT_FILENO, launch::kDevNull},
                        {STDERR_FILENO, launch::kDevNull}},
        .group = launch::ChildGroup::kOwn,
    });
    if (!launch::ends_within(pid, kLongestRun)) {
      kill(pid, SIGKILL);
    }
    launch::wait_for(pid);
  } catch (const std::system_error&) {
    // It is not needed.
  }
}

std::string program_output(const fs::path& program, const std::vector<std::string>& arguments) {
  std::vector<std::string> argv = {program.string()};
  argv.insert(argv.end(), arguments.begin(), arguments.end());
  try {
    launch::Pipe pipe = launch::make_pipe();
    const pid_t pid = launch::spawn({
        .program = program.string(),
        .argv = std::move(argv),
        .descriptors = {{STDOUT_FILENO, pipe.write.get()}, {STDERR_FILENO, launch::kDevNull}},
        .group = launch::ChildGroup::kOwn,
    });
    pipe.write.reset();
    std::string output = launch::read_to_end(pipe.read);
    while (output.ends_with('\n')) {
      output.pop_back();
    }
    return succeeded(launch::wait_for(pid)) ? output : std::string();
  } catch (const std::system_error&) {
    return {};
  }
}

}  // namespace tracing
