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

// Of fewer runs, the median and the p99 are those of single runs.
inline constexpr std::size_t kEnoughRuns = 10;

// When the system is up: each callback with enough runs has run once, without those that begin in the second half of
// the recording. Before that time processes find each other, which they do once. If one of these callbacks had too
// few runs left, it is the time of the first run of all.
std::int64_t begin_of_figures(const timeline::Timeline& timeline);

// Of what the twin has, from the time on when the system is up.
Figures figures_of(const Recording& recording, const System& twin);

// What a table shows of the values of one figure.
struct FigureSummary {
  std::uint64_t count = 0;
  std::int64_t median_ns = 0;
  std::int64_t p99_ns = 0;
};
FigureSummary summary_of(const std::vector<std::int64_t>& values);

}  // namespace tracing::twin
