// SPDX-License-Identifier: Apache-2.0
#include "participant/discovery_message.hpp"

#include <algorithm>
#include <cstddef>

namespace rmw_fastrtps {
namespace {

using Bytes = std::span<const std::uint8_t>;
using GuidPrefix = rtps::GuidPrefix_t;

constexpr std::size_t kHeader = 20;
constexpr std::size_t kSenderInHeader = 8;

// Every submessage has a header: its kind, its flags, the number of bytes that follow.
constexpr std::size_t kSubmessageHeader = 4;
enum Submessage : std::uint8_t {
  kAcknack = 0x06,
  kHeartbeat = 0x07,
  kInfoTimestamp = 0x09,
  kInfoDestination = 0x0e,
  kData = 0x15,
};
enum Flag : std::uint8_t { kLittleEndian = 0x01, kFinal = 0x02, kHasData = 0x04 };

// Where a submessage has what.
constexpr std::size_t kDestination = kSubmessageHeader;
constexpr std::size_t kWriterOfData = kSubmessageHeader + 8;
constexpr std::size_t kNumberOfData = kSubmessageHeader + 12;
constexpr std::size_t kWriterOfHeartbeat = kSubmessageHeader + 4;
constexpr std::size_t kLastNumberOfHeartbeat = kSubmessageHeader + 16;
constexpr std::size_t kCountOfHeartbeat = kSubmessageHeader + 24;
constexpr std::size_t kReaderOfAcknack = kSubmessageHeader;
constexpr std::size_t kWriterOfAcknack = kSubmessageHeader + 4;
constexpr std::size_t kFirstNumberOfAcknack = kSubmessageHeader + 8;
constexpr std::size_t kSizeOfAcknackSet = kSubmessageHeader + 16;
constexpr std::size_t kCountOfEmptyAcknack = kSubmessageHeader + 20;
constexpr std::size_t kLeastSize = kSubmessageHeader + 20;  // of the submessages that have a writer

constexpr std::uint32_t kParticipantWriter = 0x000100c2;
constexpr std::uint32_t kPublicationsWriter = 0x000003c2;
constexpr std::uint32_t kSubscriptionsWriter = 0x000004c2;

// A submessage that goes on to the end of the message at most.
class SubmessageView {
 public:
  explicit SubmessageView(Bytes bytes) : bytes_(bytes) {}

  std::uint8_t kind() const { return bytes_[0]; }
  bool has(Flag flag) const { return (bytes_[1] & flag) != 0; }
  std::size_t size() const { return kSubmessageHeader + number(2, 2, has(kLittleEndian)); }
  bool is_complete() const { return bytes_.size() >= kLeastSize; }

  std::uint32_t entity(std::size_t at) const { return number(at, 4, false); }
  std::uint32_t number(std::size_t at) const { return number(at, 4, has(kLittleEndian)); }
  std::int64_t sequence_number(std::size_t at) const { return std::int64_t{number(at)} << 32 | number(at + 4); }
  void copy_to(GuidPrefix& prefix, std::size_t at) const {
    const Bytes bytes = bytes_.subspan(std::min(at, bytes_.size()));
    std::copy_n(bytes.begin(), std::min(bytes.size(), std::size(prefix.value)), std::begin(prefix.value));
  }

 private:
  // 0 for what is missing.
  std::uint32_t number(std::size_t at, std::size_t size, bool little_endian) const {
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < size && at + i < bytes_.size(); ++i) {
      number |= std::uint32_t{bytes_[at + i]} << 8 * (little_endian ? i : size - 1 - i);
    }
    return number;
  }

  Bytes bytes_;
};

bool announces_endpoints(std::uint32_t writer) {
  return writer == kPublicationsWriter || writer == kSubscriptionsWriter;
}

// Sets the kind and what belongs to it. False for submessages of other kinds.
bool read(const SubmessageView& submessage, DiscoveryMessage& message) {
  using Kind = DiscoveryMessage::Kind;
  if (!submessage.is_complete()) {
    return false;
  }
  switch (submessage.kind()) {
    case kData:
      // That something ends is told without data.
      message.writer = submessage.entity(kWriterOfData);
      message.sequence_number = submessage.sequence_number(kNumberOfData);
      message.kind = submessage.has(kHasData) ? Kind::kAnnouncement : Kind::kEndOfEndpoint;
      return submessage.has(kHasData) ? message.writer == kParticipantWriter : announces_endpoints(message.writer);
    case kHeartbeat:
      message.kind = Kind::kHeartbeat;
      message.writer = submessage.entity(kWriterOfHeartbeat);
      message.sequence_number = submessage.sequence_number(kLastNumberOfHeartbeat);
      message.count = submessage.number(kCountOfHeartbeat);
      return announces_endpoints(message.writer);
    case kAcknack:
      message.kind = Kind::kQuestion;
      message.reader = submessage.entity(kReaderOfAcknack);
      message.writer = submessage.entity(kWriterOfAcknack);
      message.count = submessage.number(kCountOfEmptyAcknack);
      return !submessage.has(kFinal) && submessage.sequence_number(kFirstNumberOfAcknack) == 0 &&
             submessage.number(kSizeOfAcknackSet) == 0;
    default:
      return false;
  }
}

}  // namespace

std::optional<DiscoveryMessage> discovery_message_in(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kHeader) {
    return std::nullopt;
  }
  DiscoveryMessage message{};
  std::copy_n(bytes.begin() + kSenderInHeader, std::size(message.sender.value), std::begin(message.sender.value));
  for (Bytes rest = bytes.subspan(kHeader); rest.size() >= kSubmessageHeader;) {
    const SubmessageView submessage(rest);
    if (submessage.kind() == kInfoDestination) {
      submessage.copy_to(message.receiver, kDestination);
    } else if (submessage.kind() != kInfoTimestamp) {
      return read(submessage, message) ? std::optional(message) : std::nullopt;
    }
    rest = rest.subspan(std::min(submessage.size(), rest.size()));
  }
  return std::nullopt;
}

}  // namespace rmw_fastrtps
