// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/account/verdict.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <fstream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "base/files/replace_file.hpp"
#include "tracing/record/account/event_cost.hpp"
#include "tracing/record/account/event_cuts.hpp"
#include "tracing/record/account/loss_account.hpp"
#include "tracing/record/account/packet_losses.hpp"
#include "tracing/record/plan/trace_error.hpp"

namespace tracing {
namespace {

// The unbroken runs of packets before which something was lost. Returns the events of the longest.
std::uint64_t add_ranges(const Stream& stream, std::uint64_t origin, std::vector<LossRange>& ranges) {
  if (stream.packets.empty()) {
    return 0;
  }
  std::uint64_t longest = 0;
  // What was lost before packets that are not there any more has no place in the trace.
  const bool is_whole = stream.packets.front().sequence_number.value_or(0) == 0;
  std::uint64_t discarded = is_whole ? 0 : stream.packets.front().discarded_events;
  bool in_run = false;
  for (std::size_t i = 0; i < stream.packets.size(); ++i) {
    const Packet& packet = stream.packets[i];
    const std::uint64_t before = std::exchange(discarded, std::max(discarded, packet.discarded_events));
    const std::uint64_t events = discarded - before;
    const std::uint64_t packets = i == 0 ? 0 : packets_between(stream.packets[i - 1], packet);
    const bool lost = events + packets != 0;
    if (lost) {
      const std::uint64_t begin = i == 0 ? packet.begin : stream.packets[i - 1].end;
      if (!in_run) {
        ranges.push_back({.cpu = stream.cpu, .begin_ns = begin - origin});
      }
      ranges.back().end_ns = (events == 0 ? packet.begin : packet.end) - origin;
      ranges.back().events += events;
      ranges.back().packets += packets;
      longest = std::max(longest, ranges.back().events);
    }
    in_run = lost;
  }
  return longest;
}

// `json` is an array.
void append(nlohmann::ordered_json& json, const LossRange& range, const std::string* channel = nullptr) {
  nlohmann::ordered_json lost;
  if (channel != nullptr) {
    lost["channel"] = *channel;
  }
  lost["cpu"] = range.cpu;
  lost["begin_ns"] = range.begin_ns;
  lost["end_ns"] = range.end_ns;
  lost["events"] = range.events;
  if (range.packets != 0) {
    lost["packets"] = range.packets;
  }
  json.push_back(std::move(lost));
}

// Beyond kLargestAdvice nothing. LTTng takes no sub-buffer that is larger than the files of its channel.
void advise(ChannelLoss& channel, std::uint64_t longest) {
  // What was lost before the first packet or after the last is known as a sum only.
  longest = std::max({longest, channel.before_first.discarded_events, std::uint64_t{1}});
  const std::uint64_t needed = 2 * (channel.subbuffer_size * channel.subbuffer_count + longest * kBytesPerLostEvent);
  if (needed > kLargestAdvice) {
    return;
  }
  channel.advised_subbuffer_size = std::bit_ceil(needed / kAdvisedSubbuffers);
  channel.advised_subbuffer_count = kAdvisedSubbuffers;
  if (channel.tracefile_size != 0 && channel.advised_subbuffer_size > channel.tracefile_size) {
    channel.advised_subbuffer_size = std::bit_floor(channel.tracefile_size);
    channel.advised_subbuffer_count = std::bit_ceil(needed / channel.advised_subbuffer_size);
  }
}

const char* name_of(LossSource source) {
  return source == LossSource::kPackets ? "packets" : source == LossSource::kDaemon ? "daemon" : "kernel recorder";
}

const char* name_of(BeforeFirstPacket::Why why) {
  return why == BeforeFirstPacket::kOverwrittenInFiles ? "overwritten, as asked"
         : why == BeforeFirstPacket::kLost             ? "lost"
                                                       : "removed";
}

nlohmann::ordered_json channel_as_json(const ChannelLoss& channel) {
  nlohmann::ordered_json json = {{"domain", channel.domain},
                                 {"channel", channel.channel},
                                 {"subbuffer_size", channel.subbuffer_size},
                                 {"subbuffer_count", channel.subbuffer_count},
                                 {"bytes", channel.bytes},
                                 {"discarded_events", channel.discarded_events},
                                 {"lost_packets", channel.lost_packets},
                                 {"counted_by", name_of(channel.counted_by)},
                                 {"lost", nlohmann::ordered_json::array()}};
  if (channel.only_daemon_events + channel.only_daemon_packets != 0) {
    json["only_daemon"] = {{"discarded_events", channel.only_daemon_events},
                           {"lost_packets", channel.only_daemon_packets}};
  }
  if (const BeforeFirstPacket& before = channel.before_first; !before.nothing()) {
    json["before_first_packet"] = {{"why", name_of(before.why)},
                                   {"packets", before.packets},
                                   {"events", nullptr},
                                   {"discarded_events", before.discarded_events}};
    if (before.events) {
      json["before_first_packet"]["events"] = *before.events;
    }
    if (before.at_least) {
      json["before_first_packet"]["at_least"] = true;
    }
  }
  for (const LossRange& range : channel.ranges) {
    append(json["lost"], range);
  }
  for (const UnwrittenRange& range : channel.unwritten) {
    json["unwritten"].push_back({{"cpu", range.cpu}, {"begin_ns", range.begin_ns}, {"end_ns", range.end_ns}});
    if (range.pid) {
      json["unwritten"].back()["pid"] = *range.pid;
    }
    if (range.in_doubt) {
      json["unwritten"].back()["in_doubt"] = true;
    }
  }
  if (channel.advised_subbuffer_size != 0) {
    json["would_have_held"] = {{"subbuffer_size", channel.advised_subbuffer_size},
                               {"subbuffer_count", channel.advised_subbuffer_count}};
  }
  return json;
}

nlohmann::ordered_json process_as_json(const ProcessAccount& process, const std::optional<EventCost>& cost) {
  nlohmann::ordered_json json = {{"name", process.name},
                                 {"pid", process.pid},
                                 {"seconds", process.seconds},
                                 {"events", process.events},
                                 {"callbacks", process.callbacks}};
  if (process.counts) {
    json["recorded_after_s"] = process.reached_after ? nlohmann::ordered_json(*process.reached_after) : nullptr;
    json["missed_events"] = process.missed;
  }
  json["lost"] = process.lost ? nlohmann::ordered_json(*process.lost) : nlohmann::ordered_json(nullptr);
  if (!process.nodes.empty()) {
    json["nodes"] = process.nodes;
  }
  if (!cost) {
    return json;
  }
  const double ns = cost->ns_per_event;
  json["tracing"] = {{"seconds", process.tracing_seconds(ns)}, {"processor_share", process.processor_share(ns)}};
  if (process.cpu_seconds > 0) {
    json["tracing"]["own_share"] = process.own_share(ns);
  }
  if (process.callbacks != 0) {
    json["tracing"]["ns_per_callback"] = process.ns_per_callback(ns);
  }
  return json;
}

nlohmann::ordered_json tracetools_as_json(const TracetoolsUse& use) {
  nlohmann::ordered_json json = {{"process", use.process}, {"uses", use.is_own ? "own" : "theirs"}};
  if (!use.theirs.empty()) {
    json["theirs"] = use.theirs;
  }
  if (!use.version.empty()) {
    json["version"] = use.version;
  }
  if (!use.reason.empty()) {
    json["reason"] = use.reason;
  }
  return json;
}

const char* name_of(LossAttribution attribution) {
  return attribution == LossAttribution::kExact      ? "exact"
         : attribution == LossAttribution::kEstimate ? "estimate"
                                                     : "unknown";
}

void write_file(const std::filesystem::path& directory, const std::string& text) {
  const std::filesystem::path path = directory / kVerdictFile;
  try {
    launch::replace_file(path, text);
  } catch (const std::system_error& error) {
    throw TraceError(fmt::format("cannot write {}: {}", path.string(), error.code().message()));
  }
}

}  // namespace

void explain_losses(LossAccount& account, const std::vector<Stream>& streams) {
  const std::uint64_t origin = first_time(streams);
  std::uint64_t end = 0;
  for (const Stream& stream : streams) {
    end = std::max(end, stream.packets.empty() ? 0 : stream.packets.back().end);
  }
  account.seconds = end > origin ? to_seconds(end - origin) : 0;
  for (ChannelLoss& channel : account.channels) {
    std::uint64_t longest = 0;
    for (const Stream& stream : streams) {
      if (stream.domain != channel.domain || stream.channel != channel.channel) {
        continue;
      }
      for (const Packet& packet : stream.packets) {
        channel.bytes += packet.bytes;
      }
      longest = std::max(longest, add_ranges(stream, origin, channel.ranges));
    }
    const bool lost = channel.discarded_events + channel.before_first.discarded_events != 0;
    if (lost && channel.subbuffer_count != 0) {
      advise(channel, longest);
    }
  }
}

std::string verdict_as_json(const LossAccount& account, const std::string& session_name) {
  nlohmann::ordered_json json = {{"session", session_name},
                                 {"complete", account.complete()},
                                 {"cut_short", account.cut_short},
                                 {"damage", account.damage},
                                 {"absent", nlohmann::ordered_json::array()},
                                 {"discarded_events", account.discarded_events()},
                                 {"lost_packets", account.lost_packets()},
                                 {"channels", nlohmann::ordered_json::array()}};
  for (const Absence& absence : account.absences) {
    json["absent"].push_back(absence.text);
  }
  for (const ChannelLoss& channel : account.channels) {
    json["channels"].push_back(channel_as_json(channel));
  }
  json["lost_by_process"] = {{"method", name_of(account.attribution)}, {"unattributed", account.unattributed}};
  if (account.cost) {
    json["event_cost"] = {{"ns", account.cost->ns_per_event},
                          {"measured", account.cost->measured},
                          {"cpu", account.cost->cpu},
                          {"lttng", account.cost->lttng},
                          {"context_fields", account.cost->context_fields}};
  }
  for (const EventCut& cut : account.cuts) {
    json["cuts"].push_back({{"class", cut.event_class},
                            {"events", cut.events},
                            {"time_ns", cut.time},
                            {"rate", cut.rate},
                            {"processor_share", cut.share}});
  }
  for (const TracetoolsUse& use : account.tracetools) {
    json["tracetools"].push_back(tracetools_as_json(use));
  }
  json["processes"] = nlohmann::ordered_json::array();
  for (const ProcessAccount& process : account.processes) {
    json["processes"].push_back(process_as_json(process, account.cost));
  }
  if (!account.launch_processes.empty()) {
    json["launch_processes"] = account.launch_processes;
  }
  if (account.nothing_to_record) {
    json["nothing_to_record"] = true;
  }
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void write_verdict(const LossAccount& account, const std::string& session_name,
                   const std::filesystem::path& directory) {
  write_file(directory, verdict_as_json(account, session_name));
}

void note_appended(const std::filesystem::path& appended, bool complete) {
  const std::filesystem::path trace = appended.parent_path();
  std::ifstream file(trace / kVerdictFile);
  nlohmann::ordered_json verdict = nlohmann::ordered_json::parse(file, nullptr, false);
  if (!verdict.is_object()) {
    return;  // the first recording has none
  }
  nlohmann::ordered_json& recordings = verdict["appended"];
  recordings[appended.filename().string()] = complete;
  verdict["complete"] = verdict.value("complete", false) && complete;
  write_file(trace, verdict.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

void write_snapshot_verdict(const std::filesystem::path& directory, const std::string& session_name,
                            const SnapshotAccount& account, const std::vector<Stream>& streams) {
  std::uint64_t discarded = 0;
  std::uint64_t lost = 0;
  std::uint64_t begin = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t end = 0;
  std::map<std::string, std::uint64_t> bytes;
  for (const Stream& stream : streams) {
    const PacketLosses losses = losses_of(stream);
    discarded += losses.discarded_events;
    lost += losses.lost_packets;
    for (const Packet& packet : stream.packets) {
      begin = std::min(begin, packet.begin);
      end = std::max(end, packet.end);
      bytes[stream.domain] += packet.bytes;
    }
  }
  const bool complete = discarded == 0 && lost == 0 && account.absences.empty() && account.unwritten.empty();
  nlohmann::ordered_json json = {{"session", session_name},
                                 {"reasons", account.reasons},
                                 {"complete", complete},
                                 {"damage", account.damage},
                                 {"absent", nlohmann::ordered_json::array()},
                                 {"discarded_events", discarded},
                                 {"lost_packets", lost},
                                 {"bytes", bytes},
                                 {"begin_ns", std::min(begin, end)},
                                 {"end_ns", end}};
  for (const Absence& absence : account.absences) {
    json["absent"].push_back(absence.text);
  }
  for (const Stream& stream : streams) {
    std::vector<LossRange> ranges;
    add_ranges(stream, std::min(begin, end), ranges);
    for (const LossRange& range : ranges) {
      append(json["lost"], range, &stream.channel);
    }
  }
  for (const UnwrittenRange& range : account.unwritten) {
    json["unwritten"].push_back(
        {{"channel", range.channel}, {"cpu", range.cpu}, {"begin_ns", range.begin_ns}, {"end_ns", range.end_ns}});
  }
  if (!account.launch_processes.empty()) {
    json["launch_processes"] = account.launch_processes;
  }
  write_file(directory, json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

}  // namespace tracing
