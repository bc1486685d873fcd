// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/session/held_up_streams.hpp"

#include <algorithm>
#include <cstdlib>
#include <set>
#include <thread>

#include "base/monotonic_clock.hpp"
#include "tracing/record/account/stream_packets.hpp"
#include "tracing/record/lttng/consumer_priority.hpp"
#include "tracing/record/lttng/session_daemon.hpp"
#include "tracing/record/plan/trace_error.hpp"
#include "tracing/record/session/session_listing.hpp"

namespace tracing {
namespace {

constexpr std::chrono::milliseconds kLookInterval{50};

std::uint64_t now() {
  return static_cast<std::uint64_t>(launch::monotonic_time());
}

template <typename Duration>
std::uint64_t nanoseconds(Duration duration) {
  return static_cast<std::uint64_t>(std::chrono::nanoseconds(duration).count());
}

// A clock of the user's own has other times.
bool begins_before(const OpenPacket& packet, const SessionSummary& session) {
  const std::int64_t age = launch::monotonic_time() - static_cast<std::int64_t>(packet.begin);
  const auto since_epoch = std::chrono::system_clock::now().time_since_epoch();
  const auto begin = std::chrono::duration_cast<std::chrono::seconds>(since_epoch - std::chrono::nanoseconds(age));
  return std::getenv("LTTNG_UST_CLOCK_PLUGIN") == nullptr && begin.count() < session.created;
}

}  // namespace

HeldUpStreams::Look HeldUpStreams::look() {
  const std::vector<OpenPacket> open = open_packets(consumers_);
  const std::uint64_t time = now();
  Look look;
  std::map<OpenPacket, Suspicion> still;
  for (const OpenPacket& packet : open) {
    const auto known = suspicions_.find(packet);
    Suspicion suspicion = known != suspicions_.end() ? known->second : Suspicion{.first_seen = time};
    if (!suspicion.told && time - suspicion.first_seen >= nanoseconds(kLongestEvent)) {
      suspicion.told = true;
      suspicion.is_ours = is_ours(packet);
      if (suspicion.is_ours) {
        look.held_up.push_back({.processor = packet.processor, .since = packet.begin, .seen = suspicion.first_seen});
      }
    }
    still.emplace(packet, suspicion);
  }
  for (const auto& [packet, suspicion] : suspicions_) {
    if (suspicion.told && suspicion.is_ours && !still.contains(packet)) {
      look.released.push_back({.processor = packet.processor, .since = packet.begin, .seen = suspicion.first_seen});
    }
  }
  suspicions_ = std::move(still);
  return look;
}

bool HeldUpStreams::is_sure() const {
  return std::all_of(suspicions_.begin(), suspicions_.end(), [](const auto& entry) { return entry.second.told; });
}

bool HeldUpStreams::is_settled() const {
  const std::uint64_t time = now();
  return std::all_of(suspicions_.begin(), suspicions_.end(), [time](const auto& entry) {
    return entry.second.told && time - entry.second.first_seen >= nanoseconds(kLongestDoubt);
  });
}

// The buffers name the trace and not the session. Snapshots and what goes to a relay daemon have no metadata here that
// would join them: then it is the only session without. Buffers of sessions that have ended may still be there.
bool HeldUpStreams::is_ours(const OpenPacket& packet) const {
  bool others_without = false;
  bool is_older = false;
  bool has_metadata = false;
  try {
    for (const SessionSummary& session : list_sessions()) {
      const bool is_here = !session.snapshot && session.path.starts_with('/');
      const std::set<std::string> uuids = is_here ? trace_uuids(session.path) : std::set<std::string>();
      if (uuids.contains(packet.trace)) {
        return session.name == session_;
      }
      if (session.name == session_) {
        has_metadata = !uuids.empty();
        is_older = begins_before(packet, session);
      } else {
        others_without = others_without || uuids.empty();
      }
    }
  } catch (const TraceError&) {
    return false;  // the session daemon has other troubles, which are told
  }
  return !has_metadata && !others_without && !is_older;
}

SessionDetails with_held_up_streams(SessionDetails session) {
  const std::string& name = session.summary.name;
  if (has_buffers_of_processes(name)) {
    return session;
  }
  HeldUpStreams streams(name, consumers_of(session_daemon_pid()));
  const auto look = [&] {
    const std::vector<HeldUpStream> held_up = streams.look().held_up;
    const std::uint64_t time = now();
    for (const HeldUpStream& stream : held_up) {
      double& seconds = session.held_up[stream.processor];
      seconds = std::max(seconds, time > stream.since ? static_cast<double>(time - stream.since) / 1e9 : 0);
    }
  };
  look();
  const std::uint64_t latest = now() + 2 * nanoseconds(HeldUpStreams::kLongestEvent);
  // LTTng tells nobody of an event that was completed.
  while (!streams.is_sure() && now() < latest) {
    std::this_thread::sleep_for(kLookInterval);
    look();
  }
  return session;
}

}  // namespace tracing
