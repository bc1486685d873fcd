// SPDX-License-Identifier: Apache-2.0
#include "participant/discovery_traffic.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "participant/discovery_message.hpp"

namespace rmw_fastrtps {
namespace {

// More are not remembered: Fast DDS then hears everything of the others.
constexpr std::size_t kRemembered = 10'000;

// To whom the calling thread announces; empty for all. The threads of Fast DDS that receive belong to one participant,
// and what they announce is always an answer to the last one that they have discovered.
thread_local std::vector<DiscoveryTraffic::Locator> recipients;

}  // namespace

void DiscoveryTraffic::introduce(const GuidPrefix& self) {
  {
    const std::lock_guard lock(mutex_);
    self_ = self;
  }
  introduced_.store(true, std::memory_order_release);
}

void DiscoveryTraffic::end_endpoints_silently() {
  const std::lock_guard lock(mutex_);
  ends_endpoints_silently_ = true;
}

void DiscoveryTraffic::discovered(const GuidPrefix& participant, std::vector<Locator> locators, Duration lease) {
  recipients = locators;
  const std::lock_guard lock(mutex_);
  if (const auto found = heard_.find(participant); found != heard_.end()) {
    found->second.not_again_within = std::min(kLongestMoment, lease / 4);
    found->second.locators = std::move(locators);
  }
}

void DiscoveryTraffic::gone(const GuidPrefix& participant) {
  const std::lock_guard lock(mutex_);
  heard_.erase(participant);
  std::erase_if(questions_, [&](const auto& question) { return std::get<0>(question.first) == participant; });
}

DiscoveryTraffic::OnlyTo::OnlyTo(DiscoveryTraffic& traffic, const std::vector<GuidPrefix>& participants) {
  const std::lock_guard lock(traffic.mutex_);
  for (const GuidPrefix& participant : participants) {
    if (const auto found = traffic.heard_.find(participant); found != traffic.heard_.end()) {
      const auto& locators = found->second.locators;
      recipients.insert(recipients.end(), locators.begin(), locators.end());
    }
  }
}

DiscoveryTraffic::OnlyTo::~OnlyTo() {
  recipients.clear();
}

void DiscoveryTraffic::restrict(const DiscoveryMessage& message, std::vector<Locator>& destinations, TimePoint now) {
  const std::lock_guard lock(mutex_);
  switch (message.kind) {
    case DiscoveryMessage::Kind::kAnnouncement:
      std::erase_if(destinations, [&](const Locator& locator) {
        return recipients.empty() ? is_told_by_multicast(locator)
                                  : std::find(recipients.begin(), recipients.end(), locator) == recipients.end();
      });
      break;
    case DiscoveryMessage::Kind::kHeartbeat:
      if (destinations.size() > 1 && !is_new(message, now)) {
        destinations.clear();
      }
      break;
    case DiscoveryMessage::Kind::kEndOfEndpoint:
      if (ends_endpoints_silently_) {
        destinations.clear();
      }
      break;
    case DiscoveryMessage::Kind::kQuestion:
      if (!is_due(message, now)) {
        destinations.clear();
      }
      break;
  }
}

// Whoever has this locator is on this host, so multicast reaches it as well as it reaches us.
bool DiscoveryTraffic::is_told_by_multicast(const Locator& locator) const {
  return multicast_works_ && locator.kind == LOCATOR_KIND_SHM;
}

bool DiscoveryTraffic::is_new(const DiscoveryMessage& heartbeat, TimePoint now) {
  Heartbeat& last = heartbeats_[heartbeat.writer];
  if (last.count == heartbeat.count) {
    return true;  // the same one by another transport
  }
  if (last.sequence_number == heartbeat.sequence_number && now - last.at < kBetweenHeartbeats) {
    return false;
  }
  last = {heartbeat.count, heartbeat.sequence_number, now};
  return true;
}

bool DiscoveryTraffic::is_due(const DiscoveryMessage& question, TimePoint now) {
  Question& last = questions_[{question.receiver, question.writer, question.reader}];
  if (last.count == question.count) {
    return true;  // the same one by another transport
  }
  if (now < last.not_before) {
    return false;
  }
  last.count = question.count;
  last.patience = std::clamp(2 * last.patience, kPatience, kLongestPatience);
  last.not_before = now + last.patience;
  return true;
}

bool DiscoveryTraffic::is_heard(const DiscoveryMessage& message, std::int32_t transport_kind, TimePoint now) {
  if (message.kind != DiscoveryMessage::Kind::kAnnouncement) {
    return true;
  }
  const std::lock_guard lock(mutex_);
  if (message.sender == self_) {
    multicast_works_ |= transport_kind == LOCATOR_KIND_UDPv4;
    return false;
  }
  const auto found = heard_.find(message.sender);
  if (found == heard_.end()) {
    if (heard_.size() < kRemembered) {
      heard_[message.sender] = {message.sequence_number, now};
    }
    return true;
  }
  Heard& last = found->second;
  if (last.sequence_number == message.sequence_number && now - last.at < last.not_again_within) {
    return false;
  }
  last.sequence_number = message.sequence_number;
  last.at = now;
  return true;
}

}  // namespace rmw_fastrtps
