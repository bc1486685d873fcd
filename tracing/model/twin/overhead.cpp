// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/twin/overhead.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <vector>

namespace tracing::twin {

namespace {

constexpr std::int64_t kMost = 10'000;  // more is the machine, not the stand-in

// Of the quick runs: what makes others long is the machine, and it is never twice the same.
std::int64_t quick(std::vector<std::int64_t> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 10];
}

std::int64_t middle(std::vector<std::int64_t> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

std::size_t sendings(const Callback& callback) {
  std::size_t count = 0;
  for (const Output& output : callback.outputs) {
    count += output.times;
  }
  return count;
}

}  // namespace

void add_overheads(const Figures& recorded, const Figures& run, System& system) {
  // Callbacks that send alike have one overhead in common: of a single one, the state of the machine tells more than
  // the stand-in.
  std::map<std::size_t, std::vector<std::int64_t>> differences;
  for (const Callback& callback : system.callbacks) {
    const FigureKey key{FigureKind::kCallback, callback.name};
    const auto before = recorded.find(key);
    const auto after = run.find(key);
    if (before == recorded.end() || after == run.end() || before->second.size() < kEnoughRuns ||
        after->second.size() < kEnoughRuns) {
      continue;
    }
    differences[sendings(callback)].push_back(quick(after->second) - quick(before->second));
  }
  for (Callback& callback : system.callbacks) {
    if (const auto found = differences.find(sendings(callback)); found != differences.end()) {
      callback.overhead_ns = std::clamp<std::int64_t>(callback.overhead_ns + middle(found->second), 0, kMost);
    }
  }
}

}  // namespace tracing::twin
