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

void ServiceMatcher::finish() {
  for (const auto& [key, call] : calls_) {
    end(call);
  }
  calls_.clear();
  oldest_first_.clear();
}

void ServiceMatcher::end(const Call& call) {
  if (call.sent_ns && call.received_ns) {
    sink_.on_call({.client = call.client,
                   .service = call.service,
                   .sent_ns = *call.sent_ns,
                   .taken_ns = call.taken_ns.value_or(0),
                   .answered_ns = call.answered_ns.value_or(0),
                   .received_ns = *call.received_ns});
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
}

}  // namespace tracing
