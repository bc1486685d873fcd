// SPDX-License-Identifier: Apache-2.0
// What a participant tells and hears of participants, as its transports see it.
//
// Fast DDS 2.9 tells more than anybody needs: who discovers a newcomer announces itself to all whom it knows, and to
// the multicast groups, instead of the newcomer alone. So the number of announcements in a starting system grows with
// the third power of its size. Each of them arrives by every network interface and by shared memory. Therefore an
// answer is for the newcomer only, and what was heard a moment ago is not heard again.
//
// Fast DDS announces a participant as soon as it is enabled: before it listens, and without any endpoints. Therefore no
// message passes until the participant is introduced.
//
// A writer asks all its readers for an acknowledgement when it has resent enough to one of them, and a reader asks a
// writer fourteen times a second until the writer has said something. On a busy machine the questions are most of what
// there is to answer. So they are asked less often.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <map>
#include <mutex>
#include <tuple>
#include <vector>

#include "fastdds_versions/guid.hpp"
#include "participant/discovery_message.hpp"

namespace rmw_fastrtps {

// The traffic of one participant. Thread safe.
class DiscoveryTraffic {
 public:
  using Locator = eprosima::fastdds::rtps::Locator;
  using GuidPrefix = rtps::GuidPrefix_t;
  using TimePoint = std::chrono::steady_clock::time_point;
  using Duration = std::chrono::steady_clock::duration;

  // From now on messages may pass. Its own announcements come back by multicast; they are not heard.
  void introduce(const GuidPrefix& self);
  bool is_introduced() const { return introduced_.load(std::memory_order_acquire); }

  // From now on nothing is told of endpoints that end.
  void end_endpoints_silently();

  // Fast DDS's thread has discovered a participant and is about to answer. What the calling thread announces from now
  // on goes to these locators only; all if there are none. An announcement that is repeated is heard often enough to
  // keep the lease.
  void discovered(const GuidPrefix& participant, std::vector<Locator> locators, Duration lease);
  void gone(const GuidPrefix& participant);

  // Until its end, what the calling thread announces goes to these participants only, as far as they are known.
  class OnlyTo {
   public:
    OnlyTo(DiscoveryTraffic& traffic, const std::vector<GuidPrefix>& participants);
    ~OnlyTo();
    OnlyTo(const OnlyTo&) = delete;
    OnlyTo& operator=(const OnlyTo&) = delete;
  };

  // Takes away the destinations that an outgoing message is needless for.
  void restrict(const DiscoveryMessage& message, std::vector<Locator>& destinations, TimePoint now);

  // Whether Fast DDS gets a message that has arrived by this kind of transport.
  bool is_heard(const DiscoveryMessage& message, std::int32_t transport_kind, TimePoint now);

 private:
  struct Heard {
    std::int64_t sequence_number = 0;
    TimePoint at{};
    Duration not_again_within = kMoment;
    std::vector<Locator> locators{};
  };

  struct Heartbeat {
    std::uint32_t count = 0;
    std::int64_t sequence_number = 0;
    TimePoint at{};
  };

  struct Question {
    std::uint32_t count = 0;
    TimePoint not_before{};
    Duration patience{};
  };

  bool is_told_by_multicast(const Locator& locator) const;
  bool is_new(const DiscoveryMessage& heartbeat, TimePoint now);
  bool is_due(const DiscoveryMessage& question, TimePoint now);

  static constexpr Duration kMoment = std::chrono::milliseconds(50);
  static constexpr Duration kLongestMoment = std::chrono::seconds(1);
  static constexpr Duration kBetweenHeartbeats = std::chrono::milliseconds(500);
  static constexpr Duration kPatience = std::chrono::milliseconds(150);
  static constexpr Duration kLongestPatience = std::chrono::seconds(1);

  std::atomic<bool> introduced_{false};
  std::mutex mutex_;
  GuidPrefix self_;
  bool multicast_works_ = false;
  bool ends_endpoints_silently_ = false;
  std::map<GuidPrefix, Heard> heard_;
  std::map<std::uint32_t, Heartbeat> heartbeats_;                                       // by writer
  std::map<std::tuple<GuidPrefix, std::uint32_t, std::uint32_t>, Question> questions_;  // by receiver, writer, reader
};

}  // namespace rmw_fastrtps
