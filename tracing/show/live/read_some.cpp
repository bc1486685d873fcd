// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/live/read_some.hpp"

#include <cstddef>

namespace tracing {

LiveReader::State read_some(LiveReader& reader, TraceSink& sink) {
  constexpr std::size_t kMostItems = 4096;
  TraceItem item;
  for (std::size_t i = 0; i < kMostItems; ++i) {
    const LiveReader::State state = reader.next(item);
    if (state != LiveReader::State::kItem) {
      return state;
    }
    if (item.event != nullptr) {
      sink.on_event(*item.event);
    } else {
      sink.on_loss(*item.loss);
    }
  }
  return LiveReader::State::kItem;
}

}  // namespace tracing
