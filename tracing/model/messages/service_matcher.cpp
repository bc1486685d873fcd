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

void ServiceMatcher::send_request(ObjectId client, const ros2::Gid& gid, std::int64_t sequence_number,
                                  std::int64_t time_ns) {
  const Key key{gid, sequence_number};
  Call& call = begin(key);
  call.client = client;
  call.sent_ns = time_ns;
  if (call.received_ns) {
    end_now(key);
  }
}

void ServiceMatcher::take_request(ObjectId service, const ros2::Gid& gid, std::int64_t sequence_number,
                                  std::int64_t time_ns) {
  Call& call = begin({gid, sequence_number});
  if (call.taken_ns) {
    return;
  }
  call.service = service;
  call.taken_ns = time_ns;
}

void ServiceMatcher::send_response(ObjectId service, const ros2::Gid& gid, std::int64_t sequence_number,
                                   std::int64_t time_ns) {
  const auto call = calls_.find({gid, sequence_number});
  if (call == calls_.end() || call->second.service != service || call->second.answered_ns) {
    return;
  }
  call->second.answered_ns = time_ns;
}

void ServiceMatcher::take_response(const ros2::Gid& gid, std::int64_t sequence_number, std::int64_t time_ns) {
  const Key key{gid, sequence_number};
  const auto call = calls_.find(key);
  if (call == calls_.end()) {
    return;
  }
  call->second.received_ns = time_ns;
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
  if (sink_ != nullptr && call.sent_ns && call.received_ns) {
    sink_->on_call({.client = call.client,
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
