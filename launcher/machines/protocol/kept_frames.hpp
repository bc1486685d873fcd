// SPDX-License-Identifier: Apache-2.0
// The frames of a connection that may be cut and made again: none is lost, and none comes twice.
//
// Each side numbers the frames that it sends, from 1 on, by their order alone. It keeps them until the other side has
// acknowledged them. After a cut both sides say how many have come, and what has not is sent again. What is about the
// connection itself has no number: it is sent at most once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>

#include "launcher/machines/protocol/agent_protocol.hpp"

namespace launch {

// Whether a frame of this kind has a number.
bool is_numbered(ToAgent kind);
bool is_numbered(FromAgent kind);

// Those that are sent.
class KeptFrames {
 public:
  void add(std::string frame);
  // The other side has got so many. Throws WireError for a number that can't be.
  void acknowledge(std::uint64_t count);

  // Those that have not been acknowledged, in order.
  const std::deque<std::string>& waiting() const { return frames_; }
  std::size_t bytes() const { return bytes_; }

 private:
  std::deque<std::string> frames_;
  std::size_t bytes_ = 0;
  std::uint64_t acknowledged_ = 0;
};

// Those that come.
class ReceivedFrames {
 public:
  void count(std::size_t bytes) {
    ++count_;
    bytes_ += bytes;
  }
  // Whether so much has come that it is to be acknowledged at once, and not only with the next sign of life.
  bool is_much() const { return bytes_ >= kMuch; }
  // Whether something is to be acknowledged.
  bool is_new() const { return count_ != told_; }
  // The number to tell the other side.
  std::uint64_t tell() {
    bytes_ = 0;
    return told_ = count_;
  }

 private:
  static constexpr std::size_t kMuch = 64UL * 1024;

  std::uint64_t count_ = 0;
  std::uint64_t told_ = 0;
  std::size_t bytes_ = 0;  // since the last time
};

}  // namespace launch
