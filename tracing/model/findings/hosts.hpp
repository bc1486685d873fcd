// SPDX-License-Identifier: Apache-2.0
// The machines of a trace, where results are shown.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tracing/model/analysis/results.hpp"

namespace tracing {

// A trace of one machine has no names of machines before its results.
class Hosts {
 public:
  // The overview must outlive this.
  explicit Hosts(const TraceOverview& overview);

  // "left: " before what a process on the machine of this name does.
  std::string before(const std::optional<ProcessIndex>& process) const;
  // "left -> right: " for a chain from one machine to another.
  std::string before(const ChainResult& chain) const;

 private:
  const std::vector<ProcessResult>& processes_;
  bool several_ = false;
};

}  // namespace tracing
