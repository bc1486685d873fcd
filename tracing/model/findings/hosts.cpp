// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/findings/hosts.hpp"

#include <algorithm>

namespace tracing {

Hosts::Hosts(const TraceOverview& overview)
    : processes_(overview.processes),
      several_(std::any_of(processes_.begin(), processes_.end(),
                           [this](const ProcessResult& one) { return one.host != processes_.front().host; })) {}

std::string Hosts::before(const std::optional<ProcessIndex>& process) const {
  return several_ && process && *process < processes_.size() ? processes_[*process].host + ": " : "";
}

std::string Hosts::before(const ChainResult& chain) const {
  if (!several_) {
    return "";
  }
  std::string text;
  std::string last;
  for (const ChainResult::Step& step : chain.steps) {
    if (step.process >= processes_.size() || processes_[step.process].host == last) {
      continue;
    }
    last = processes_[step.process].host;
    text += (text.empty() ? "" : " -> ") + last;
  }
  return text.empty() ? "" : text + ": ";
}

}  // namespace tracing
