// SPDX-License-Identifier: Apache-2.0
#include "base/environment/loopback.hpp"

#include <string.h>

#include <cerrno>

#include "base/environment/network_device.hpp"
#include "base/files/unique_fd.hpp"

namespace launch {

int bring_up_loopback(bool other_takes_multicast) {
  const UniqueFd socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  ifreq interface {};
  ::strcpy(interface.ifr_name, "lo");
  const bool is_up =
      socket && bring_up(socket.get(), interface) && (other_takes_multicast || take_multicast(socket.get(), interface));
  return is_up ? 0 : errno;
}

}  // namespace launch
