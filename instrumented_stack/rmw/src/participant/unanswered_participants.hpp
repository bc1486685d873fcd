// SPDX-License-Identifier: Apache-2.0
// Participants that were discovered and may not have discovered us.
//
// Fast DDS 2.9 announces a participant before it listens: who is quick to answer a new one is not heard. As nobody
// answers the same participant twice, the newcomer would learn of the others at their next periodic announcement, up to
// 3 s later. It has heard of us when it tells its endpoints, which it does without delay; as long as it does not, we
// announce ourselves again.
#pragma once

#include <chrono>
#include <map>
#include <mutex>
#include <optional>

#include "types/gid.hpp"
#include "wait/waitable.hpp"

namespace rmw_fastrtps {

// Thread safe.
class UnansweredParticipants {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;
  using Duration = std::chrono::steady_clock::duration;

  // Patience with a new participant; doubled for each announcement, of which there are at most kAnnouncements, up to
  // the next periodic one. Who then is still silent has no endpoints.
  static constexpr Duration kPatience = std::chrono::milliseconds(100);
  static constexpr int kAnnouncements = 5;

  void discovered(const Gid& participant, TimePoint now);
  // It has told an endpoint, or has gone. `gid` is the participant's or that of any of its endpoints.
  void settled(const Gid& gid);

  // When to announce next, if nothing changes.
  std::optional<TimePoint> next() const;
  // Whether to announce now; each time is told once.
  bool take_due(TimePoint now);

  // Triggered when next() may have become earlier.
  GuardCondition& changed() { return changed_; }

 private:
  struct Silence {
    TimePoint until;
    Duration patience;
    int announcements = 0;
  };

  mutable std::mutex mutex_;
  std::map<Gid, Silence> silent_;
  GuardCondition changed_;
};

}  // namespace rmw_fastrtps
