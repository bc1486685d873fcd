// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/messages/service_matcher.hpp"

#include <algorithm>
#include <cstring>

namespace tracing {

std::size_t ServiceMatcher::HashKey::operator()(const Key& key) const {
  std::uint64_t words[3];
  static_assert(sizeof words == sizeof key.gid.bytes);
  std::memcpy(words, key.gid.bytes.data(), sizeof words);
  std::uint64_t hash = static_cast<std::uint64_t>(key.sequence_number);
  for (const std::uint64_t word : words) {
    hash = (hash ^ word) * 0x9e3779b97f4a7c15;
  }
  return hash ^ (hash >> 32);
}

ServiceMatcher::Call& ServiceMatcher::begin(const Key& key) {
  const auto [found, is_new] = calls_.try_emplace(key);
  if (is_new) {
    oldest_first_.push_back(key);
    if (oldest_first_.size() > kRemembered) {
      const auto oldest = calls_.find(oldest_first_.front());
      oldest_first_.pop_front();
      if (oldest != calls_.end() && oldest != found) {
        end(oldest->second);
        calls_.erase(oldest);
      }
    }
  }
  return found->second;
}

// A client without its rmw_client_init gets an identity of its own, so that its requests are still found when its
// responses come.
ros2::Gid ServiceMatcher::gid_of(ObjectId client) const {
  ros2::Gid gid = model_.clients()[client].gid;
  if (gid.size == 0) {
    std::memcpy(gid.bytes.data(), &client, sizeof client);
  }
  return gid;
}

void ServiceMatcher::on(const Origin& origin, const ros2::RmwSendRequest& event) {
  const ObjectId client = model_.rmw_client(origin.process, event.rmw_client_handle);
  if (client == kNoObject) {
    ++unknown_clients_;
    return;
  }
  const Key key{gid_of(client), event.sequence_number};
  Call& call = begin(key);
  call.client = client;
  call.sent_ns = origin.time_ns;
  if (call.received_ns) {
    end_now(key);
  }
}

void ServiceMatcher::on(const Origin& origin, const ros2::RmwTakeRequest& event) {
  if (!event.taken) {
    return;
  }
  Call& call = begin({event.client_gid, event.sequence_number});
  if (call.taken_ns) {
    return;
  }
  call.service = model_.rmw_service(origin.process, event.rmw_service_handle);
  call.taken_ns = origin.time_ns;
  served_[{origin.process, origin.vtid}] = {event.client_gid, event.sequence_number};
}

void ServiceMatcher::begin_work(const Origin& origin) {
  const auto served = served_.find({origin.process, origin.vtid});
  if (served == served_.end()) {
    return;
  }
  if (const auto call = calls_.find(served->second); call != calls_.end()) {
    call->second.worked = true;
  }
}

void ServiceMatcher::end_work(const Origin& origin) {
  const auto served = served_.find({origin.process, origin.vtid});
  if (served == served_.end()) {
    return;
  }
  if (const auto call = calls_.find(served->second); call != calls_.end()) {
    call->second.worked_ns = origin.time_ns;
  }
  served_.erase(served);
}

void ServiceMatcher::end_client(ObjectId client, std::int64_t time_ns) {
  if (client != kNoObject) {
    ended_clients_.try_emplace(client, time_ns);
  }
}

void ServiceMatcher::end_process(ProcessId process, std::int64_t time_ns) {
  ended_processes_.try_emplace(process, time_ns);
}

void ServiceMatcher::on(const Origin& origin, const ros2::RmwSendResponse& event) {
  const auto call = calls_.find({event.client_gid, event.sequence_number});
  if (call == calls_.end() || call->second.answered_ns ||
      call->second.service != model_.rmw_service(origin.process, event.rmw_service_handle)) {
    return;
  }
  call->second.answered_ns = origin.time_ns;
}

void ServiceMatcher::on(const Origin& origin, const ros2::RmwTakeResponse& event) {
  const ObjectId client = model_.rmw_client(origin.process, event.rmw_client_handle);
  if (!event.taken || client == kNoObject) {
    return;
  }
  const Key key{gid_of(client), event.sequence_number};
  const auto call = calls_.find(key);
  if (call == calls_.end()) {
    return;
  }
  call->second.received_ns = origin.time_ns;
  if (call->second.sent_ns) {
    end_now(key);
  }
}

void ServiceMatcher::end_now(const Key& key) {
  const auto call = calls_.find(key);
  end(call->second);
  calls_.erase(call);
}

std::int64_t ServiceMatcher::end_of(ObjectId client, std::int64_t end_ns) const {
  if (client == kNoObject) {
    return end_ns;
  }
  if (const auto ended = ended_clients_.find(client); ended != ended_clients_.end()) {
    end_ns = std::min(end_ns, ended->second);
  }
  const ObjectId node = model_.clients()[client].node;
  if (node != kNoObject) {
    const auto ended = ended_processes_.find(model_.nodes()[node].process);
    if (ended != ended_processes_.end()) {
      end_ns = std::min(end_ns, ended->second);
    }
  }
  return end_ns;
}

bool ServiceMatcher::is_in_flight(const Call& call, std::int64_t end_ns, std::int64_t usual_ns) const {
  const std::int64_t client_end_ns = end_of(call.client, end_ns);
  if (call.worked && !call.answered_ns && call.worked_ns.value_or(end_ns) >= client_end_ns) {
    // Nobody works in a process that has ended.
    const ObjectId node = call.service == kNoObject ? kNoObject : model_.services()[call.service].node;
    const auto ended = node == kNoObject ? ended_processes_.end() : ended_processes_.find(model_.nodes()[node].process);
    if (ended == ended_processes_.end() || ended->second >= client_end_ns) {
      return true;
    }
  }
  const std::int64_t begin_ns = call.sent_ns ? *call.sent_ns : call.taken_ns.value_or(0);
  return client_end_ns - begin_ns <= usual_ns;
}

void ServiceMatcher::finish(std::int64_t end_ns) {
  constexpr std::int64_t kAtLeast = 10'000'000;
  std::unordered_map<ObjectId, std::int64_t> longest;  // by client; kNoObject: all that are not in the trace
  for (const auto& [pair, record] : records_) {
    std::int64_t& known = longest.try_emplace(pair.first, kAtLeast).first->second;
    known = std::max(known, (pair.first == kNoObject ? record.service : record.round_trip).summary().max_ns);
  }
  for (const auto& [key, call] : calls_) {
    CallRecord& record = end(call);
    const bool is_open = call.sent_ns ? !call.received_ns : !call.answered_ns && !call.received_ns;
    const auto usual = longest.find(call.client);
    if (is_open && is_in_flight(call, end_ns, usual == longest.end() ? kAtLeast : usual->second)) {
      ++record.in_flight;
    }
  }
  calls_.clear();
  oldest_first_.clear();
}

CallRecord& ServiceMatcher::end(const Call& call) {
  const ServiceCall told{.client = call.client,
                         .service = call.service,
                         .sent_ns = call.sent_ns.value_or(0),
                         .taken_ns = call.taken_ns.value_or(0),
                         .answered_ns = call.answered_ns.value_or(0),
                         .received_ns = call.received_ns.value_or(0)};
  if (call.sent_ns && call.received_ns) {
    sink_.on_call(told);
  } else {
    sink_.on_open_call(told);
  }
  CallRecord& record = records_[{call.client, call.service}];
  ++record.requests;
  if (call.received_ns || (!call.sent_ns && call.answered_ns)) {
    ++record.responses;
  }
  const auto add = [](DurationStatistics& durations, const std::optional<std::int64_t>& from,
                      const std::optional<std::int64_t>& to) {
    if (from && to) {
      durations.add(std::max<std::int64_t>(*to - *from, 0));
    }
  };
  add(record.round_trip, call.sent_ns, call.received_ns);
  add(record.request, call.sent_ns, call.taken_ns);
  add(record.service, call.taken_ns, call.answered_ns);
  add(record.response, call.answered_ns, call.received_ns);
  return record;
}

}  // namespace tracing
