// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/compare/peers.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tracing/model/compare/rank_test.hpp"

namespace tracing::compare {

namespace {

constexpr std::size_t kPeers = 20;

PeerShift spread_of(std::vector<double> shifts) {
  PeerShift result;
  result.usual = quantile(shifts, 0.5);
  for (double& shift : shifts) {
    shift = std::abs(shift - result.usual);
  }
  // Four fifths of a normal distribution lie within so many standard deviations. The last fifth may have changed.
  constexpr double kOfNormalDistribution = 1.2816;
  result.spread = quantile(shifts, 0.8) / kOfNormalDistribution;
  return result;
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
    const double before = std::max(quantities[order[place]].before, 1.0);
    std::vector<double> shifts;
    std::vector<double> scaled;  // to the size of this quantity
    for (std::size_t peer = first; peer < last; ++peer) {
      if (peer == place) {
        continue;
      }
      const Shifted& other = quantities[order[peer]];
      shifts.push_back(other.shift);
      scaled.push_back(other.shift / std::max(other.before, 1.0) * before);
    }
    // Larger peers would hide changes of a small quantity, smaller ones those of a large quantity.
    const PeerShift as_it_is = spread_of(std::move(shifts));
    const PeerShift to_scale = spread_of(std::move(scaled));
    result[order[place]] = as_it_is.spread <= to_scale.spread ? as_it_is : to_scale;
  }
  return result;
}

}  // namespace tracing::compare
