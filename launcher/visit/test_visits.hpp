// SPDX-License-Identifier: Apache-2.0
// Which <test> of the launch files a visit requests, and with which faults. Without take(), tests have no effect.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "launcher/language/action.hpp"
#include "launcher/visit/fault_request.hpp"

namespace launch {

class TestVisits {
 public:
  // From now on the tests of launch files are requested, without the actions within them. With `chosen` it is only the
  // test of this number, from 0 in the order of the visit, and its actions are visited.
  void take(std::optional<std::size_t> chosen) {
    takes_ = true;
    chosen_ = chosen;
  }
  enum class Part { kNothing, kExpectations, kActionsToo };
  // To be called once by each test that is visited: what it should request.
  Part next() {
    const std::size_t number = visited_++;
    if (!takes_) {
      return Part::kNothing;
    }
    if (!chosen_) {
      return Part::kExpectations;
    }
    return chosen_ == number ? Part::kActionsToo : Part::kNothing;
  }

  // The actions within a test are visited by this call, in a scope of their own. Returns the faults that they ask for.
  std::vector<FaultRequest> visit(LaunchContext& context, const std::vector<ActionPtr>& actions);
  // Whether such a visit is under way. Timers and event handlers are visited later.
  bool is_in_test() const { return in_test_; }

  // Of faults: the seed of what is drawn, and the numbers of those that are applied; nullopt: all.
  struct FaultChoice {
    std::uint64_t seed = 1;
    std::optional<std::set<std::size_t>> numbers;
  };
  void choose_faults(FaultChoice choice) { fault_choice_ = std::move(choice); }
  const FaultChoice& fault_choice() const { return fault_choice_; }

 private:
  bool takes_ = false;
  std::optional<std::size_t> chosen_;
  std::size_t visited_ = 0;  // tests so far
  bool in_test_ = false;
  FaultChoice fault_choice_;
};

}  // namespace launch
