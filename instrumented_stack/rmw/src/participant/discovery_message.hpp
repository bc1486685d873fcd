// SPDX-License-Identifier: Apache-2.0
// The messages of discovery, as RTPS has them on the wire (RTPS 2.2, 8.5 and 9.4).
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "fastdds_versions/guid.hpp"

namespace rmw_fastrtps {

struct DiscoveryMessage {
  enum class Kind {
    kAnnouncement,  // of a participant
    kEndOfEndpoint,
    kHeartbeat,  // of one of the writers that announce endpoints
    kQuestion,   // of a reader that has not heard of its writer yet
  };

  Kind kind;
  rtps::GuidPrefix_t sender;
  rtps::GuidPrefix_t receiver;  // unknown: all
  // Ids of entities, as RTPS writes them.
  std::uint32_t writer;
  std::uint32_t reader;  // of a question
  // Of an announcement: the same while the participant says the same. Of a heartbeat: of the last sample.
  std::int64_t sequence_number;
  std::uint32_t count;  // of a heartbeat or question: another one for each
};

// Empty for messages that say anything else. That a participant goes is no announcement.
std::optional<DiscoveryMessage> discovery_message_in(std::span<const std::uint8_t> message);

}  // namespace rmw_fastrtps
