// SPDX-License-Identifier: Apache-2.0
#include "fastdds_versions/transport.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cstddef>
#include <iterator>
#include <vector>

#include "fastdds_versions/shared_memory_layout.hpp"

namespace rmw_fastrtps {

#if RMW_FASTDDS_MAJOR >= 3

namespace {

using Buffers = std::vector<rtps::NetworkBuffer>;

// A library of Fast DDS with statistics ends each message with a submessage for them: its kind, its flags (here the
// order of bytes alone), the number of bytes that follow.
bool ends_with_statistics(const Buffers& message) {
  constexpr std::size_t kHeader = 4;
  constexpr std::uint8_t kStatistics = 0x80;
  constexpr std::uint8_t kLittleEndian = 0x01;
  if (message.size() < 2 || message.back().size < kHeader) {
    return false;
  }
  const auto* bytes = static_cast<const std::uint8_t*>(message.back().buffer);
  const int following = bytes[1] == kLittleEndian ? bytes[2] | bytes[3] << 8 : bytes[3] | bytes[2] << 8;
  return bytes[0] == kStatistics && bytes[1] <= kLittleEndian && kHeader + following == message.back().size;
}

// Fast DDS 3.0, 3.1 up to 3.1.2, and 3.2.0 send no statistics in shared memory, but send as many bytes as if they did
// (mended by its pull request 5742). These are the end of an older message, and the reader takes them for submessages:
// for another participant's acknowledgement, for example, since the words that said to whom it goes are gone. The
// writer then never sends what it takes for acknowledged, such as its endpoints. So statistics are left out before.
struct SenderOfWholeMessages : rtps::SenderResource {
  static void become(rtps::SenderResource& sender) {
    auto& function = sender.*&SenderOfWholeMessages::send_buffers_lambda_;
    function = [send = function](const Buffers& message, std::uint32_t size, rtps::LocatorsIterator* begin,
                                 rtps::LocatorsIterator* end, const std::chrono::steady_clock::time_point& deadline) {
      if (!ends_with_statistics(message)) {
        return send(message, size, begin, end, deadline);
      }
      return send(Buffers(message.begin(), std::prev(message.end())), size - message.back().size, begin, end, deadline);
    };
  }
};

}  // namespace

#endif

bool ForwardingTransport::OpenOutputChannel(rtps::SendResourceList& senders, const rtps::Locator& locator) {
#if RMW_FASTDDS_MAJOR >= 3
  const std::size_t before = senders.size();
  if (!inner_->OpenOutputChannel(senders, locator)) {
    return false;
  }
  for (std::size_t i = before; i < senders.size() && kind() == LOCATOR_KIND_SHM; ++i) {
    SenderOfWholeMessages::become(*senders[i]);
  }
  return true;
#else
  return inner_->OpenOutputChannel(senders, locator);
#endif
}

bool ForwardingTransport::is_reachable(const rtps::Locator& locator) const {
  if (locator.kind != LOCATOR_KIND_SHM) {
    return true;
  }
  struct stat port {};
  return stat(shared_memory_port_file(locator.port).c_str(), &port) == 0 && port.st_uid == geteuid();
}

std::string shared_memory_port_file(std::uint32_t port) {
  return (RMW_FASTDDS_MAJOR >= 3 ? "/dev/shm/fastdds_port" : "/dev/shm/fastrtps_port") +
         std::to_string(shared_memory_file_number(port));
}

}  // namespace rmw_fastrtps
