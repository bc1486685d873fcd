// SPDX-License-Identifier: Apache-2.0
// What the verdict of a recording says about programs and events that were not there, and about the cost of tracing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tracing {

struct RecordedVerdict {
  // The cost for one process, as the verdict has estimated it.
  struct ProcessCost {
    std::string name;
    std::int64_t vpid = 0;
    std::uint64_t events = 0;
    double seconds = 0;                          // that tracing took of its threads
    double processor_share = 0;                  // of one processor, while it ran
    std::optional<double> ns_per_callback = {};  // that tracing adds to a callback and what leads to it
  };
  std::vector<std::string> absences = {};   // sentences
  std::optional<double> ns_per_event = {};  // measured on the machine of the recording; the largest of several
  std::vector<ProcessCost> processes = {};  // from the one with the greatest cost
};

// What all files verdict.json in the directories and below them say. A file that cannot be read says nothing.
RecordedVerdict read_verdicts(const std::vector<std::filesystem::path>& directories);

}  // namespace tracing
