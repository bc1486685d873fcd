// SPDX-License-Identifier: Apache-2.0
// Reads a place in a launch file from the Python package `launch`.
#pragma once

#include <pybind11/pybind11.h>

#include "launcher/python/interpreter/python_runtime.hpp"

namespace launch::python {

// `place` is (file, line, begin, end), or None.
Place read_place(const pybind11::handle& place);

}  // namespace launch::python
