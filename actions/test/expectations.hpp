// SPDX-License-Identifier: Apache-2.0
// The items of <test> that say what must happen.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "launcher/language/fields.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

// Evaluates an item in the current scope. Throws LaunchError.
using PerformExpectation = std::function<Expectation(LaunchContext&)>;

struct ExpectationType {
  ItemSpec item;
  // Throws LaunchError when attributes don't go together.
  std::function<PerformExpectation(const Fields&)> make;
};

const std::vector<ExpectationType>& expectation_types();
ExpectationType message_expectation_type();
// Those of them that speak of the trace of the run (trace_expectations.cpp).
std::vector<ExpectationType> trace_expectation_types();

}  // namespace launch
