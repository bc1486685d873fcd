// SPDX-License-Identifier: Apache-2.0
#include "launcher/machines/protocol/kept_frames.hpp"

#include <utility>

namespace launch {

bool is_numbered(ToAgent kind) {
  return kind != ToAgent::kPing && kind != ToAgent::kEnd && kind < ToAgent::kResume;
}

bool is_numbered(FromAgent kind) {
  return kind != FromAgent::kPong && kind != FromAgent::kRefused && kind < FromAgent::kResumed;
}

void KeptFrames::add(std::string frame) {
  bytes_ += frame.size();
  frames_.push_back(std::move(frame));
}

void KeptFrames::acknowledge(std::uint64_t count) {
  if (count < acknowledged_ || count > acknowledged_ + frames_.size()) {
    throw WireError("a number of frames has come that can't be");
  }
  for (; acknowledged_ < count; ++acknowledged_) {
    bytes_ -= frames_.front().size();
    frames_.pop_front();
  }
}

}  // namespace launch
