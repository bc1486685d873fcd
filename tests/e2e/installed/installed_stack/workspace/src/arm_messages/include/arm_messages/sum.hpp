// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "arm_messages/msg/distance.hpp"
#include "arm_messages/msg/reach.hpp"

namespace arm_messages {
msg::Distance sum(const msg::Reach& reach);
}
