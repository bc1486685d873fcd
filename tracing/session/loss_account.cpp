// SPDX-License-Identifier: Apache-2.0
#include "tracing/session/loss_account.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <lttng/lttng.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <numeric>

#include "tracing/session/channels.hpp"
#include "tracing/session/lttng_error.hpp"
#include "tracing/session/verdict.hpp"

namespace tracing {
namespace {

struct Free {
  void operator()(void* memory) const { std::free(memory); }
};

// LTTng 2.13 now and then returns the count of a userspace channel with the highest bit set.
constexpr std::uint64_t kCountBits = ~(std::uint64_t{1} << 63);

void read_domain(const std::string& session, const lttng_domain& domain, LossAccount& account) {
  const DomainHandle handle = domain_handle(session, domain);
  const std::string doing = fmt::format("read the lost events of session '{}'", session);
  lttng_channel* listed = nullptr;
  const int count = check_lttng(lttng_list_channels(handle.get(), &listed), doing);
  const std::unique_ptr<lttng_channel, Free> channels(listed);
  for (int i = 0; i < count; ++i) {
    ChannelLoss loss{.domain = domain_name(domain.type), .channel = listed[i].name};
    loss.subbuffer_size = listed[i].attr.subbuf_size;
    loss.subbuffer_count = listed[i].attr.num_subbuf;
    check_lttng(lttng_channel_get_discarded_event_count(&listed[i], &loss.discarded_events), doing);
    check_lttng(lttng_channel_get_lost_packet_count(&listed[i], &loss.lost_packets), doing);
    loss.discarded_events &= kCountBits;
    loss.lost_packets &= kCountBits;
    account.channels.push_back(std::move(loss));
  }
}

std::vector<std::string> exclusions_of(lttng_event& rule) {
  std::vector<std::string> names;
  const int count = lttng_event_get_exclusion_name_count(&rule);
  for (int i = 0; i < count; ++i) {
    const char* name = nullptr;
    if (lttng_event_get_exclusion_name(&rule, static_cast<std::size_t>(i), &name) == 0) names.emplace_back(name);
  }
  return names;
}

constexpr std::size_t kMostNamed = 5;  // processes

// "; lost by talker [12] 300 of 4000 (node /talker), …", those that lost most first.
std::string processes_that_lost(const LossAccount& losses) {
  std::vector<const ProcessAccount*> lost;
  for (const ProcessAccount& process : losses.processes) {
    if (process.lost.value_or(0) != 0) lost.push_back(&process);
  }
  std::stable_sort(lost.begin(), lost.end(),
                   [](const ProcessAccount* a, const ProcessAccount* b) { return *a->lost > *b->lost; });
  std::string text;
  for (std::size_t i = 0; i < std::min(lost.size(), kMostNamed); ++i) {
    const ProcessAccount& process = *lost[i];
    text += fmt::format("{}{} [{}] {}", text.empty() ? "" : ", ", process.name.empty() ? "process" : process.name,
                        process.pid, *process.lost);
    if (process.events != 0) text += fmt::format(" of {}", process.events);
    if (process.nodes.empty()) continue;
    text += fmt::format(" (node{} {})", process.nodes.size() == 1 ? "" : "s", fmt::join(process.nodes, ", "));
  }
  if (lost.size() > kMostNamed) text += fmt::format(" and {} processes more", lost.size() - kMostNamed);
  if (text.empty()) return text;
  if (losses.unattributed != 0) text += fmt::format("; {} by programs that do not count", losses.unattributed);
  return fmt::format("\nlost by process{}: {}", losses.attribution == LossAttribution::kExact ? "" : ", estimated",
                     text);
}

}  // namespace

std::uint64_t LossAccount::discarded_events() const {
  return std::accumulate(channels.begin(), channels.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const ChannelLoss& loss) { return sum + loss.discarded_events; });
}

std::uint64_t LossAccount::lost_packets() const {
  return std::accumulate(channels.begin(), channels.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const ChannelLoss& loss) { return sum + loss.lost_packets; });
}

