// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/account/loss_attribution.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>

#include "tracing/record/account/loss_account.hpp"
#include "tracing/record/account/packet_losses.hpp"
#include "tracing/record/account/recorded_events.hpp"
#include "tracing/record/account/stream_packets.hpp"
#include "tracing/record/plan/trace_error.hpp"

namespace tracing {
namespace {

constexpr const char* kCallbackEnd = "ros2:callback_end";

std::uint64_t userspace_losses(const LossAccount& account) {
  std::uint64_t sum = 0;
  for (const ChannelLoss& channel : account.channels) {
    if (channel.domain == "ust") {
      sum += channel.discarded_events;
    }
  }
  return sum;
}

// The losses of each process that has buffers of its own. Nothing if packets are missing: how many events these held is
// unknown.
std::map<std::int64_t, std::optional<std::uint64_t>> losses_by_buffers(const std::vector<Stream>& streams) {
  std::map<std::int64_t, std::optional<std::uint64_t>> losses;
  for (const Stream& stream : streams) {
    if (!stream.pid || stream.packets.empty()) {
      continue;
    }
    const PacketLosses found = losses_of(stream);
    std::optional<std::uint64_t>& sum = losses.try_emplace(*stream.pid, 0).first->second;
    if (found.lost_packets + found.earlier_packets != 0) {
      sum.reset();
    }
    if (sum) {
      *sum += found.discarded_events;
    }
  }
  return losses;
}

// In all channels together.
bool packets_are_missing(const LossAccount& account) {
  return std::any_of(account.channels.begin(), account.channels.end(), [](const ChannelLoss& channel) {
    return channel.domain == "ust" && channel.lost_packets + channel.before_first.packets != 0;
  });
}

// Lost = events fired - events in the trace, for each process that counts its events.
std::map<std::int64_t, std::optional<std::uint64_t>> losses_by_counters(const std::vector<EventCounts>& counts,
                                                                        const RecordedEvents& events,
                                                                        const RecordedProcesses& recorded) {
  std::map<std::int64_t, std::map<std::string, std::uint64_t>> fired;
  for (const EventCounts& process : counts) {
    for (const auto& [event, count] : process.events) {
      if (events.countable(event)) {
        fired[process.pid][event] += count * events.times(event);
      }
    }
  }
  std::map<std::int64_t, std::optional<std::uint64_t>> losses;
  for (const auto& [pid, by_event] : fired) {
    const auto found = recorded.find(pid);
    std::uint64_t lost = 0;
    for (const auto& [event, count] : by_event) {
      std::uint64_t arrived = 0;
      if (found != recorded.end() && found->second.events.contains(event)) {
        arrived = found->second.events.at(event);
      }
      lost += count - std::min(count, arrived);
    }
    losses[pid] = lost;
  }
  return losses;
}

}  // namespace

RecordedProcesses parse_recorded_processes(const std::string& text) {
  try {
    RecordedProcesses recorded;
    const nlohmann::json parsed = nlohmann::json::parse(text);
    for (const nlohmann::json& process : parsed.at("processes")) {
      recorded[process.at("vpid")] = {.nodes = process.at("nodes"),
                                      .events = process.at("events"),
                                      .name = process.value("name", ""),
                                      .seconds = process.value("seconds", 0.0)};
    }
    return recorded;
  } catch (const nlohmann::json::exception& error) {
    throw TraceError(fmt::format("cannot count the events of the trace: {}", error.what()));
  }
}

namespace {

std::optional<double> seconds_until_reached(const EventCounts& process) {
  if (process.reached == 0) {
    return std::nullopt;
  }
  return to_seconds(process.reached - process.begin);
}

}  // namespace

std::vector<ProcessAccount> account_processes(const std::vector<EventCounts>& counts, const RecordedEvents& events,
                                              std::uint64_t now) {
  std::vector<ProcessAccount> processes;
  for (const EventCounts& process : counts) {
    const std::uint64_t end = process.end != 0 ? process.end : std::max(now, process.begin);
    const auto callbacks = process.events.find(kCallbackEnd);
    std::uint64_t recorded = 0;
    for (const auto& [event, count] : process.events) {
      recorded += count * events.times(event);
    }
    processes.push_back({.name = process.process,
                         .pid = process.pid,
                         .seconds = to_seconds(end - process.begin),
                         .cpu_seconds = to_seconds(process.cpu),
                         .events = recorded,
                         .callbacks = callbacks != process.events.end() ? callbacks->second : 0,
                         .reached_after = seconds_until_reached(process),
                         .missed = process.missed,
                         .lost = std::nullopt});
  }
  return processes;
}

void add_uncounted_events(std::vector<ProcessAccount>& processes, const RecordedProcesses& recorded) {
  for (const auto& [pid, process] : recorded) {
    // The last of the programs that the process has been.
    const auto found = std::find_if(processes.rbegin(), processes.rend(),
                                    [wanted = pid](const ProcessAccount& known) { return known.pid == wanted; });
    const bool is_known = found != processes.rend();
    const bool counts = is_known && found->counts;
    std::uint64_t uncounted = 0;
    for (const auto& [event, count] : process.events) {
      if (event.starts_with("launch:") || (counts && is_counted(event))) {
        continue;
      }
      uncounted += count;
    }
    if (uncounted == 0) {
      continue;
    }
    if (counts) {
      found->events += uncounted;
      continue;
    }
    // Known by the losses of its own buffers.
    const std::optional<std::uint64_t> lost = is_known ? found->lost : std::nullopt;
    if (is_known) {
      processes.erase(std::prev(found.base()));
    }
    const auto callbacks = process.events.find(kCallbackEnd);
    processes.push_back({.name = process.name,
                         .pid = pid,
                         .seconds = process.seconds,
                         .events = uncounted + lost.value_or(0),
                         .callbacks = callbacks != process.events.end() ? callbacks->second : 0,
                         .lost = lost,
                         .nodes = process.nodes,
                         .counts = false});
  }
}

void attribute_losses(LossAccount& account, const std::vector<EventCounts>& counts, const RecordedEvents& events,
                      const RecordedProcesses& recorded, const std::vector<Stream>& streams) {
  std::map<std::int64_t, std::optional<std::uint64_t>> losses = losses_by_buffers(streams);
  const bool by_buffers = !losses.empty();
  if (!by_buffers) {
    losses = losses_by_counters(counts, events, recorded);
  }
  std::uint64_t sum = 0;
  for (const auto& [pid, lost] : losses) {
    sum += lost.value_or(0);
    const bool counted = std::any_of(account.processes.begin(), account.processes.end(),
                                     [wanted = pid](const ProcessAccount& process) { return process.pid == wanted; });
    if (!counted && lost.value_or(1) != 0) {
      account.processes.push_back({.name = "", .pid = pid, .counts = false});
    }
  }
  for (ProcessAccount& process : account.processes) {
    process.lost.reset();
    // Programs that one process became after another (exec) are one in the trace.
    if (const auto found = losses.find(process.pid); found != losses.end()) {
      process.lost = found->second;
      losses.erase(found);
    }
    if (const auto found = recorded.find(process.pid); found != recorded.end()) {
      process.nodes = found->second.nodes;
    }
  }
  if (account.processes.empty()) {
    return;
  }
  const std::uint64_t total = userspace_losses(account);
  const bool all_counted = account.damage.empty() && !packets_are_missing(account);
  account.attribution = sum == total && all_counted ? LossAttribution::kExact : LossAttribution::kEstimate;
  account.unattributed = total - std::min(sum, total);
}

void count_overwritten(LossAccount& account, const std::vector<EventCounts>& counts, const RecordedEvents& events,
                       const RecordedProcesses& recorded) {
  ChannelLoss* overwritten = nullptr;
  std::uint64_t discarded = 0;
  for (ChannelLoss& channel : account.channels) {
    if (channel.domain != "ust") {
      continue;
    }
    discarded += channel.discarded_events + channel.before_first.discarded_events;
    const bool in_files = channel.before_first.why == BeforeFirstPacket::kOverwrittenInFiles;
    // Counters know one sum for all channels, and what lost packets held is unknown as well.
    if (channel.lost_packets != 0 || (in_files && channel.before_first.packets != 0 && overwritten)) {
      return;
    }
    if (in_files && channel.before_first.packets != 0) {
      overwritten = &channel;
    }
  }
  if (overwritten == nullptr) {
    return;
  }
  std::uint64_t missing = 0;
  for (const auto& [pid, lost] : losses_by_counters(counts, events, recorded)) {
    missing += lost.value_or(0);
  }
  if (missing <= discarded) {
    return;
  }
  overwritten->before_first.events = missing - discarded;
  const bool all_count = std::all_of(recorded.begin(), recorded.end(), [&counts](const auto& process) {
    return std::any_of(counts.begin(), counts.end(),
                       [&process](const EventCounts& counted) { return counted.pid == process.first; });
  });
  const bool all_countable =
      std::none_of(events.rules.begin(), events.rules.end(), [](const auto& rule) { return rule.conditional; });
  overwritten->before_first.at_least = !all_count || !all_countable;
}

}  // namespace tracing
