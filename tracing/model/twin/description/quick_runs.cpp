// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/twin/description/quick_runs.hpp"

#include <algorithm>
#include <map>
#include <numeric>

namespace tracing::twin {

namespace {

constexpr std::size_t kMostInputs = 64;

std::vector<std::int64_t> drawn(const Distribution& distribution, std::uint64_t seed) {
  constexpr std::size_t kRounds = 4;
  Draw draw(distribution, seed);
  std::vector<std::int64_t> values;
  for (std::size_t count = kRounds * distribution.values.size(); count > 0; --count) {
    values.push_back(draw.next());
  }
  return values;
}

bool all_have(const Callback& callback, Output::Rule rule) {
  return std::all_of(callback.outputs.begin(), callback.outputs.end(),
                     [&](const Output& output) { return output.rule == rule; });
}

}  // namespace

QuickRuns::QuickRuns(const System& system) : of_(system.callbacks.size()) {
  // Which inputs complete one another, and who is in several such sets.
  std::map<std::vector<Index>, bool> sets;  // whether all of their callbacks are simple
  std::vector<std::size_t> memberships(system.callbacks.size());
  for (const Callback& callback : system.callbacks) {
    for (const Output& output : callback.outputs) {
      if (output.rule == Output::Rule::kJoin && sets.try_emplace(output.inputs, true).second) {
        for (const Index input : output.inputs) {
          ++memberships[input];
        }
      }
    }
  }
  for (auto& [inputs, is_simple] : sets) {
    is_simple = inputs.size() <= kMostInputs;
    for (const Index input : inputs) {
      const Callback& callback = system.callbacks[input];
      is_simple = is_simple && memberships[input] == 1 &&
                  std::all_of(callback.outputs.begin(), callback.outputs.end(),
                              [&all = inputs](const Output& output) { return output.inputs == all; });
    }
  }
  joins_ = std::vector<Join>(sets.size());
  std::size_t place = 0;
  for (const auto& [inputs, is_simple] : sets) {
    Join& join = joins_[place++];
    for (std::size_t input = 0; is_simple && input < inputs.size(); ++input) {
      of_[inputs[input]].bit = std::uint64_t{1} << input;
      of_[inputs[input]].join = &join;
      of_[inputs[input]].is_known = true;
      join.all |= of_[inputs[input]].bit;
    }
  }
  for (Index index = 0; index < system.callbacks.size(); ++index) {
    const Callback& callback = system.callbacks[index];
    Of& of = of_[index];
    of.is_known = of.is_known || (memberships[index] == 0 && all_have(callback, Output::Rule::kAlways));
    if (!of.is_known) {
      continue;
    }
    of.times.values = drawn(callback.run_times, system.seed + 2 * index);
    of.silent.values = drawn(callback.silent_run_times, system.seed + 2 * index + 1);
    of.outputs.resize(callback.outputs.size());
    std::iota(of.outputs.begin(), of.outputs.end(), std::size_t{0});
    std::stable_sort(of.outputs.begin(), of.outputs.end(), [&](std::size_t left, std::size_t right) {
      return callback.outputs[left].sent < callback.outputs[right].sent;
    });
  }
}

QuickRuns::Run QuickRuns::next(Index callback) {
  Of& of = of_[callback];
  bool sends = !of.outputs.empty();
  if (of.join != nullptr) {
    const bool is_complete = (of.join->seen.fetch_or(of.bit) | of.bit) == of.join->all;
    if (is_complete) {
      of.join->seen = 0;
    }
    sends = sends && is_complete;
  }
  if (!sends) {
    return {of.silent.values.empty() ? of.times.next() : of.silent.next(), nullptr};
  }
  return {of.times.next(), &of.outputs};
}

}  // namespace tracing::twin
