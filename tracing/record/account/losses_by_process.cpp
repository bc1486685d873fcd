// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/account/losses_by_process.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "base/monotonic_clock.hpp"
#include "tracing/record/account/absence.hpp"
#include "tracing/record/account/counters/launch_processes.hpp"
#include "tracing/record/account/counters/session_pauses.hpp"
#include "tracing/record/account/event_cuts.hpp"
#include "tracing/record/account/loss_account.hpp"
#include "tracing/record/account/loss_attribution.hpp"
#include "tracing/record/account/recorded_events.hpp"
#include "tracing/record/account/stream_packets.hpp"
#include "tracing/record/lttng/installed_program.hpp"
#include "tracing/record/plan/trace_config.hpp"
#include "tracing/record/plan/trace_error.hpp"

namespace tracing {
namespace {

// For a session whose programs were not started by a launch: a tenth of a second.
constexpr std::uint64_t kLargestReadWithoutCounts = 100'000'000;  // bytes

}  // namespace

LossesByProcess::LossesByProcess(const TraceConfig& config, LossAccount& losses)
    : losses_(losses), counters_(config.event_counters) {
  if (!config.event_counters.empty()) {
    counts_ = EventCounters(config.event_counters).read();
  }
  forgive_pauses(counts_, config.event_counters, config.lttng_session_name());
  paused_ = was_paused(config.event_counters, config.lttng_session_name());
  losses.cuts = read_cuts(config);
  try {
    events_ = read_recorded_events(config.lttng_session_name());
  } catch (const TraceError&) {
    unknown_ = true;
  }
  losses.nothing_to_record = config.nothing_to_record;
  losses.launch_processes = read_launch_processes(counters_, counts_);
  losses.absences = absent_processes(counts_);
  losses.processes = account_processes(counts_, events_, static_cast<std::uint64_t>(launch::monotonic_time()));
}

void LossesByProcess::look_for_absent_events(const std::string& recording) {
  const std::optional<std::set<std::string>> declared = declared_events(recording);
  if (unknown_ || !declared) {
    return;
  }
  for (Absence& absence : absent_events(events_, *declared, losses_.nothing_to_record)) {
    losses_.absences.push_back(std::move(absence));
  }
}

void LossesByProcess::look_into(const std::string& recording, const std::vector<Stream>& streams) {
  const bool lost = needed();
  const bool whole = !losses_.cut_short && losses_.damage.empty() && !lost;
  if (whole) {
    losses_.attribution = LossAttribution::kExact;
  }
  const bool uncounted = has_uncounted();
  if ((lost || uncounted) && !unknown_) {
    try {
      RecordedProcesses recorded;
      if (const std::optional<std::filesystem::path> report = installed_program("launch-report")) {
        const std::string output = program_output(*report, {"--recorded", recording});
        if (!output.empty()) {
          recorded = parse_recorded_processes(output);
        }
      }
      if (lost) {
        attribute(recorded, streams);
      }
      if (uncounted) {
        add_uncounted_events(losses_.processes, recorded);
      }
    } catch (const TraceError&) {
      if (lost) {
        losses_.attribution = LossAttribution::kUnknown;
      }
    }
  }
  if (!whole) {
    return;
  }
  for (ProcessAccount& process : losses_.processes) {
    process.lost = 0;
  }
}

void LossesByProcess::attribute(const RecordedProcesses& recorded, const std::vector<Stream>& streams) {
  if (recorded.empty()) {
    counts_.clear();  // then only buffers of its own tell what a process lost
  }
  count_overwritten(losses_, counts_, events_, recorded);
  const bool own_buffers =
      std::any_of(streams.begin(), streams.end(), [](const Stream& stream) { return stream.pid.has_value(); });
  // What is not in the trace was overwritten or lost: counters can't tell which.
  if (overwrites() && !own_buffers) {
    return;
  }
  attribute_losses(losses_, counts_, events_, recorded, streams);
}

bool LossesByProcess::has_uncounted() const {
  if (losses_.cut_short) {
    return false;
  }
  std::uint64_t bytes = 0;
  for (const ChannelLoss& channel : losses_.channels) {
    bytes += channel.bytes;
  }
  if (counts_.empty()) {
    return bytes != 0 && bytes <= kLargestReadWithoutCounts;
  }
  return std::any_of(events_.rules.begin(), events_.rules.end(), [](const RecordedEvents::Rule& rule) {
    return !is_counted(rule.pattern) && !is_our_own(rule.pattern);
  });
}

bool LossesByProcess::needed() const {
  return !losses_.cut_short &&
         std::any_of(losses_.channels.begin(), losses_.channels.end(), [](const ChannelLoss& channel) {
           return channel.domain == "ust" &&
                  (channel.discarded_events + channel.lost_packets != 0 || !channel.before_first.nothing());
         });
}

bool LossesByProcess::overwrites() const {
  return std::any_of(losses_.channels.begin(), losses_.channels.end(), [](const ChannelLoss& channel) {
    return channel.domain == "ust" && channel.before_first.why == BeforeFirstPacket::kOverwrittenInFiles &&
           channel.before_first.packets != 0;
  });
}

}  // namespace tracing
