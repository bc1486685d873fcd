// SPDX-License-Identifier: Apache-2.0
// The class `Trace` of Python with its expectations.
#pragma once

#include <pybind11/pybind11.h>

namespace launch_trace_testing {

// Each expectation raises an AssertionError with the text of the verdict when it does not hold.
void add_expectations(pybind11::module_& module);

}  // namespace launch_trace_testing
