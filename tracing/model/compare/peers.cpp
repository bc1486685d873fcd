// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/compare/peers.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "tracing/model/compare/rank_test.hpp"

namespace tracing::compare {

namespace {

constexpr std::size_t kPeers = 20;

constexpr std::size_t kNearest = 8;

// How far four fifths of the shifts are from `usual` at most, as a standard deviation. The last fifth may have changed.
double spread_of(std::vector<double> shifts, double usual) {
  for (double& shift : shifts) {
    shift = std::abs(shift - usual);
  }
  constexpr double kOfNormalDistribution = 1.2816;  // four fifths of it lie within so many
  return quantile(shifts, 0.8) / kOfNormalDistribution;
}

}  // namespace

std::vector<PeerShift> shifts_of_peers(const std::vector<Shifted>& quantities) {
  std::vector<PeerShift> result(quantities.size());
  if (quantities.size() <= kLeastPeers) {
    return result;
  }
  std::vector<std::size_t> order(quantities.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return quantities[a].before < quantities[b].before; });
  const auto size = [&](std::size_t place) { return std::log(std::max(quantities[order[place]].before, 1.0)); };
  for (std::size_t place = 0; place < order.size(); ++place) {
    // [first, last) grows towards the nearer neighbour.
    std::size_t first = place;
    std::size_t last = place + 1;
    while (last - first <= kPeers && last - first < order.size()) {
      const bool takes_lower =
          first > 0 && (last == order.size() || size(place) - size(first - 1) <= size(last) - size(place));
      takes_lower ? --first : ++last;
    }
    std::vector<double> ratios;
    std::vector<std::pair<double, double>> times;  // how far away the peer is, and its shift
    for (std::size_t peer = first; peer < last; ++peer) {
      if (peer == place) {
        continue;
      }
      const Shifted& other = quantities[order[peer]];
      ratios.push_back(other.ratio);
      times.emplace_back(std::abs(size(peer) - size(place)), std::max(other.before, 1.0) * std::expm1(other.ratio));
    }
    std::stable_sort(times.begin(), times.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<double> nearest;
    for (std::size_t peer = 0; peer < std::min(times.size(), kNearest); ++peer) {
      nearest.push_back(times[peer].second);
    }
    PeerShift& shift = result[order[place]];
    shift.usual = quantile(ratios, 0.5);
    shift.spread = spread_of(std::move(ratios), shift.usual);
    shift.spread_ns = spread_of(nearest, quantile(nearest, 0.5));
  }
  return result;
}

}  // namespace tracing::compare
