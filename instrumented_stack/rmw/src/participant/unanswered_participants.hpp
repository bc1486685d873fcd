// SPDX-License-Identifier: Apache-2.0
// Participants that we discovered and that may not have discovered us.
//
// Fast DDS 2.9 announces a participant before it listens. So it misses a quick answer to its announcement. A
// participant is answered only once: the newcomer would discover the others only at their next periodic announcement,
// up to 3 s later. A newcomer that has heard of us announces its endpoints without delay. Until it does, we repeat our
// announcement.
#pragma once

#include <chrono>
#include <map>
#include <mutex>
#include <optional>
#include <vector>

#include "types/gid.hpp"
#include "wait/waitable.hpp"

namespace rmw_fastrtps {

// Thread safe.
class UnansweredParticipants {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;
  using Duration = std::chrono::steady_clock::duration;

  // How long to wait for a new participant. The time doubles with each announcement. After kAnnouncements of them comes
  // the next periodic one. A participant that is still silent then has no endpoints.
  static constexpr Duration kPatience = std::chrono::milliseconds(100);
  static constexpr int kAnnouncements = 5;

  void discovered(const Gid& participant, TimePoint now);
  // It has announced an endpoint, or is gone. `gid` is the participant's or that of any of its endpoints.
  void settled(const Gid& gid);

  // The time of the next announcement, if nothing changes.
  std::optional<TimePoint> next() const;
  // To whom to announce now. Names each of them once for each time.
  std::vector<Gid> take_due(TimePoint now);

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
