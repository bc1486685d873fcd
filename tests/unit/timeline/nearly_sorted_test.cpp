// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/timeline/nearly_sorted.hpp"

#include <gtest/gtest.h>

#include <random>

namespace tracing::timeline {
namespace {

struct Element {
  int key = 0;
  int place = 0;
  bool operator==(const Element&) const = default;
};

TEST(NearlySorted, IsAsAStableSort) {
  std::mt19937 random(1);
  const auto by_key = [](const Element& left, const Element& right) { return left.key < right.key; };
  for (const int spread : {0, 1, 3, 30, 10'000}) {
    for (const int count : {0, 1, 2, 1000}) {
      std::vector<Element> elements;
      for (int i = 0; i < count; ++i) {
        const int later = static_cast<int>(random() % static_cast<unsigned>(spread + 1));
        elements.push_back({(i + later) / 2, i});
      }
      std::vector<Element> expected = elements;
      std::stable_sort(expected.begin(), expected.end(), by_key);
      sort_nearly_sorted(elements, by_key);
      EXPECT_EQ(elements, expected) << spread << ", " << count;
    }
  }
}

}  // namespace
}  // namespace tracing::timeline
