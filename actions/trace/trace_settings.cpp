// SPDX-License-Identifier: Apache-2.0
// The evaluated attributes of a <trace>, for --dry-run.
#include <fmt/format.h>

#include "actions/trace/trace_scope.hpp"
#include "tracing/record/plan/trace_config.hpp"

namespace launch {

namespace {

std::vector<std::string> channel_names(const tracing::TraceConfig& config) {
  std::vector<std::string> names;
  for (const tracing::ChannelConfig& channel : config.channels) {
    names.push_back(channel.name);
  }
  return names;
}

std::vector<std::string> chain_names(const TraceChoices& choices) {
  std::vector<std::string> names;
  for (const tracing::ChainDefinition& chain : choices.chains) {
    names.push_back(chain.name);
  }
  return names;
}

}  // namespace

std::vector<ScopeSetting> TraceScope::describe() const {
  const tracing::TraceConfig& config = run_.config();
  return {{"session-name", config.session_name},
          {"trace-directory", config.trace_directory()},
          {"append-trace", config.append_trace},
          {"fail-on-loss", config.fail_on_loss},
          {"report", choices_.report},
          {"events-ust", config.events_ust},
          {"events-kernel", config.events_kernel},
          {"syscalls", config.syscalls},
          {"channels", channel_names(config)},
          {"chains", chain_names(choices_)},
          {"context-fields", config.context_fields_ust},
          {"context-fields-kernel", config.context_fields_kernel},
          {"subbuffer-size-ust", static_cast<std::int64_t>(config.subbuffer_size_ust)},
          {"init-channel", config.init_channel},
          {"subbuffer-count-ust", static_cast<std::int64_t>(config.subbuffer_count_ust)},
          {"read-timer-ust", static_cast<std::int64_t>(config.read_timer_ust)},
          {"switch-timer-ust", static_cast<std::int64_t>(config.switch_timer())},
          {"overwrite-ust", config.overwrite_ust.value_or(config.records_snapshots())},
          {"blocking-timeout-ust", config.blocking_timeout_ust},
          {"buffers-ust", std::string(config.buffers_ust == tracing::BufferOwner::kProcess ? "pid" : "uid")},
          {"tracefile-size", static_cast<std::int64_t>(config.tracefile_size)},
          {"tracefile-count", static_cast<std::int64_t>(config.tracefile_count)},
          {"url", config.over_network() ? config.destination() : std::string()},
          {"live-timer", static_cast<std::int64_t>(config.live_timer)},
          {"launch-events", config.launch_events},
          {"subbuffer-size-kernel", static_cast<std::int64_t>(config.subbuffer_size_kernel)},
          {"snapshot-mode", config.snapshot_mode},
          {"snapshot-on-crash", choices_.snapshot_on_crash},
          {"snapshot-on-events", choices_.snapshot_on_events},
          {"snapshot-on-late-callback", fmt::format("{}", choices_.callback_deadline)},
          {"snapshot-on-late-message", fmt::format("{}", choices_.message_deadline)},
          {"snapshot-limit", static_cast<std::int64_t>(config.snapshot_limit)},
          {"max-overhead", config.max_overhead == 0 ? "" : fmt::format("{:g}%", 100 * config.max_overhead)},
          {"drop-order", config.drop_order},
          {"dual-session", config.dual_session}};
}

}  // namespace launch
