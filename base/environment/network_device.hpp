// SPDX-License-Identifier: Apache-2.0
// What a device of a new network namespace needs before DDS participants use it.
#pragma once

#include <net/if.h>
#include <netinet/in.h>
#include <sys/socket.h>

namespace launch {

// The address is in the byte order of the machine: 0x7f000001 is 127.0.0.1.
sockaddr ipv4_address(in_addr_t address);

// Brings the device of that name up and allows multicast on it. `socket` is any socket of the namespace. False, with
// errno, if it is not possible.
bool bring_up(int socket, ifreq& device);
// Sends all multicast through the device. Returns as bring_up(), true also if multicast has a way already.
bool take_multicast(int socket, ifreq& device);

// Brings up lo, allows multicast on it and, unless another device takes it, sends all multicast through it, so
// DDS participants discover each other without any other network. Returns 0, or errno.
int bring_up_loopback(bool other_takes_multicast = false);

}  // namespace launch
