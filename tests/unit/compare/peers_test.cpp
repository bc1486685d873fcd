// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/compare/peers.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tracing::compare {
namespace {

TEST(Peers, TellNothingIfThereAreFew) {
  const std::vector<PeerShift> peers = shifts_of_peers(std::vector<Shifted>(5, {100, 0.5}));
  ASSERT_EQ(peers.size(), 5u);
  EXPECT_EQ(peers[3].usual, 0);
  EXPECT_EQ(peers[3].spread, 0);
}

TEST(Peers, DoNotCountTheQuantityItself) {
  std::vector<Shifted> quantities(21, {1000, 0});
  for (std::size_t i = 0; i < 20; ++i) {
    quantities[i].ratio = static_cast<double>(i % 5) / 10;  // 0, 0.1, 0.2, 0.3, 0.4
  }
  quantities[20].ratio = 10;
  const PeerShift peers = shifts_of_peers(quantities)[20];
  EXPECT_DOUBLE_EQ(peers.usual, 0.2);
  EXPECT_NEAR(peers.spread, 0.2 / 1.2816, 1e-9);
}

TEST(Peers, AreTheNearestInSize) {
  std::vector<Shifted> quantities;
  for (int i = 0; i < 30; ++i) {
    quantities.push_back({100.0 + i, i % 5 * 0.01});
  }
  for (int i = 0; i < 30; ++i) {
    quantities.push_back({1e6 + i, i % 5 * 1.0});
  }
  const std::vector<PeerShift> peers = shifts_of_peers(quantities);
  EXPECT_LT(peers[5].spread, 0.04);
  EXPECT_GT(peers[50].spread, 1);
}

// All of them differ by the same time, which is a larger part of a smaller one.
TEST(Peers, OfNearlyTheSameSizeTellTheTime) {
  std::vector<Shifted> quantities;
  for (int i = 0; i < 20; ++i) {
    const double before = 10'000 * (i + 1);
    quantities.push_back({before, std::log1p((i % 5 - 2) * 500 / before)});
  }
  const PeerShift peers = shifts_of_peers(quantities)[0];
  EXPECT_NEAR(peers.spread_ns, 1000 / 1.2816, 500 / 1.2816);
}

}  // namespace
}  // namespace tracing::compare
