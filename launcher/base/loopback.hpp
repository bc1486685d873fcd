// SPDX-License-Identifier: Apache-2.0
// The network of a new network namespace.
#pragma once

namespace launch {

// Brings up lo, allows multicast on it and sends all multicast through it, so DDS participants discover each other
// without any other network. Returns 0, or errno.
int bring_up_loopback();

}  // namespace launch
