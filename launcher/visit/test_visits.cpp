// SPDX-License-Identifier: Apache-2.0
#include "launcher/visit/test_visits.hpp"

#include "launcher/visit/launch_context.hpp"

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

std::vector<FaultRequest> TestVisits::visit(LaunchContext& context, const std::vector<ActionPtr>& actions) {
  struct End {
    bool& in_test;
    ~End() { in_test = false; }
  } end{in_test_};
  in_test_ = true;
  context.visit_in(context.scope(), actions);
  return std::exchange(context.requests().faults, {});
}

}  // namespace launch
