// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/isolation/tap_device.hpp"

#include <fcntl.h>
#include <linux/if_tun.h>
#include <string.h>
#include <sys/ioctl.h>

#include <cerrno>

#include "base/environment/network_device.hpp"

namespace launch {

namespace {

// 10.77.0.HOST/24. Nothing else is in the namespace, so no other network can have these addresses.
constexpr in_addr_t kNetwork = 0x0a4d0000;
constexpr in_addr_t kMask = 0xffffff00;

bool configure(ifreq& device, unsigned host) {
  const UniqueFd socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (!socket) {
    return false;
  }
  device.ifr_addr = ipv4_address(kNetwork + host);
  if (::ioctl(socket.get(), SIOCSIFADDR, &device) != 0) {
    return false;
  }
  device.ifr_netmask = ipv4_address(kMask);
  return ::ioctl(socket.get(), SIOCSIFNETMASK, &device) == 0 && bring_up(socket.get(), device) &&
         take_multicast(socket.get(), device);
}

}  // namespace

UniqueFd make_tap_device(unsigned host) {
  UniqueFd file(::open("/dev/net/tun", O_RDWR | O_NONBLOCK | O_CLOEXEC));
  ifreq device{};
  ::strcpy(device.ifr_name, "net0");
  device.ifr_flags = IFF_TAP | IFF_NO_PI;
  if (!file || ::ioctl(file.get(), TUNSETIFF, &device) != 0 || !configure(device, host)) {
    const int error = errno;
    file.reset();
    errno = error;
  }
  return file;
}

}  // namespace launch
