// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/ctf/streams/general_event.hpp"

#include <string_view>
#include <vector>

namespace tracing::ctf {

GeneralEvent decode_general_event(const StreamLayout& stream, const EventLayout& event, const std::uint8_t* begin,
                                  std::uint64_t bit, std::uint64_t limit, FieldArena& arena) {
  struct Part {
    const StructureDecoder& decoder;
    std::string_view path;
  };
  const Part parts[] = {{stream.event_context(), "stream.event.context"},
                        {event.context, "event.context"},
                        {event.payload, "event.fields"}};
  GeneralEvent result;
  std::array<Field, 3> structures;
  std::vector<FieldScope> scopes;
  for (std::size_t i = 0; i < structures.size(); ++i) {
    if (parts[i].decoder.type() == nullptr) {
      continue;
    }
    structures[i] = decode_structure(*parts[i].decoder.type(), begin, bit, limit, scopes, arena, bit);
    result.members[i] = structures[i].children;
    scopes.push_back({parts[i].path, &structures[i]});
  }
  result.end = bit;
  return result;
}

}  // namespace tracing::ctf
