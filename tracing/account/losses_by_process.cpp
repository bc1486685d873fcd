// SPDX-License-Identifier: Apache-2.0
#include "tracing/account/losses_by_process.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "launcher/base/monotonic_clock.hpp"
#include "tracing/account/event_cuts.hpp"
#include "tracing/account/loss_account.hpp"
#include "tracing/account/loss_attribution.hpp"
#include "tracing/account/recorded_events.hpp"
#include "tracing/account/stream_packets.hpp"
#include "tracing/lttng/installed_program.hpp"
#include "tracing/plan/trace_config.hpp"
#include "tracing/plan/trace_error.hpp"

namespace tracing {

LossesByProcess::LossesByProcess(const TraceConfig& config, LossAccount& losses) : losses_(losses) {
  if (!config.event_counters.empty()) counts_ = EventCounters(config.event_counters).read();
  losses.cuts = read_cuts(config);
  try {
    events_ = read_recorded_events(config.lttng_session_name());
  } catch (const TraceError&) {
    unknown_ = true;
  }
  losses.processes = account_processes(counts_, events_, static_cast<std::uint64_t>(launch::monotonic_time()));
}

void LossesByProcess::look_into(const std::string& recording, const std::vector<Stream>& streams) {
  if (!losses_.cut_short && losses_.damage.empty() && !needed()) {
    losses_.attribution = LossAttribution::kExact;
    for (ProcessAccount& process : losses_.processes) process.lost = 0;
    return;
  }
  if (!needed() || unknown_) return;
  try {
    RecordedProcesses recorded;
    if (const std::optional<std::filesystem::path> report = installed_program("launch-report")) {
      const std::string output = program_output(*report, {"--recorded", recording});
      if (!output.empty()) recorded = parse_recorded_processes(output);
    }
    if (recorded.empty()) counts_.clear();  // then only buffers of its own tell what a process lost
    count_overwritten(losses_, counts_, events_, recorded);
    const bool own_buffers =
        std::any_of(streams.begin(), streams.end(), [](const Stream& stream) { return stream.pid.has_value(); });
    // What is not in the trace was overwritten or lost: counters can't tell which.
    if (overwrites() && !own_buffers) return;
    attribute_losses(losses_, counts_, events_, recorded, streams);
  } catch (const TraceError&) {
    losses_.attribution = LossAttribution::kUnknown;
  }
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
