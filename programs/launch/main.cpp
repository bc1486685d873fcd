// SPDX-License-Identifier: Apache-2.0
// launch: runs launch files; `launch trace` and `launch report` record and describe traces.
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "actions/builtin_actions.hpp"
#include "base/diagnostics/command_error.hpp"
#include "base/environment/own_environment.hpp"
#include "base/environment/own_prefix.hpp"
#include "programs/launch/check/check_command.hpp"
#include "programs/launch/check/explain_command.hpp"
#include "programs/launch/command_line.hpp"
#include "programs/launch/completion.hpp"
#include "programs/launch/describe/reference.hpp"
#include "programs/launch/describe/schema_command.hpp"
#include "programs/launch/further_commands.hpp"
#include "programs/launch/graph/graph_command.hpp"
#include "programs/launch/result_output.hpp"
#include "programs/launch/run/run_command.hpp"
#include "programs/launch/run/run_program.hpp"
#include "programs/launch/steer/control_command.hpp"
#include "programs/launch/subcommand.hpp"
#include "programs/launch/top/launch_in_top.hpp"
#include "programs/launch/trace/trace_command.hpp"
#include "programs/launch/trace/trace_completion.hpp"

namespace {

// Becomes another program, called `name`, with the arguments behind `last`. The launcher links no libraries for reading
// traces and no middleware, so other programs do what needs them.
int become(const char* program_name, const char* name, char** last) {
  const std::string program = launch::own_library_file(program_name);
  *last = const_cast<char*>(name);
  ::execv(program.c_str(), last);
  fmt::print(stderr, "{}", launch::command_error(name, fmt::format("can't run {}: {}", program, std::strerror(errno))));
  return 1;
}

// A program that was started without standard descriptors (`launch … >&-`) would take their numbers for files and pipes
// of its own.
void open_standard_descriptors() {
  for (int fd = ::open("/dev/null", O_RDWR); fd >= 0; fd = ::open("/dev/null", O_RDWR)) {
    if (fd > STDERR_FILENO) {
      ::close(fd);
      break;
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  open_standard_descriptors();
  const std::string_view command = argc > 1 ? argv[1] : "";
  if (command == "report") {
    return become("launch-report", "launch report", argv + 1);
  }
  if (command == "build") {
    return become("launch-build", "launch build", argv + 1);
  }
  if (command == "test") {
    return become("launch-test", "launch test", argv + 1);
  }
  if (launch::is_ros_command(command) ||
      (command == "complete" && argc > 3 && launch::is_ros_command(std::string_view(argv[2])))) {
    return become("launch-ros-command", "launch", argv);
  }
  if (command == "trace" && argc > 2 && std::string_view(argv[2]) == "read") {
    return become("launch-trace-read", "launch trace read", argv + 2);
  }
  if (command == "trace") {
    return tracing::run_trace_command({argv + 2, argv + argc});
  }
  if (command == "check") {
    return launch::check_command({argv + 2, argv + argc}, launch::builtin_actions(), launch::own_environment());
  }
  if (command == "explain") {
    return launch::explain_command({argv + 2, argv + argc});
  }
  if (command == "graph") {
    return launch::graph_command({argv + 2, argv + argc}, launch::builtin_actions(), launch::own_environment());
  }
  if (command == "complete") {
    launch::ResultOutput result("launch complete");
    for (const std::string& word : launch::completions({argv + 2, argv + argc}, launch::builtin_actions(),
                                                       launch::own_environment(), tracing::trace_completions)) {
      result.print(word + "\n");
    }
    return result.finish() ? 0 : 1;
  }
  if (command == "schema") {
    return launch::schema_command({argv + 2, argv + argc}, launch::builtin_actions());
  }
  if (command == "reference") {
    launch::Subcommand reference("launch reference", "Prints the reference of the launch language as Markdown.");
    if (const auto exit_code = reference.parse({argv + 2, argv + argc})) {
      return *exit_code;
    }
    launch::ResultOutput result("launch reference");
    result.print(launch::reference_page(launch::builtin_actions()));
    return result.finish() ? 0 : 1;
  }
  if (command == "run") {
    return launch::run_program_command({argv + 2, argv + argc}, launch::own_environment());
  }
  if (launch::is_control_command(command)) {
    return launch::control_command(argv[1], {argv + 2, argv + argc}, launch::own_environment());
  }
  const auto parsed = launch::parse_command_line(argc, argv);
  if (const auto* const exit_now = std::get_if<launch::ExitNow>(&parsed)) {
    return exit_now->code;
  }
  if (std::get<launch::CommandLine>(parsed).top) {
    std::vector<std::string> words(argv + 1, argv + argc);
    std::erase(words, "--top");
    return launch::launch_in_top(std::move(words), launch::own_environment());
  }
  return launch::run_command(std::get<launch::CommandLine>(parsed), launch::own_environment());
}
