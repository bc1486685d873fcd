// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/twin/description/output_rules.hpp"

#include <algorithm>
#include <numeric>

namespace tracing::twin {

OutputRules::OutputRules(const System& system) : system_(system), random_(system.seed) {
  states_.reserve(system.callbacks.size());
  for (Index index = 0; index < system.callbacks.size(); ++index) {
    const Callback& callback = system.callbacks[index];
    const std::uint64_t seed = system.seed * 2'654'435'761u + 2 * index;
    State state{std::vector<std::uint64_t>(callback.outputs.size()),
                {},
                {},
                {},
                Draw(callback.run_times, seed, system.cycle()),
                Draw(callback.silent_run_times, seed + 1, system.cycle())};
    state.by_sent.resize(callback.outputs.size());
    std::iota(state.by_sent.begin(), state.by_sent.end(), std::size_t{0});
    std::stable_sort(state.by_sent.begin(), state.by_sent.end(), [&](std::size_t left, std::size_t right) {
      return callback.outputs[left].sent < callback.outputs[right].sent;
    });
    for (const Output& output : callback.outputs) {
      Index join = kNone;
      if (output.rule == Output::Rule::kJoin) {
        const auto found = std::find_if(joins_.begin(), joins_.end(), [&](const Join& known) {
          return known.publisher == output.publisher && known.inputs == output.inputs;
        });
        join = static_cast<Index>(found - joins_.begin());
        if (found == joins_.end()) {
          joins_.push_back({output.publisher, output.inputs, std::vector<bool>(output.inputs.size())});
        }
      }
      state.join_of.push_back(join);
    }
    states_.push_back(std::move(state));
  }
  for (std::size_t join = 0; join < joins_.size(); ++join) {
    for (const Index input : joins_[join].inputs) {
      states_[input].joins.push_back(join);
    }
  }
}

std::vector<std::size_t> OutputRules::complete(Index callback) {
  std::vector<std::size_t> completed;
  for (const std::size_t index : states_[callback].joins) {
    Join& join = joins_[index];
    for (std::size_t input = 0; input < join.inputs.size(); ++input) {
      if (join.inputs[input] == callback) {
        join.seen[input] = true;
      }
    }
    if (std::all_of(join.seen.begin(), join.seen.end(), [](bool seen) { return seen; })) {
      join.seen.assign(join.seen.size(), false);
      completed.push_back(index);
    }
  }
  return completed;
}

Run OutputRules::next_run(Index callback, std::optional<std::int64_t> time_ns) {
  State& state = states_[callback];
  const std::vector<Output>& outputs = system_.callbacks[callback].outputs;
  const std::vector<std::size_t> completed = complete(callback);
  Run run;
  for (const std::size_t index : state.by_sent) {
    const Output& output = outputs[index];
    bool sends = true;
    switch (output.rule) {
      case Output::Rule::kAlways:
        break;
      case Output::Rule::kEvery:
        sends = ++state.runs[index] % output.every == 0;
        break;
      case Output::Rule::kJoin:
        sends = std::find(completed.begin(), completed.end(), state.join_of[index]) != completed.end();
        break;
      case Output::Rule::kChance:
        sends = static_cast<double>(random_() >> 11) * 0x1p-53 < output.chance;
        break;
    }
    if (sends) {
      run.outputs.push_back(index);
    }
  }
  run.is_silent = run.outputs.empty() && !system_.callbacks[callback].silent_run_times.empty();
  Draw& times = run.is_silent ? state.silent_run_times : state.run_times;
  if (time_ns) {
    const Draw::Drawn drawn = times.next_at(*time_ns);
    run.time_ns = drawn.value;
    run.place = drawn.place;
  } else {
    run.time_ns = times.next();
  }
  return run;
}

}  // namespace tracing::twin
