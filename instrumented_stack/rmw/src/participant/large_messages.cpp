// SPDX-License-Identifier: Apache-2.0
#include "participant/large_messages.hpp"

#include <sys/statvfs.h>

#include <algorithm>

#include "fastdds_versions/separate_memory.hpp"

namespace rmw_fastrtps {
namespace {

// That of Fast DDS, which the participant has for all other messages.
constexpr std::uint64_t kSmallSegment = 512 * 1024;

// Where /dev/shm is small, as in containers, a few participants must not fill it.
std::uint32_t segment_size() {
  constexpr std::uint64_t kMost = 32 * 1024 * 1024;
  constexpr std::uint64_t kShare = 16;
  struct statvfs room {};
  if (statvfs("/dev/shm", &room) != 0 || room.f_blocks == 0) {
    return kSmallSegment;
  }
  const std::uint64_t free = std::uint64_t{room.f_bavail} * room.f_frsize;
  return static_cast<std::uint32_t>(std::clamp(free / kShare, kSmallSegment, kMost));
}

}  // namespace

LargeMessages::~LargeMessages() {
  senders_.clear();
  if (transport_ != nullptr) {
    transport_->shutdown();
  }
}

rtps::SenderResource* LargeMessages::sender(std::vector<rtps::Locator>& destinations) {
  std::erase_if(destinations, [](const rtps::Locator& locator) { return locator.kind != LOCATOR_KIND_SHM; });
  if (destinations.empty()) {
    return nullptr;
  }
  const std::lock_guard lock(mutex_);
  if (!has_begun_) {
    has_begun_ = true;
    begin(destinations.front());
  }
  return senders_.empty() ? nullptr : senders_.front().get();
}

void LargeMessages::begin(const rtps::Locator& destination) {
  const std::uint32_t size = segment_size();
  if (size <= kSmallSegment) {
    return;
  }
  rtps::SharedMemTransportDescriptor descriptor;
  descriptor.max_message_size(largest_message_);
  descriptor.segment_size(size);
  transport_ = std::make_unique<ForwardingTransport>(
      with_separate_memory(std::unique_ptr<rtps::TransportInterface>(descriptor.create_transport())));
  // One sender is for all destinations.
  if (!transport_->init() || !transport_->OpenOutputChannel(senders_, destination)) {
    senders_.clear();
  }
}

}  // namespace rmw_fastrtps
