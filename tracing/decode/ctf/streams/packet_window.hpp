// SPDX-License-Identifier: Apache-2.0
// The part of a packet's content that is in memory.
#pragma once

#include <cstddef>
#include <cstdint>

#include "tracing/decode/ctf/packet.hpp"
#include "tracing/decode/ctf/streams/byte_arena.hpp"
#include "tracing/decode/ctf/structure_decoder.hpp"

namespace tracing::ctf {

// Bits count from the beginning of the window. `at` is where the next event begins; who decodes it moves it on.
class PacketWindow {
 public:
  explicit PacketWindow(std::size_t size) : size_(size) {}

  std::uint64_t at = 0;

  // An empty window at the first event. The packet must stay where it is.
  void open(const Packet& packet);
  // The next event is in a new window, whose bytes are there.
  void use(ByteArena& bytes);
  // Goes behind the last event.
  void skip_rest() {
    at = limit_;
    is_last_ = true;
  }

  bool has_more() const { return at < limit_ || !is_last_; }
  const std::uint8_t* begin() const { return begin_; }
  const std::uint8_t* end() const { return end_; }  // of the content, rounded up to bytes
  std::uint64_t limit() const { return limit_; }    // bits
  // Until where nearly all events that begin there are in the window as a whole.
  std::uint64_t safe_limit() const { return is_last_ ? limit_ : limit_ - kMargin * 8; }
  // The window has no event before the safe limit any more, but the packet has.
  bool is_used_up() const { return !is_last_ && limit_ - at < kMargin * 8; }

  // Calls `decode` when the next event is in the window. It throws DamagedPacket where the event goes beyond the
  // window: then it is called again with a larger one, as long as there is more of the packet.
  template <class Decode>
  void with_event(const Decode& decode) {
    if (is_used_up()) {
      move(size_);
    }
    for (std::size_t size = 2 * size_;; size *= 2) {
      try {
        return decode();
      } catch (const DamagedPacket&) {
        if (is_last_ || size > kLargest) {
          throw;
        }
      }
      move(size);
    }
  }

 private:
  static constexpr std::uint64_t kMargin = 4096;      // bytes; longer than nearly all events
  static constexpr std::size_t kLargest = 256 << 20;  // bytes; no event is larger

  // Makes the window begin at the next event, or shortly before it. What was in it stays where it is.
  void move(std::size_t size);

  std::size_t size_;  // bytes
  const Packet* packet_ = nullptr;
  ByteArena* bytes_ = nullptr;
  std::uint64_t offset_ = 0;  // bytes from the beginning of the packet
  bool is_last_ = true;       // the window reaches the end of the content
  const std::uint8_t* begin_ = nullptr;
  const std::uint8_t* end_ = nullptr;
  std::uint64_t limit_ = 0;
};

}  // namespace tracing::ctf
