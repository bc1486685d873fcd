// SPDX-License-Identifier: Apache-2.0
// The network of a new network namespace.
#pragma once

namespace launch {

// Brings up lo, allows multicast on it and, unless another device takes it, sends all multicast through it, so
// DDS participants discover each other without any other network. Returns 0, or errno.
int bring_up_loopback(bool other_takes_multicast = false);

}  // namespace launch
