// SPDX-License-Identifier: Apache-2.0
// A network device whose packets a program carries, as the only way out of a network namespace.
#pragma once

#include "base/files/unique_fd.hpp"

namespace launch {

// Hosts of one network have numbers from 1 to this.
constexpr unsigned kMostTapHosts = 250;

// Makes it in the network namespace of this thread, with an address for this host, and sends all multicast through it.
// Its descriptor reads and writes Ethernet frames and does not block; the device ends with it. Without a value, errno
// says why.
UniqueFd make_tap_device(unsigned host);

}  // namespace launch
