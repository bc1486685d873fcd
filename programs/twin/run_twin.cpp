// SPDX-License-Identifier: Apache-2.0
#include "programs/twin/run_twin.hpp"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <set>
#include <stdexcept>

#include "base/environment/own_prefix.hpp"
#include "base/processes/spawn.hpp"

namespace twin_program {

namespace {

std::set<std::filesystem::path> traces_in(const std::filesystem::path& folder) {
  std::set<std::filesystem::path> traces;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.is_directory() && entry.path().filename().string().starts_with("twin-")) {
      traces.insert(entry.path());
    }
  }
  return traces;
}

}  // namespace

std::filesystem::path run_twin(const std::filesystem::path& folder, double duration_s, RunOutput output) {
  const std::set<std::filesystem::path> before = traces_in(folder);
  // In a network of its own: the twin has the names of the system that it stands for.
  const std::string file = (folder / "twin.xml").string();
  std::vector<std::string> words = {"launch", "--isolate", file};
  if (duration_s > 0) {
    words.push_back(fmt::format("duration:={:.3f}", duration_s));
  }
  const int out = output == RunOutput::kShown ? STDERR_FILENO : launch::kDevNull;
  const int status = launch::wait_for(launch::spawn(
      {.program = launch::own_prefix() + "/bin/launch", .argv = words, .descriptors = {{STDOUT_FILENO, out}}}));
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    throw std::runtime_error(fmt::format("the twin did not run to its end: 'launch --isolate {}' failed", file));
  }
  for (const std::filesystem::path& trace : traces_in(folder)) {
    if (!before.contains(trace)) {
      return trace;
    }
  }
  throw std::runtime_error(fmt::format("the run of the twin made no trace in '{}'", folder.string()));
}

}  // namespace twin_program
