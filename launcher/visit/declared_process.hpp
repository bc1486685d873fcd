// SPDX-License-Identifier: Apache-2.0
// What one reading of a launch file says of a process, small enough to be kept: two readings are compared by it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics/source.hpp"
#include "launcher/substitution/parameter.hpp"
#include "launcher/visit/requests.hpp"

namespace launch {

struct DeclaredProcess {
  // What a process gets at its start, in groups. A change of one of them needs another start.
  enum Group : std::size_t {
    kCommandLine,
    kParameterFiles,  // without those of `parameters`
    kEnvironment,
    kDirectory,
    kInputAndOutput,
    kLimits,
    kWatches,
    kCrashDirectory,
    kTrace,
    kGroups
  };

  std::string name;                 // the label without its number, and the full name of the node if it has one
  std::string node;                 // its full name; empty: it is no node, or the launch file does not name it
  std::uint64_t command_words = 0;  // the command line with its parameters
  std::array<std::uint64_t, kGroups> groups{};  // of each a number that stands for its values
  std::uint64_t policy = 0;                     // respawn, timeouts and the like: they hold without another start
  std::uint64_t dependencies = 0;               // what it waits for before its start
  std::vector<NamedParameter> parameters;       // that the launch file gives by name; the last one of a name holds
  SourceRange where;

  // Whether the other one starts a process that is the same in all groups.
  bool starts_as(const DeclaredProcess& other) const;
};

// "command line", "environment", …
const char* name_of(DeclaredProcess::Group group);

// In the order of the processes. Reads the parameter files that command lines name.
std::vector<DeclaredProcess> declared_processes(const Requests& requests);

// Which processes of two readings are the same: the index in `before` of each one of `now`, or nothing. Only processes
// of one name can be the same. Among several of a name, those that are equal belong together first, then those of the
// same line, then the others in their order.
std::vector<std::optional<std::size_t>> find_same(const std::vector<DeclaredProcess>& before,
                                                  const std::vector<DeclaredProcess>& now);

// The parameters that `now` gives a value that they have not had. Nothing if one of `before` is gone: no node could
// forget it.
std::optional<std::vector<NamedParameter>> changed_parameters(const DeclaredProcess& before,
                                                              const DeclaredProcess& now);
// "rate: 10 -> 20", "frame: new, "map"", "debug: gone"
std::vector<std::string> parameter_changes(const DeclaredProcess& before, const DeclaredProcess& now);

}  // namespace launch