LossAccount read_losses(const std::string& lttng_session_name) {
  LossAccount account;
  lttng_domain* listed = nullptr;
  const int count = check_lttng(lttng_list_domains(lttng_session_name.c_str(), &listed),
                                fmt::format("list the domains of session '{}'", lttng_session_name));
  const std::unique_ptr<lttng_domain, Free> domains(listed);
  for (int i = 0; i < count; ++i) read_domain(lttng_session_name, listed[i], account);
  return account;
}

RecordedEvents read_recorded_events(const std::string& lttng_session_name) {
  RecordedEvents recorded;
  const DomainHandle handle = domain_handle(lttng_session_name, LTTNG_DOMAIN_UST);
  const std::string doing = fmt::format("list the events of session '{}'", lttng_session_name);
  lttng_channel* listed = nullptr;
  const int count = check_lttng(lttng_list_channels(handle.get(), &listed), doing);
  const std::unique_ptr<lttng_channel, Free> channels(listed);
  for (int i = 0; i < count; ++i) {
    lttng_event* rules = nullptr;
    const int rule_count = check_lttng(lttng_list_events(handle.get(), listed[i].name, &rules), doing);
    const std::unique_ptr<lttng_event, Free> owned(rules);
    for (int rule = 0; rule < rule_count; ++rule) {
      recorded.rules.push_back(
          {.channel = listed[i].name,
           .pattern = rules[rule].name,
           .exclusions = exclusions_of(rules[rule]),
           .conditional = rules[rule].filter != 0 || rules[rule].loglevel_type != LTTNG_EVENT_LOGLEVEL_ALL});
    }
  }
  return recorded;
}

std::string describe_losses(const LossAccount& losses) {
  std::string text;
  const auto add = [&text](std::uint64_t count, const char* what, const ChannelLoss& loss) {
    if (count == 0) return;
    text += fmt::format("{}{} {}{} lost in {} channel {}", text.empty() ? "" : "\n", count, what, count == 1 ? "" : "s",
                        loss.domain, loss.channel);
    if (loss.subbuffer_count != 0) {
      text += fmt::format(" with {} sub-buffers of {} bytes", loss.subbuffer_count, loss.subbuffer_size);
    }
    if (loss.advised_subbuffer_size != 0) {
      text += fmt::format("; {} of {} would have held them", kAdvisedSubbuffers, loss.advised_subbuffer_size);
    }
  };
  for (const ChannelLoss& loss : losses.channels) {
    add(loss.discarded_events, "event", loss);
    add(loss.lost_packets, "packet", loss);
  }
  text += processes_that_lost(losses);
  if (!losses.damage.empty()) text += fmt::format("{}{}", text.empty() ? "" : "\n", losses.damage);
  if (losses.cut_short) text += fmt::format("{}the last events were not waited for", text.empty() ? "" : "\n");
  if (text.empty()) text = "no events lost";
  std::vector<std::string> dropped;
  for (const EventCut& cut : losses.cuts) dropped.push_back(cut.event_class);
  if (!dropped.empty()) text += fmt::format("; dropped to keep to max-overhead: {}", fmt::join(dropped, ", "));
  return text;
}

std::string describe_cost(const LossAccount& losses) {
  if (!losses.cost) return {};
  const double ns = losses.cost->ns_per_event;
  double seconds = 0;
  double processors = 0;
  const ProcessAccount* most = nullptr;
  for (const ProcessAccount& process : losses.processes) {
    if (process.events == 0) continue;
    seconds += process.tracing_seconds(ns);
    processors += process.processor_share(ns);
    if (most == nullptr || process.processor_share(ns) > most->processor_share(ns)) most = &process;
  }
  if (most == nullptr) return {};
  std::string text = fmt::format("estimated cost of tracing: {:.3f} s of processor time, {:.2f} % of a processor",
                                 seconds, 100 * processors);
  text += fmt::format("; most in {} [{}]", most->name, most->pid);
  if (most->cpu_seconds > 0) text += fmt::format(", {:.1f} % of its own processor time", 100 * most->own_share(ns));
  if (most->callbacks != 0) text += fmt::format(", {:.1f} µs for each callback", most->ns_per_callback(ns) / 1000);
  return text + fmt::format(" ({:.0f} ns for each event)", ns);
}

}  // namespace tracing
