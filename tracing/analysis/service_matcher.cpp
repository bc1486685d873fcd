#include "tracing/analysis/service_matcher.hpp"

#include <cstring>

namespace tracing {

std::size_t ServiceMatcher::HashKey::operator()(const Key& key) const {
  std::uint64_t words[3];
  static_assert(sizeof words == sizeof key.gid.bytes);
  std::memcpy(words, key.gid.bytes.data(), sizeof words);
  std::uint64_t hash = static_cast<std::uint64_t>(key.sequence_number);
  for (const std::uint64_t word : words) hash = (hash ^ word) * 0x9e3779b97f4a7c15;
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
        end(oldest->second, std::nullopt);
        calls_.erase(oldest);
      }
    }
  }
  return found->second;
}

void ServiceMatcher::send_request(ObjectId client, const ros2::Gid& gid, std::int64_t sequence_number,
                                  std::int64_t time_ns) {
  Call& call = begin({gid, sequence_number});
  call = {client, kNoObject, time_ns, std::nullopt, std::nullopt};
}

void ServiceMatcher::take_request(ObjectId service, const ros2::Gid& gid, std::int64_t sequence_number,
                                  std::int64_t time_ns) {
  Call& call = begin({gid, sequence_number});
  if (call.taken_ns) return;
  call.service = service;
  call.taken_ns = time_ns;
}

void ServiceMatcher::send_response(ObjectId service, const ros2::Gid& gid, std::int64_t sequence_number,
                                   std::int64_t time_ns) {
  const auto call = calls_.find({gid, sequence_number});
  if (call == calls_.end() || call->second.service != service || call->second.answered_ns) return;
  call->second.answered_ns = time_ns;
  if (call->second.sent_ns) return;  // goes on at the client
  end(call->second, std::nullopt);
  calls_.erase(call);
}

void ServiceMatcher::take_response(const ros2::Gid& gid, std::int64_t sequence_number, std::int64_t time_ns) {
  const auto call = calls_.find({gid, sequence_number});
  if (call == calls_.end()) return;
  end(call->second, time_ns);
  calls_.erase(call);
}

void ServiceMatcher::finish() {
  for (const auto& [key, call] : calls_) end(call, std::nullopt);
  calls_.clear();
  oldest_first_.clear();
}

void ServiceMatcher::end(const Call& call, std::optional<std::int64_t> response_taken_ns) {
  CallRecord& record = records_[{call.client, call.service}];
  ++record.requests;
  if (response_taken_ns || (!call.sent_ns && call.answered_ns)) ++record.responses;
  const auto add = [](DurationStatistics& durations, const std::optional<std::int64_t>& from,
                      const std::optional<std::int64_t>& to) {
    if (from && to) durations.add(*to - *from);
  };
  add(record.round_trip, call.sent_ns, response_taken_ns);
  add(record.request, call.sent_ns, call.taken_ns);
  add(record.service, call.taken_ns, call.answered_ns);
  add(record.response, call.answered_ns, response_taken_ns);
}

}  // namespace tracing
