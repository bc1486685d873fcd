// SPDX-License-Identifier: Apache-2.0
// What runs differ from one another, seen from all quantities of one sort.
//
// Runs of one system differ for their whole length, because timers have other phases, memory lies elsewhere, or the
// machine is slower. One quantity of two runs can't tell this from a change. But it concerns most quantities, and a
// change few of them: how far the shifts of the others are spread tells how much a shift means (Efron's empirical
// null). Shifts are ratios, because a machine that is slower makes all times longer by a part of them, and times: a
// small quantity may differ by as much as those that are a little larger.
#pragma once

#include <cstddef>
#include <vector>

namespace tracing::compare {

// One quantity in two runs.
struct Shifted {
  double before = 0;
  double ratio = 0;  // the natural logarithm of after / before
};

// What the shift of a quantity may be without a change, as logarithms of ratios: `usual`, and `spread` more or less.
struct PeerShift {
  double usual = 0;
  double spread = 0;     // comparable with a standard deviation
  double spread_ns = 0;  // of the nearest ones, as times
};

inline constexpr std::size_t kLeastPeers = 5;

// For each quantity, from those of the others whose values before are nearest to its own. All zero if there are fewer
// than kLeastPeers others.
std::vector<PeerShift> shifts_of_peers(const std::vector<Shifted>& quantities);

}  // namespace tracing::compare
