// SPDX-License-Identifier: Apache-2.0
#include "base/environment/network_device.hpp"

#include <net/route.h>
#include <string.h>
#include <sys/ioctl.h>

#include <cerrno>

#include "base/files/unique_fd.hpp"

namespace launch {

sockaddr ipv4_address(in_addr_t address) {
  sockaddr_in specific{};
  specific.sin_family = AF_INET;
  specific.sin_addr.s_addr = htonl(address);
  sockaddr generic{};
  ::memcpy(&generic, &specific, sizeof generic);
  return generic;
}

bool bring_up(int socket, ifreq& device) {
  if (::ioctl(socket, SIOCGIFFLAGS, &device) != 0) {
    return false;
  }
  device.ifr_flags = static_cast<short>(device.ifr_flags | IFF_UP | IFF_RUNNING | IFF_MULTICAST);
  return ::ioctl(socket, SIOCSIFFLAGS, &device) == 0;
}

bool take_multicast(int socket, ifreq& device) {
  rtentry route{};
  route.rt_dst = ipv4_address(0xe0000000);      // 224.0.0.0
  route.rt_genmask = ipv4_address(0xf0000000);  // 240.0.0.0
  route.rt_flags = RTF_UP;
  route.rt_dev = device.ifr_name;
  return ::ioctl(socket, SIOCADDRT, &route) == 0 || errno == EEXIST;
}

int bring_up_loopback(bool other_takes_multicast) {
  const UniqueFd socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  ifreq interface {};
  ::strcpy(interface.ifr_name, "lo");
  const bool is_up =
      socket && bring_up(socket.get(), interface) && (other_takes_multicast || take_multicast(socket.get(), interface));
  return is_up ? 0 : errno;
}

}  // namespace launch
