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
  return {{"session-name", config_.session_name},
          {"trace-directory", config_.trace_directory()},
          {"append-trace", config_.append_trace},
          {"fail-on-loss", config_.fail_on_loss},
          {"report", choices_.report},
          {"events-ust", config_.events_ust},
          {"events-kernel", config_.events_kernel},
          {"syscalls", config_.syscalls},
          {"channels", channel_names(config_)},
          {"chains", chain_names(choices_)},
          {"context-fields", config_.context_fields_ust},
          {"context-fields-kernel", config_.context_fields_kernel},
          {"subbuffer-size-ust", static_cast<std::int64_t>(config_.subbuffer_size_ust)},
          {"init-channel", config_.init_channel},
          {"subbuffer-count-ust", static_cast<std::int64_t>(config_.subbuffer_count_ust)},
          {"read-timer-ust", static_cast<std::int64_t>(config_.read_timer_ust)},
          {"switch-timer-ust", static_cast<std::int64_t>(config_.switch_timer())},
          {"overwrite-ust", config_.overwrite_ust.value_or(config_.records_snapshots())},
          {"blocking-timeout-ust", config_.blocking_timeout_ust},
          {"buffers-ust", std::string(config_.buffers_ust == tracing::BufferOwner::kProcess ? "pid" : "uid")},
          {"tracefile-size", static_cast<std::int64_t>(config_.tracefile_size)},
          {"tracefile-count", static_cast<std::int64_t>(config_.tracefile_count)},
          {"url", config_.over_network() ? config_.destination() : std::string()},
          {"live-timer", static_cast<std::int64_t>(config_.live_timer)},
          {"launch-events", config_.launch_events},
          {"subbuffer-size-kernel", static_cast<std::int64_t>(config_.subbuffer_size_kernel)},
          {"snapshot-mode", config_.snapshot_mode},
          {"snapshot-on-crash", choices_.snapshot_on_crash},
          {"snapshot-on-events", choices_.snapshot_on_events},
          {"snapshot-on-late-callback", fmt::format("{}", choices_.callback_deadline)},
          {"snapshot-on-late-message", fmt::format("{}", choices_.message_deadline)},
          {"snapshot-limit", static_cast<std::int64_t>(config_.snapshot_limit)},
          {"max-overhead", config_.max_overhead == 0 ? "" : fmt::format("{:g}%", 100 * config_.max_overhead)},
          {"drop-order", config_.drop_order},
          {"dual-session", config_.dual_session}};
}

}  // namespace launch
