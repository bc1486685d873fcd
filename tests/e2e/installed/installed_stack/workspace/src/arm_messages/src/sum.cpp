// SPDX-License-Identifier: Apache-2.0
#include "arm_messages/sum.hpp"

namespace arm_messages {

msg::Distance sum(const msg::Reach& reach) {
  msg::Distance distance;
  for (const double length : reach.lengths) {
    distance.meters += length;
  }
  return distance;
}

}  // namespace arm_messages
