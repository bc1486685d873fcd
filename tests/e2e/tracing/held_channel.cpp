// SPDX-License-Identifier: Apache-2.0
// A library to preload: LTTng's thread in the program describes no channel before somebody opens the FIFO that
// HELD_CHANNEL names for writing.
#include <fcntl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>

namespace {

// As LTTng-UST 2.13 tells the session daemon of a channel: the number of the message, then the channel.
constexpr std::uint32_t kChannel = 1;
constexpr std::size_t kChannelSize = 48;

bool describes_channel(const msghdr& message) {
  if (message.msg_iovlen != 1 || message.msg_iov->iov_len != kChannelSize) {
    return false;
  }
  std::uint32_t number = 0;
  std::memcpy(&number, message.msg_iov->iov_base, sizeof number);
  return number == kChannel;
}

}  // namespace

extern "C" ssize_t sendmsg(int socket, const msghdr* message, int flags) {  // NOLINT: the parameters are named in libc
  const char* const fifo = std::getenv("HELD_CHANNEL");
  if (fifo != nullptr && describes_channel(*message)) {
    close(open(fifo, O_RDONLY | O_CLOEXEC));
  }
  return syscall(SYS_sendmsg, socket, message, flags);
}
