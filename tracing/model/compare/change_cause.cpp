// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/compare/change_cause.hpp"

#include <fmt/format.h>

#include <numeric>
#include <optional>

namespace tracing::compare {

namespace {

// Of the callback's samples in all runs.
std::optional<double> mean_of(const Runs& side, const std::string& callback, const char* quantity) {
  double sum = 0;
  double count = 0;
  for (const RunSummary& run : side.runs) {
    for (const Measurement& one : run.measurements) {
      if (one.kind == Kind::kCallback && one.subject == callback && one.quantity == quantity) {
        sum = std::accumulate(one.samples.begin(), one.samples.end(), sum);
        count += static_cast<double>(one.samples.size());
      }
    }
  }
  return count == 0 ? std::nullopt : std::optional(sum / count);
}

}  // namespace

std::string cause_of(const std::string& callback, bool slower, const Runs& before, const Runs& after) {
  const auto change = [&](const char* part) -> std::optional<double> {
    const std::optional<double> earlier = mean_of(before, callback, part);
    const std::optional<double> later = mean_of(after, callback, part);
    return earlier && later ? std::optional((*later - *earlier) * (slower ? 1 : -1)) : std::nullopt;
  };
  const std::optional<double> running = change(kRunning);
  const std::optional<double> waiting = change(kWaiting);
  const std::optional<double> blocked = change(kBlocked);
  const double all = running.value_or(0) + waiting.value_or(0) + blocked.value_or(0);
  if (!running || !waiting || !blocked || all <= 0) {
    return "";
  }
  const char* const direction = slower ? "more" : "less";
  if (*running >= all / 2) {
    return fmt::format("{} running time", direction);
  }
  const char* const same = *running <= all / 10 ? ", same running time" : "";
  if (*waiting >= all / 2) {
    return fmt::format("{} waiting for a processor{}", direction, same);
  }
  return *blocked >= all / 2 ? fmt::format("{} sleeping or waiting for something else{}", direction, same) : "";
}

}  // namespace tracing::compare
