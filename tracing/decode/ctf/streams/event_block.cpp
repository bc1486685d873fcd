// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/ctf/streams/event_block.hpp"

namespace tracing::ctf {

void EventBlock::clear() {
  bytes.reset();
  count = 0;
  places.clear();
  fields.reset();
  others.clear();
  losses.clear();
  damages.clear();
  is_last = false;
  error = nullptr;
}

}  // namespace tracing::ctf
