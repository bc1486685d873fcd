// SPDX-License-Identifier: Apache-2.0
// The bytes of rmw_dds_common/msg/ParticipantEntitiesInfo as two generations of ROS 2 write them.
//
// Up to Humble the identity of an endpoint (Gid) has 24 bytes, of which the last eight are zero; later it has 16. The
// names of topic and type are the same, so each side gets the messages of the other one. Only their length tells which
// is which.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "graph/graph_cache.hpp"

namespace rmw_fastrtps {

enum class GidLength : std::size_t { kOfHumble = 24, kOfToday = 16 };

struct ReadEntities {
  GraphCache::EntitiesInfo info;
  GidLength length = GidLength::kOfToday;
};

// `bytes` are a whole serialized message (CDR, any byte order) with its header. nullopt if it is neither.
std::optional<ReadEntities> read_entities(std::span<const std::uint8_t> bytes);

// With a header, in the byte order of this machine.
std::vector<std::uint8_t> write_entities(const GraphCache::EntitiesInfo& info, GidLength length);

}  // namespace rmw_fastrtps
