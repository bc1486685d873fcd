// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/account/loss_account.hpp"

#include <algorithm>
#include <numeric>

namespace tracing {
namespace {

double ratio(double part, double whole) {
  return whole > 0 ? part / whole : 0;
}

}  // namespace

std::uint64_t LossAccount::discarded_events() const {
  return std::accumulate(channels.begin(), channels.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const ChannelLoss& loss) { return sum + loss.discarded_events; });
}

std::uint64_t LossAccount::lost_packets() const {
  return std::accumulate(channels.begin(), channels.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const ChannelLoss& loss) { return sum + loss.lost_packets; });
}

bool LossAccount::complete() const {
  return !has_losses() && absences.empty() &&
         std::all_of(channels.begin(), channels.end(),
                     [](const ChannelLoss& channel) { return channel.before_first.nothing(); });
}

bool LossAccount::has_losses() const {
  if (cut_short || !damage.empty()) {
    return true;
  }
  if (std::any_of(absences.begin(), absences.end(), [](const Absence& absence) { return absence.is_loss; })) {
    return true;
  }
  return std::any_of(channels.begin(), channels.end(), [](const ChannelLoss& channel) {
    const BeforeFirstPacket& before = channel.before_first;
    return channel.discarded_events + channel.lost_packets + before.discarded_events != 0 ||
           (before.why == BeforeFirstPacket::kLost && before.packets != 0);
  });
}

double ProcessAccount::processor_share(double ns_per_event) const {
  return ratio(tracing_seconds(ns_per_event), seconds);
}

double ProcessAccount::own_share(double ns_per_event) const {
  return ratio(tracing_seconds(ns_per_event), cpu_seconds);
}

double ProcessAccount::ns_per_callback(double ns_per_event) const {
  return ratio(static_cast<double>(events) * ns_per_event, static_cast<double>(callbacks));
}

}  // namespace tracing
