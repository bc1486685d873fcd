// SPDX-License-Identifier: Apache-2.0
// Which events follow from others: through their thread, through messages from a publication to its take, and through
// requests and responses of services.
#include <fmt/format.h>

#include <map>
#include <tuple>
#include <unordered_map>
#include <unordered_set>

#include "launch_trace_testing/expectations.hpp"
#include "tracing/expect/event_table.hpp"

namespace launch_trace_testing {

namespace {

using Thread = std::tuple<std::string, std::int64_t, std::int64_t>;  // host, process, thread

Thread thread_of(const Event& event) {
  return {event.host(), event.vpid(), event.vtid()};
}

// What an event hands over to other threads, or gets from them. Each handover has a number.
struct Handovers {
  std::vector<std::size_t> sent;
  std::vector<std::size_t> received;
};

class HandoverIndex {
 public:
  explicit HandoverIndex(const Trace& trace) {
    for (std::size_t i = 0; i < trace.deliveries().size(); ++i) {
      const Delivery& delivery = trace.deliveries()[i];
      if (delivery.taken_ns == 0) {
        continue;
      }
      published_[{delivery.publisher_vpid, delivery.publisher_vtid, delivery.published_ns}].push_back(i);
      taken_[{delivery.subscriber_vpid, delivery.subscriber_vtid, delivery.taken_ns}].push_back(i);
    }
    requests_begin_ = trace.deliveries().size();
    for (const Event& event : trace) {
      if (event.name() != "ros2:rmw_client_init") {
        continue;
      }
      gids_[{event.host(), event.vpid(), event.handle("rmw_client_handle")}] = to_string(event.at("gid"));
    }
  }

  Handovers of(const Event& event) {
    const Key key{event.vpid(), event.vtid(), event.time_ns()};
    Handovers handovers;
    if (const auto found = published_.find(key); found != published_.end()) {
      handovers.sent = found->second;
    }
    if (const auto found = taken_.find(key); found != taken_.end()) {
      handovers.received = found->second;
    }
    const std::string& name = event.name();
    if (name == "ros2:rmw_send_request") {
      handovers.sent.push_back(number("request", gid_of(event), event));
    }
    if (name == "ros2:rmw_send_response") {
      handovers.sent.push_back(number("response", client_gid(event), event));
    }
    const Value* const taken = event.find("taken");
    if (taken == nullptr || taken->integer().value_or(0) == 0) {
      return handovers;
    }
    if (name == "ros2:rmw_take_request") {
      handovers.received.push_back(number("request", client_gid(event), event));
    }
    if (name == "ros2:rmw_take_response") {
      handovers.received.push_back(number("response", gid_of(event), event));
    }
    return handovers;
  }

 private:
  using Key = std::tuple<std::int64_t, std::int64_t, std::int64_t>;  // process, thread, time

  static std::string client_gid(const Event& event) { return to_string(event.at("client_gid")); }

  std::string gid_of(const Event& event) const {
    const auto found = gids_.find({event.host(), event.vpid(), event.handle("rmw_client_handle")});
    return found == gids_.end() ? std::string() : found->second;
  }

  std::size_t number(const char* kind, const std::string& gid, const Event& event) {
    const auto key = std::tuple(std::string(kind), gid, event.number("sequence_number"));
    return requests_.try_emplace(key, requests_begin_ + requests_.size()).first->second;
  }

  std::map<Key, std::vector<std::size_t>> published_;
  std::map<Key, std::vector<std::size_t>> taken_;
  std::map<std::tuple<std::string, std::int64_t, std::uint64_t>, std::string> gids_;
  std::map<std::tuple<std::string, std::string, std::int64_t>, std::size_t> requests_;
  std::size_t requests_begin_ = 0;
};

// From which position on each thread follows from a cause.
class Consequences {
 public:
  Consequences(const Trace& trace, const EventQuery& cause) {
    HandoverIndex index(trace);
    std::vector<std::pair<const Event*, Handovers>> links;
    for (const Event& event : trace) {
      if (cause.matches(event)) {
        follow(event);
      }
      Handovers handovers = index.of(event);
      if (!handovers.sent.empty() || !handovers.received.empty()) {
        links.emplace_back(&event, std::move(handovers));
      }
    }
    // Again until nothing new is found: by the clocks of two machines a take may precede its publication.
    do {
      changed_ = false;
      for (const auto& [event, handovers] : links) {
        for (const std::size_t handover : handovers.received) {
          if (handed_over_.contains(handover)) {
            follow(*event);
          }
        }
        if (!includes_or_is_cause(*event)) {
          continue;
        }
        for (const std::size_t handover : handovers.sent) {
          changed_ |= handed_over_.insert(handover).second;
        }
      }
    } while (changed_);
    for (const Event& event : trace) {
      if (cause.matches(event)) {
        causes_.insert(event.position());
      }
    }
  }

  bool includes(const Event& event) const {
    const auto since = since_.find(thread_of(event));
    if (since == since_.end() || event.position() < since->second) {
      return false;
    }
    // The first event of a thread that follows is a cause itself, or a take.
    return event.position() > since->second || !causes_.contains(event.position());
  }

 private:
  bool includes_or_is_cause(const Event& event) const {
    const auto since = since_.find(thread_of(event));
    return since != since_.end() && event.position() >= since->second;
  }

  void follow(const Event& event) {
    const auto [since, is_new] = since_.try_emplace(thread_of(event), event.position());
    if (is_new || event.position() < since->second) {
      since->second = event.position();
      changed_ = true;
    }
  }

  std::map<Thread, std::size_t> since_;
  std::unordered_set<std::size_t> handed_over_;
  std::unordered_set<std::size_t> causes_;
  bool changed_ = false;
};

}  // namespace

Verdict expect_happens_before(const Trace& trace, const EventQuery& cause, const EventQuery& effect) {
  const std::string expected = fmt::format("expected: each {} follows from {}", effect.describe(), cause.describe());
  const std::vector<const Event*> effects = effect.select(trace);
  const std::vector<const Event*> causes = cause.select(trace);
  if (effects.empty()) {
    return {false, expected + "\n     saw: no effect" + nearest_text(trace, effect)};
  }
  if (causes.empty()) {
    return {false, expected + "\n     saw: no cause" + nearest_text(trace, cause)};
  }
  const Consequences consequences(trace, cause);
  std::vector<TableRow> failed;
  for (const Event* const event : effects) {
    if (!consequences.includes(*event)) {
      failed.push_back({event});
    }
  }
  if (failed.empty()) {
    return {true, fmt::format("{}\n     saw: {}, {}", expected, counted(causes.size(), "cause"),
                              counted(effects.size(), "effect"))};
  }
  std::vector<TableRow> cause_rows;
  for (const Event* const event : causes) {
    cause_rows.push_back({event});
  }
  return {false,
          fmt::format("{}\n     saw: {} of {} without a way from any cause, by thread, message or request{}"
                      "\ncauses:{}",
                      expected, failed.size(), counted(effects.size(), "effect"),
                      event_table(trace, failed, fields_of(effect)), event_table(trace, cause_rows, fields_of(cause)))};
}

}  // namespace launch_trace_testing
