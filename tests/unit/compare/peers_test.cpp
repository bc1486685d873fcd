// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/compare/peers.hpp"

#include <gtest/gtest.h>

namespace tracing::compare {
namespace {

TEST(Peers, TellNothingIfThereAreFew) {
  const std::vector<PeerShift> peers = shifts_of_peers(std::vector<Shifted>(10, {100, 50}));
  ASSERT_EQ(peers.size(), 10u);
  EXPECT_EQ(peers[3].usual, 0);
  EXPECT_EQ(peers[3].spread, 0);
}

TEST(Peers, DoNotCountTheQuantityItself) {
  std::vector<Shifted> quantities(21, {1000, 0});
  for (std::size_t i = 0; i < 20; ++i) {
    quantities[i].shift = static_cast<double>(i % 5) * 10;  // 0, 10, 20, 30, 40
  }
  quantities[20].shift = 1e6;
  const PeerShift peers = shifts_of_peers(quantities)[20];
  EXPECT_EQ(peers.usual, 20);
  EXPECT_NEAR(peers.spread, 20 / 1.2816, 1e-9);
}

TEST(Peers, AreTheNearestInSize) {
  std::vector<Shifted> quantities;
  for (int i = 0; i < 30; ++i) {
    quantities.push_back({100.0 + i, i % 5 * 1.0});
  }
  for (int i = 0; i < 30; ++i) {
    quantities.push_back({1e6 + i, i % 5 * 1e5});
  }
  const std::vector<PeerShift> peers = shifts_of_peers(quantities);
  EXPECT_LT(peers[5].spread, 4);
  EXPECT_GT(peers[50].spread, 1e5);
}

// A single large one among small ones, all of which are a tenth longer.
TEST(Peers, AreScaledWhereThatFitsBetter) {
  std::vector<Shifted> quantities;
  for (int i = 0; i < 20; ++i) {
    quantities.push_back({100.0 + 10 * i, 10.0 + i});
  }
  quantities.push_back({10'000, 1'000});
  const PeerShift peers = shifts_of_peers(quantities)[20];
  EXPECT_NEAR(peers.usual, 1'000, 1e-6);
  EXPECT_NEAR(peers.spread, 0, 1e-6);
}

}  // namespace
}  // namespace tracing::compare
