// SPDX-License-Identifier: Apache-2.0
// The processes of a launch, known by the mark in their environment (base/processes/process_mark.hpp).
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "base/files/unique_fd.hpp"
#include "tracing/show/live/live_conditions.hpp"

namespace launch {

class ProcessesOfLaunch : public tracing::LaunchedProcesses {
 public:
  // `launch`: the number of the launch in the marks.
  explicit ProcessesOfLaunch(std::string launch) : launch_(std::move(launch)) {}

  // Looks once at each process, when it is asked for first: its environment is gone as soon as it has ended.
  std::optional<std::string> label(std::int64_t vpid) override;
  bool lives(std::int64_t vpid) override;

 private:
  struct Process {
    std::optional<std::string> label;
    UniqueFd pidfd;
  };
  Process& find(std::int64_t vpid);

  std::string launch_;
  std::map<std::int64_t, Process> processes_;
};

}  // namespace launch
