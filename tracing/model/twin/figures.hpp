// SPDX-License-Identifier: Apache-2.0
// What is compared between a recorded system and its twin: the times of callbacks, of the ways of messages, and of
// calls of services.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "tracing/model/twin/description/twin_system.hpp"
#include "tracing/model/twin/recording.hpp"

namespace tracing::twin {

enum class FigureKind {
  kCallback,  // its duration
  kHop,       // from the publication to the begin of the callback
  kCall,      // from a request to its response
};

struct FigureKey {
  FigureKind kind = FigureKind::kCallback;
  std::string name;  // "/planner, timer 100 ms", "/scan to /planner, subscription /scan"
  bool operator==(const FigureKey&) const = default;
  bool operator<(const FigureKey& other) const { return std::tie(kind, name) < std::tie(other.kind, other.name); }
};

using Figures = std::map<FigureKey, std::vector<std::int64_t>>;

std::string hop_name(const std::string& publisher, const std::string& callback);
std::string call_name(const std::string& client, const std::string& service);

// Of what the twin has.
Figures figures_of(const Recording& recording, const System& twin);

// What a table shows of the values of one figure.
struct FigureSummary {
  std::uint64_t count = 0;
  std::int64_t median_ns = 0;
  std::int64_t p99_ns = 0;
};
FigureSummary summary_of(const std::vector<std::int64_t>& values);

}  // namespace tracing::twin
