// SPDX-License-Identifier: Apache-2.0
#include "launcher/visit/test_visits.hpp"

namespace launch {

TestVisits::Part TestVisits::next() {
  const std::size_t number = visited_++;
  if (!takes_) {
    return Part::kNothing;
  }
  if (!chosen_) {
    return Part::kExpectations;
  }
  return chosen_ == number ? Part::kActionsToo : Part::kNothing;
}

}  // namespace launch
