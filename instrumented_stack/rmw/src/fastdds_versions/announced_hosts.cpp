// SPDX-License-Identifier: Apache-2.0
// Finds locators in the bytes of announcements (DDSI-RTPS 2.2: 8.3.3 messages, 9.4.2.11 lists of parameters).
#include <algorithm>
#include <array>

#include "fastdds_versions/separate_memory.hpp"

namespace rmw_fastrtps {

namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::size_t kShortHeader = 4;  // of a submessage, of the data in it, of a parameter

// 0 for what is missing.
std::uint32_t number(Bytes bytes, std::size_t at, std::size_t size, bool little_endian) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < size && at + i < bytes.size(); ++i) {
    number |= std::uint32_t{bytes[at + i]} << 8 * (little_endian ? i : size - 1 - i);
  }
  return number;
}

// Of participants, of publications and subscriptions.
bool is_writer_of_announcements(std::uint32_t entity) {
  return entity == 0x000100c2 || entity == 0x000003c2 || entity == 0x000004c2;
}

bool is_locator(std::uint32_t parameter) {
  constexpr std::array<std::uint32_t, 6> kLocators = {0x2f, 0x30, 0x31, 0x32, 0x33, 0x48};
  return std::find(kLocators.begin(), kLocators.end(), parameter) != kLocators.end();
}

// Goes through the list of parameters at `at`. Returns where it ends.
std::size_t find_in_parameters(Bytes bytes, std::size_t at, bool little_endian, std::vector<std::size_t>* hosts) {
  constexpr std::uint32_t kEnd = 1;
  constexpr std::size_t kLocator = 24;  // kind, port, address
  constexpr std::size_t kHost = 9;      // in it: behind the first byte of the address
  while (at + kShortHeader <= bytes.size()) {
    const std::uint32_t parameter = number(bytes, at, 2, little_endian);
    const std::size_t size = number(bytes, at + 2, 2, little_endian);
    const std::size_t value = at + kShortHeader;
    if (parameter == kEnd) {
      return value;
    }
    const bool is_whole = size >= kLocator && value + kLocator <= bytes.size();
    if (hosts != nullptr && is_whole && is_locator(parameter) &&
        number(bytes, value, 4, little_endian) == LOCATOR_KIND_SHM) {
      hosts->push_back(value + kHost);
    }
    at = value + size;
  }
  return bytes.size();
}

// `data`: all of the message up to the end of the submessage, which begins at `at`.
void find_in_data(Bytes data, std::size_t at, std::vector<std::size_t>& hosts) {
  constexpr std::uint8_t kLittleEndian = 0x01;
  constexpr std::uint8_t kInlineQos = 0x02;
  constexpr std::uint8_t kHasData = 0x04;
  constexpr std::size_t kBehindOffset = kShortHeader + 4;
  constexpr std::size_t kWriter = kShortHeader + 8;
  if (at + kWriter + 4 > data.size() || !is_writer_of_announcements(number(data, at + kWriter, 4, false))) {
    return;
  }
  const std::uint8_t flags = data[at + 1];
  const bool little_endian = (flags & kLittleEndian) != 0;
  std::size_t place = at + kBehindOffset + number(data, at + kBehindOffset - 2, 2, little_endian);
  if ((flags & kInlineQos) != 0) {
    place = find_in_parameters(data, place, little_endian, nullptr);
  }
  if ((flags & kHasData) == 0 || place + kShortHeader > data.size()) {
    return;
  }
  constexpr std::uint8_t kParametersLittleEndian = 0x03;
  find_in_parameters(data, place + kShortHeader, data[place + 1] == kParametersLittleEndian, &hosts);
}

}  // namespace

std::vector<std::size_t> announced_hosts(Bytes message) {
  constexpr std::size_t kMessageHeader = 20;
  constexpr std::uint8_t kPad = 0x01;
  constexpr std::uint8_t kInfoTimestamp = 0x09;
  constexpr std::uint8_t kData = 0x15;
  std::vector<std::size_t> hosts;
  for (std::size_t at = kMessageHeader; at + kShortHeader <= message.size();) {
    const std::size_t size = number(message, at + 2, 2, (message[at + 1] & 1) != 0);
    // The last submessage may leave its size to the message. Two kinds may be empty.
    const bool goes_to_the_end = size == 0 && message[at] != kPad && message[at] != kInfoTimestamp;
    const std::size_t end = goes_to_the_end ? message.size() : std::min(at + kShortHeader + size, message.size());
    if (message[at] == kData) {
      find_in_data(message.first(end), at, hosts);
    }
    at = end;
  }
  return hosts;
}

}  // namespace rmw_fastrtps
