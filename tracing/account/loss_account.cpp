// SPDX-License-Identifier: Apache-2.0
#include "tracing/account/loss_account.hpp"

#include <numeric>

namespace tracing {

std::uint64_t LossAccount::discarded_events() const {
  return std::accumulate(channels.begin(), channels.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const ChannelLoss& loss) { return sum + loss.discarded_events; });
}

std::uint64_t LossAccount::lost_packets() const {
  return std::accumulate(channels.begin(), channels.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const ChannelLoss& loss) { return sum + loss.lost_packets; });
}

}  // namespace tracing
