// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/kernel/ring_page.hpp"

namespace tracing::kernel {

namespace {

constexpr std::size_t kHeaderSize = 16;  // a time stamp and the number of committed bytes, 64 bits each
constexpr std::uint64_t kMissedEvents = std::uint64_t{1} << 31;
constexpr std::uint64_t kMissedStored = std::uint64_t{1} << 30;
constexpr std::uint64_t kCommittedBytes = (std::uint64_t{1} << 20) - 1;

// Record types. A smaller type is the length of the data in words; with type 0 the first word has the length.
constexpr std::uint32_t kPadding = 29;
constexpr std::uint32_t kTimeExtend = 30;
constexpr std::uint32_t kTimeStamp = 31;
constexpr unsigned kTimeBits = 27;
constexpr std::uint64_t kTopTimeBits = ~((std::uint64_t{1} << 59) - 1);  // an absolute time stamp has 59 bits

}  // namespace

RingPage read_ring_page(std::span<const std::uint8_t> page,
                        const std::function<void(std::uint64_t, std::span<const std::uint8_t>)>& record) {
  RingPage read;
  if (page.size() < kHeaderSize) {
    return read;
  }
  std::uint64_t time = load<std::uint64_t>(page, 0);
  const auto commit = load<std::uint64_t>(page, 8);
  const std::size_t committed = commit & kCommittedBytes;
  if ((commit & kMissedEvents) != 0) {
    read.lost_records = (commit & kMissedStored) != 0 ? load<std::uint64_t>(page, kHeaderSize + committed) : 1;
  }
  const std::span<const std::uint8_t> data = page.subspan(kHeaderSize, std::min(committed, page.size() - kHeaderSize));
  read.begin = read.end = time;
  bool first = true;
  for (std::size_t at = 0; at + sizeof(std::uint32_t) <= data.size();) {
    const auto header = load<std::uint32_t>(data, at);
    const std::uint32_t type = header & 31;
    const std::uint64_t delta = header >> 5;
    const auto word = load<std::uint32_t>(data, at + 4);
    at += sizeof header;
    if (type == kPadding) {
      if (delta == 0) {
        break;  // padding to the end of the page
      }
      at += word;
      time += delta;
      continue;
    }
    if (type == kTimeExtend) {
      time += delta + (std::uint64_t{word} << kTimeBits);
      at += sizeof word;
      continue;
    }
    if (type == kTimeStamp) {
      time = (time & kTopTimeBits) | (std::uint64_t{word} << kTimeBits) | delta;
      at += sizeof word;
      continue;
    }
    time += delta;
    // With type 0 the first word is the length of the data, itself included.
    const std::size_t begin = type == 0 ? at + sizeof word : at;
    const std::size_t length = type == 0 ? word - sizeof word : std::size_t{type} * 4;
    if (type == 0 && word < sizeof word) {
      break;
    }
    if (begin + length > data.size()) {
      break;
    }
    if (first) {
      read.begin = time;
    }
    first = false;
    read.end = time;
    record(time, data.subspan(begin, length));
    at = begin + length;
  }
  return read;
}

bool forget_lost_records(std::span<std::uint8_t> page) {
  auto commit = load<std::uint64_t>(page, 8);
  if (page.size() < kHeaderSize || (commit & kMissedEvents) == 0) {
    return false;
  }
  commit &= ~(kMissedEvents | kMissedStored);
  std::memcpy(page.data() + 8, &commit, sizeof commit);
  return true;
}

}  // namespace tracing::kernel
