// SPDX-License-Identifier: Apache-2.0
#include "participant/unanswered_participants.hpp"

#include <algorithm>

namespace rmw_fastrtps {

void UnansweredParticipants::discovered(const Gid& participant, TimePoint now) {
  {
    const std::lock_guard lock(mutex_);
    silent_.insert_or_assign(participant, Silence{now + kPatience, kPatience});
  }
  changed_.trigger();
}

void UnansweredParticipants::settled(const Gid& gid) {
  const std::lock_guard lock(mutex_);
  std::erase_if(silent_, [&](const auto& entry) { return same_participant(entry.first, gid); });
}

std::optional<UnansweredParticipants::TimePoint> UnansweredParticipants::next() const {
  const std::lock_guard lock(mutex_);
  const auto first = std::min_element(silent_.begin(), silent_.end(),
                                      [](const auto& a, const auto& b) { return a.second.until < b.second.until; });
  return first == silent_.end() ? std::nullopt : std::optional(first->second.until);
}

std::vector<Gid> UnansweredParticipants::take_due(TimePoint now) {
  const std::lock_guard lock(mutex_);
  std::vector<Gid> due;
  for (auto& [gid, silence] : silent_) {
    if (silence.until <= now) {
      due.push_back(gid);
      silence.patience *= 2;
      silence.until = now + silence.patience;
      ++silence.announcements;
    }
  }
  std::erase_if(silent_, [](const auto& entry) { return entry.second.announcements == kAnnouncements; });
  return due;
}

}  // namespace rmw_fastrtps
