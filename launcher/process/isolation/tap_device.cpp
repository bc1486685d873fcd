// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/isolation/tap_device.hpp"

#include <fcntl.h>
#include <linux/if_tun.h>
#include <net/if.h>
#include <net/route.h>
#include <netinet/in.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include <cerrno>

namespace launch {

namespace {

sockaddr ipv4_address(in_addr_t address) {
  sockaddr_in specific{};
  specific.sin_family = AF_INET;
  specific.sin_addr.s_addr = htonl(address);
  sockaddr generic{};
  ::memcpy(&generic, &specific, sizeof generic);
  return generic;
}

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
  if (::ioctl(socket.get(), SIOCSIFNETMASK, &device) != 0 || ::ioctl(socket.get(), SIOCGIFFLAGS, &device) != 0) {
    return false;
  }
  device.ifr_flags = static_cast<short>(device.ifr_flags | IFF_UP | IFF_RUNNING | IFF_MULTICAST);
  if (::ioctl(socket.get(), SIOCSIFFLAGS, &device) != 0) {
    return false;
  }
  rtentry route{};
  route.rt_dst = ipv4_address(0xe0000000);      // 224.0.0.0
  route.rt_genmask = ipv4_address(0xf0000000);  // 240.0.0.0
  route.rt_flags = RTF_UP;
  route.rt_dev = device.ifr_name;
  return ::ioctl(socket.get(), SIOCADDRT, &route) == 0 || errno == EEXIST;
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
