// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/account/loss_text.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "tracing/record/account/event_cuts.hpp"
#include "tracing/record/account/loss_account.hpp"
#include "tracing/record/account/packet_losses.hpp"

namespace tracing {
namespace {

constexpr std::size_t kMostNamed = 5;  // processes

// "; lost by talker [12] 300 of 4000 (node /talker), …", those that lost most first.
std::string processes_that_lost(const LossAccount& losses) {
  std::vector<const ProcessAccount*> lost;
  for (const ProcessAccount& process : losses.processes) {
    if (process.lost.value_or(0) != 0) {
      lost.push_back(&process);
    }
  }
  std::stable_sort(lost.begin(), lost.end(),
                   [](const ProcessAccount* a, const ProcessAccount* b) { return *a->lost > *b->lost; });
  std::string text;
  for (std::size_t i = 0; i < std::min(lost.size(), kMostNamed); ++i) {
    const ProcessAccount& process = *lost[i];
    text += fmt::format("{}{} [{}] {}", text.empty() ? "" : ", ", process.name.empty() ? "process" : process.name,
                        process.pid, *process.lost);
    if (process.events != 0) {
      text += fmt::format(" of {}", process.events);
    }
    if (process.nodes.empty()) {
      continue;
    }
    text += fmt::format(" (node{} {})", process.nodes.size() == 1 ? "" : "s", fmt::join(process.nodes, ", "));
  }
  if (lost.size() > kMostNamed) {
    text += fmt::format(" and {} processes more", lost.size() - kMostNamed);
  }
  if (text.empty()) {
    return text;
  }
  if (losses.unattributed != 0) {
    text += fmt::format("; {} by programs that do not count", losses.unattributed);
  }
  return fmt::format("\nlost by process{}: {}", losses.attribution == LossAttribution::kExact ? "" : ", estimated",
                     text);
}

std::string counted(std::uint64_t count, const char* what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

// What the channel recorded and lost before the first packet that is left.
std::string before_first_packet(const ChannelLoss& loss) {
  const BeforeFirstPacket& before = loss.before_first;
  const std::string channel = fmt::format("{} channel {}", loss.domain, loss.channel);
  std::string text;
  if (before.packets != 0) {
    const std::string packets = counted(before.packets, "packet");
    if (before.why == BeforeFirstPacket::kOverwrittenInFiles) {
      text = fmt::format("{}{} overwritten in {}, as asked: {} in its oldest files", before.at_least ? "at least " : "",
                         before.events ? counted(*before.events, "event") : "some events", channel, packets);
    } else if (before.why == BeforeFirstPacket::kLost) {
      text = fmt::format("{} lost in {} before the first that was read", packets, channel);
    } else {
      text = fmt::format("{} of {} cleared or moved away", packets, channel);
    }
  }
  if (before.discarded_events == 0) {
    return text;
  }
  return fmt::format("{}{}{} lost in {} before the end of the first packet that is left", text,
                     text.empty() ? "" : "\n", counted(before.discarded_events, "event"), channel);
}

}  // namespace

std::string describe_losses(const LossAccount& losses) {
  std::string text;
  const auto add = [&text](std::uint64_t count, const char* what, const ChannelLoss& loss) {
    if (count == 0) {
      return;
    }
    text += fmt::format("{}{} {}{} lost in {} channel {}", text.empty() ? "" : "\n", count, what, count == 1 ? "" : "s",
                        loss.domain, loss.channel);
    if (loss.subbuffer_count != 0) {
      text += fmt::format(" with {} sub-buffers of {} bytes", loss.subbuffer_count, loss.subbuffer_size);
    }
    if (loss.advised_subbuffer_size != 0) {
      text += fmt::format("; {} of {} would have held them", loss.advised_subbuffer_count, loss.advised_subbuffer_size);
    }
    if (loss.counted_by == LossSource::kDaemon) {
      text += " (as the session daemon counts)";
    }
  };
  for (const ChannelLoss& loss : losses.channels) {
    add(loss.discarded_events, "event", loss);
    add(loss.lost_packets, "packet", loss);
    const std::string earlier = before_first_packet(loss);
    if (!earlier.empty()) {
      text += fmt::format("{}{}", text.empty() ? "" : "\n", earlier);
    }
  }
  text += processes_that_lost(losses);
  for (const Absence& absence : losses.absences) {
    text += fmt::format("{}{}", text.empty() ? "" : "\n", absence.text);
  }
  if (!losses.damage.empty()) {
    text += fmt::format("{}{}", text.empty() ? "" : "\n", losses.damage);
  }
  if (losses.cut_short) {
    text += fmt::format("{}the last events were not waited for", text.empty() ? "" : "\n");
  }
  std::vector<std::string> dropped;
  for (const EventCut& cut : losses.cuts) {
    dropped.push_back(cut.event_class);
  }
  if (!dropped.empty()) {
    text += fmt::format("{}dropped to keep to max-overhead: {}", text.empty() ? "" : "; ", fmt::join(dropped, ", "));
  }
  return text.empty() ? "no events lost" : text;
}

std::string describe_snapshot_losses(const std::vector<Stream>& streams) {
  std::string text;
  std::size_t further = 0;
  for (const Stream& stream : streams) {
    const PacketLosses losses = losses_of(stream);
    if (losses.discarded_events + losses.lost_packets == 0) {
      continue;
    }
    if (std::count(text.begin(), text.end(), ';') + 1 >= static_cast<std::ptrdiff_t>(kMostNamed)) {
      ++further;
      continue;
    }
    text += fmt::format("{}{} lost, processor {} (channel {})", text.empty() ? "" : "; ",
                        losses.discarded_events != 0 ? counted(losses.discarded_events, "event")
                                                     : counted(losses.lost_packets, "packet"),
                        stream.cpu, stream.channel);
  }
  return further == 0 ? text : text + fmt::format("; {} more", counted(further, "stream"));
}

std::string describe_completeness(const LossAccount& losses) {
  if (!losses.complete()) {
    return "incomplete";
  }
  return losses.cuts.empty() ? "complete" : "complete but for what was asked to be dropped";
}

std::string describe_cost(const LossAccount& losses) {
  if (!losses.cost) {
    return {};
  }
  const double ns = losses.cost->ns_per_event;
  double seconds = 0;
  double lasted = losses.seconds;
  const ProcessAccount* most = nullptr;
  for (const ProcessAccount& process : losses.processes) {
    if (process.events == 0) {
      continue;
    }
    seconds += process.tracing_seconds(ns);
    // Without packets the longest process tells how long the recording was.
    lasted = losses.seconds != 0 ? lasted : std::max(lasted, process.seconds);
    // The share of a process that lived for milliseconds is large and tells nothing.
    if (most == nullptr || process.events > most->events) {
      most = &process;
    }
  }
  if (most == nullptr) {
    return {};
  }
  std::string text = fmt::format("estimated cost of tracing: {:.3f} s of processor time, {:.2f} % of a processor",
                                 seconds, lasted > 0 ? 100 * seconds / lasted : 0);
  text += fmt::format("; most in {} [{}]", most->name.empty() ? "process" : most->name, most->pid);
  if (most->cpu_seconds > 0) {
    text += fmt::format(", {:.1f} % of its own processor time", 100 * most->own_share(ns));
  }
  if (most->callbacks != 0) {
    text += fmt::format(", {:.1f} µs for each callback", most->ns_per_callback(ns) / 1000);
  }
  return text + fmt::format(" ({:.0f} ns for each event)", ns);
}

}  // namespace tracing
