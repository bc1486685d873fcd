// SPDX-License-Identifier: Apache-2.0
// The error text of a function that refuses something.
#pragma once

#include <string>

#include "tracing/record/plan/trace_error.hpp"

namespace tracing::testing {

// "what\nremedy" of the TraceError that `function` throws; "no error" when it throws none.
template <typename Function>
std::string error_of(Function function) {
  try {
    function();
  } catch (const TraceError& error) {
    return std::string(error.what()) + "\n" + error.remedy();
  }
  return "no error";
}

}  // namespace tracing::testing
