// SPDX-License-Identifier: Apache-2.0
// Sorts what is nearly in order, such as what is told at its end by its begin, without memory of its own.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace tracing::timeline {

// As std::stable_sort, which takes over where elements are far from their places.
template <class Element, class Less>
void sort_nearly_sorted(std::vector<Element>& elements, Less less) {
  std::size_t moves_left = 8 * elements.size();
  for (std::size_t i = 1; i < elements.size(); ++i) {
    if (!less(elements[i], elements[i - 1])) {
      continue;
    }
    Element element = std::move(elements[i]);
    std::size_t hole = i;
    for (; hole > 0 && moves_left > 0 && less(element, elements[hole - 1]); --hole, --moves_left) {
      elements[hole] = std::move(elements[hole - 1]);
    }
    elements[hole] = std::move(element);
    if (moves_left == 0) {
      std::stable_sort(elements.begin(), elements.end(), less);
      return;
    }
  }
}

}  // namespace tracing::timeline
