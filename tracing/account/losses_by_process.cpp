// SPDX-License-Identifier: Apache-2.0
#include "tracing/account/losses_by_process.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "launcher/base/monotonic_clock.hpp"
#include "tracing/account/event_cuts.hpp"
#include "tracing/account/loss_account.hpp"
#include "tracing/account/loss_attribution.hpp"
#include "tracing/account/packet_index.hpp"
#include "tracing/account/recorded_events.hpp"
#include "tracing/lttng/installed_program.hpp"
#include "tracing/plan/trace_config.hpp"
#include "tracing/plan/trace_error.hpp"

namespace tracing {

LossesByProcess::LossesByProcess(const TraceConfig& config, LossAccount& losses) : losses_(losses) {
  if (!config.event_counters.empty()) counts_ = EventCounters(config.event_counters).read();
  losses.cuts = read_cuts(config);
  if (losses.complete()) losses.attribution = LossAttribution::kExact;
  try {
    if (!counts_.empty() || needed()) events_ = read_recorded_events(config.lttng_session_name());
  } catch (const TraceError&) {
    unknown_ = true;
  }
  losses.processes = account_processes(counts_, events_, static_cast<std::uint64_t>(launch::monotonic_time()));
}

void LossesByProcess::look_into(const std::string& recording) {
  if (!needed() || unknown_) return;
  try {
    RecordedProcesses recorded;
    if (const std::optional<std::filesystem::path> report = installed_program("launch-report")) {
      const std::string output = program_output(*report, {"--recorded", recording});
      if (!output.empty()) recorded = parse_recorded_processes(output);
    }
    if (recorded.empty()) counts_.clear();  // then only buffers of its own tell what a process lost
    attribute_losses(losses_, counts_, events_, recorded, read_packet_index(recording));
  } catch (const TraceError&) {
    losses_.attribution = LossAttribution::kUnknown;
  }
}

bool LossesByProcess::needed() const {
  return !losses_.cut_short &&
         std::any_of(losses_.channels.begin(), losses_.channels.end(), [](const ChannelLoss& channel) {
           return channel.domain == "ust" && channel.discarded_events + channel.lost_packets != 0;
         });
}

}  // namespace tracing
