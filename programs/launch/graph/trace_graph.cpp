// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <poll.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>
#include <vector>

#include "base/diagnostics/command_error.hpp"
#include "base/environment/own_prefix.hpp"
#include "base/processes/spawn.hpp"
#include "programs/command_line/result_output.hpp"
#include "programs/launch/graph/graph.hpp"

namespace launch {

namespace {

// Runs `launch trace VERB …`; what it prints goes to standard error.
int run_trace_verb(std::vector<std::string> words) {
  words.insert(words.begin(), {"launch", "trace"});
  const int status = wait_for(
      spawn({.program = own_prefix() + "/bin/launch", .argv = words, .descriptors = {{STDOUT_FILENO, STDERR_FILENO}}}));
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

// A directory for the time of the command.
class TemporaryDirectory {
 public:
  TemporaryDirectory() : path_((std::filesystem::temp_directory_path() / "launch-graph-XXXXXX").string()) {
    if (::mkdtemp(path_.data()) == nullptr) {
      throw std::system_error(errno, std::generic_category(), "can't make a temporary directory");
    }
  }
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  ~TemporaryDirectory() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

// `launch report` draws into a file and prints its path.
int report(const TraceToDraw& trace, const std::string& directory) {
  const TemporaryDirectory temporary;
  const std::string output = trace.output.empty() ? temporary.path() + "/graph" : trace.output;
  const int status = wait_for(spawn({.program = own_library_file("launch-report"),
                                     .argv = {"launch graph", directory, trace.as_picture ? "--svg" : "--dot", output},
                                     .descriptors = {{STDOUT_FILENO, kDevNull}}}));
  const int exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 1;
  if (!trace.output.empty() || !std::filesystem::exists(output)) {
    return exit_code;
  }
  ResultOutput result("launch graph");
  result.print(std::string(std::istreambuf_iterator<char>(std::ifstream(output).rdbuf()), {}));
  return result.finish() ? exit_code : 1;
}

int draw_live(const TraceToDraw& trace) {
  const TemporaryDirectory temporary;
  const std::string session = std::filesystem::path(temporary.path()).filename().string();
  if (const int exit_code = run_trace_verb({"start", session, "--path", temporary.path()}); exit_code != 0) {
    return exit_code;
  }
  // A signal ends the wait, and the graph shows what was recorded until then.
  ::poll(nullptr, 0, static_cast<int>(trace.seconds * 1000));
  if (const int exit_code = run_trace_verb({"stop", session}); exit_code != 0) {
    return exit_code;
  }
  return report(trace, temporary.path());
}

}  // namespace

int draw_trace(const TraceToDraw& trace) {
  try {
    return trace.directory.empty() ? draw_live(trace) : report(trace, trace.directory);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}", command_error("launch graph", error.what()));
    return 1;
  }
}

}  // namespace launch
