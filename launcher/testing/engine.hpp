// SPDX-License-Identifier: Apache-2.0
// Hands tests to a command, such as `srun` of Slurm or `ssh HOST`, and gets their results back.
//
// The command gets `…/bin/launch test --task WORD` behind its own words. WORD holds letters and digits alone, so no
// shell on the way changes it. There, the test runs as here, and its result is the last line of the standard output.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "launcher/testing/test_files.hpp"
#include "launcher/testing/test_result.hpp"

namespace launch {

struct EngineTask {
  std::string file;
  std::string name;
  std::size_t number = 0;  // among the tests of the file
  LaunchArguments arguments;
  std::string directory;  // on a file system that both see, or of the other machine
  std::uint64_t seed = 1;
  std::optional<std::set<std::size_t>> faults = {};  // as in TestCase
};

// Starts the command in a process group of its own and returns its number. Its output is in DIRECTORY/engine.txt.
// Throws SpawnError.
pid_t start_in_engine(const std::vector<std::string>& engine, const EngineTask& task);
// What the command has printed; nullopt: no result.
std::optional<TestResult> result_of_engine(const std::string& directory);

// The task that WORD holds. Throws std::exception.
EngineTask task_of(const std::string& word);

}  // namespace launch
