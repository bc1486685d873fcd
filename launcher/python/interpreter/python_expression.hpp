// SPDX-License-Identifier: Apache-2.0
// Python expressions, evaluated by a CPython that is loaded when the first one is met.
#pragma once

#include <string>

namespace launch {

// str() of the value of `expression`. `modules` are names separated by commas; the names of "math" are also available
// unqualified. Throws std::runtime_error with one line: Python's error, or what to install when there is no Python.
// Must not be called by several threads at once.
std::string evaluate_python(const std::string& expression, const std::string& modules);

}  // namespace launch
