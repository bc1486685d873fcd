// SPDX-License-Identifier: Apache-2.0
// Finds the tests that launch files hold. Nothing is started.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "launcher/language/launch_description.hpp"
#include "launcher/language/registry.hpp"
#include "launcher/substitution/scope.hpp"
#include "launcher/visit/test_request.hpp"

namespace launch {

using LaunchArguments = std::vector<std::pair<std::string, std::string>>;  // name, value

struct TestCase {
  std::string file;  // as it was given
  std::shared_ptr<const LaunchDescription> description;
  std::size_t number = 0;  // among the tests of the file, in the order of the visit
  std::string name;
  unsigned line = 0;
  SourceRange where;  // of the tag
  Duration timeout{0};
  bool traced = false;              // its run is recorded
  std::vector<std::string> events;  // that it names, beside those of ROS 2
  bool is_only = false;             // the only one of its file
  std::size_t fault_count = 0;
  std::vector<NetworkFault::Member> network = {};    // the processes that faults of the network name
  bool fills_disk = false;                           // it has faults of disks
  std::uint64_t seed = 1;                            // of its faults
  bool shows_seed = false;                           // the result names the seed
  bool seed_in_name = false;                         // it runs with several
  std::optional<std::set<std::size_t>> faults = {};  // the numbers of those that are applied; nullopt: all

  // With the seed, if there are several.
  std::string full_name() const { return seed_in_name ? name + " [seed " + std::to_string(seed) + "]" : name; }
};

// The launch files that the words mean: files, directories, which are searched for launch files with a test, or a
// package and a file of it. Throws LaunchError.
std::vector<std::string> find_test_files(const std::vector<std::string>& words, const Scope& scope);

// The tests of a launch file. Everything that is wrong with them is an error, also a process that they name and that
// the launch file does not start, unless it need not do that. Throws LaunchError.
enum class ProcessNames { kOfLaunchFile, kAny };
std::vector<TestCase> list_tests(const std::string& file, const Registry& registry, const Environment& environment,
                                 const LaunchArguments& arguments, ProcessNames names = ProcessNames::kOfLaunchFile);

// What the test asks for. Throws LaunchError.
TestRequest request_of(const TestCase& test, const Registry& registry, const Environment& environment,
                       const LaunchArguments& arguments);

// The test of this number, which list_tests() has found elsewhere. Its mistakes are not looked for again. Throws
// LaunchError, also if it has another name here.
TestCase find_test(const std::string& file, const Registry& registry, const Environment& environment,
                   const LaunchArguments& arguments, std::size_t number, const std::string& name);

// What faults of disks need before a run begins (launcher/run/system_test/test_disks.hpp).
struct DiskPlan {
  std::vector<DiskFault> faults;
  std::vector<std::string> traces;  // the directories of all traces
};
// With the environment and the log directory of the run. Throws LaunchError.
DiskPlan plan_disks(const TestCase& test, const Registry& registry, const Environment& environment,
                    const LaunchArguments& arguments, const std::string& log_directory);

}  // namespace launch
