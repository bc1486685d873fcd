// SPDX-License-Identifier: Apache-2.0
#include "launcher/base/environment/loopback.hpp"

#include <net/if.h>
#include <net/route.h>
#include <netinet/in.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include <cerrno>

#include "launcher/base/files/unique_fd.hpp"

namespace launch {
namespace {

sockaddr ipv4(in_addr_t address) {
  sockaddr_in specific{};
  specific.sin_family = AF_INET;
  specific.sin_addr.s_addr = htonl(address);
  sockaddr generic{};
  ::memcpy(&generic, &specific, sizeof generic);
  return generic;
}

}  // namespace

int bring_up_loopback(bool other_takes_multicast) {
  const UniqueFd socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  ifreq interface {};
  ::strcpy(interface.ifr_name, "lo");
  if (!socket || ::ioctl(socket.get(), SIOCGIFFLAGS, &interface) != 0) {
    return errno;
  }
  interface.ifr_flags = static_cast<short>(interface.ifr_flags | IFF_UP | IFF_RUNNING | IFF_MULTICAST);
  if (::ioctl(socket.get(), SIOCSIFFLAGS, &interface) != 0) {
    return errno;
  }
  if (other_takes_multicast) {
    return 0;
  }
  rtentry route{};
  route.rt_dst = ipv4(0xe0000000);      // 224.0.0.0
  route.rt_genmask = ipv4(0xf0000000);  // 240.0.0.0
  route.rt_flags = RTF_UP;
  route.rt_dev = interface.ifr_name;
  return ::ioctl(socket.get(), SIOCADDRT, &route) == 0 || errno == EEXIST ? 0 : errno;
}

}  // namespace launch
