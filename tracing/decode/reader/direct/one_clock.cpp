// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/reader/direct/one_clock.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

namespace tracing {
namespace {

constexpr std::int64_t kMeasurementsDiffer = 10'000'000;  // ns, on a busy machine

}  // namespace

std::vector<std::string> put_on_one_clock(const std::vector<ClockOfTrace>& traces) {
  // Of one boot of a machine, and one session there.
  std::map<std::pair<std::string, std::string>, std::vector<const ClockOfTrace*>> sessions;
  for (const ClockOfTrace& trace : traces) {
    const std::map<std::string, ctf::Clock>& clocks = trace.declarations.clocks;
    if (clocks.size() == 1 && !trace.recording.machine.empty() && !trace.recording.session.empty()) {
      sessions[{trace.recording.machine, trace.recording.session}].push_back(&trace);
    }
  }
  std::vector<std::string> notes;
  for (const auto& [identity, of_session] : sessions) {
    const auto clock = [](const ClockOfTrace* trace) -> ctf::Clock& {
      return trace->declarations.clocks.begin()->second;
    };
    const auto [least, most] = std::minmax_element(
        of_session.begin(), of_session.end(),
        [&clock](const auto* a, const auto* b) { return clock(a).nanoseconds(0) < clock(b).nanoseconds(0); });
    const ctf::Clock latest = clock(*most);
    const std::int64_t set_by = latest.nanoseconds(0) - clock(*least).nanoseconds(0);
    if (set_by <= kMeasurementsDiffer) {
      continue;  // the times are those that babeltrace2 shows
    }
    std::size_t moved = 0;
    for (const ClockOfTrace* trace : of_session) {
      ctf::Clock& its = clock(trace);
      if (its.frequency != latest.frequency) {
        continue;
      }
      moved += latest.nanoseconds(0) - its.nanoseconds(0) > kMeasurementsDiffer ? 1 : 0;
      its.offset_s = latest.offset_s;
      its.offset = latest.offset;
    }
    if (moved > 0) {
      const std::string& host = of_session.front()->recording.host;
      notes.push_back(
          fmt::format("the wall clock of {} was set while it was recorded, by {:.3f} s: the times of {} of {} traces "
                      "were moved, so "
                      "that all are on one clock",
                      host.empty() ? "a machine" : host, static_cast<double>(set_by) / 1e9, moved, of_session.size()));
    }
  }
  return notes;
}

}  // namespace tracing
