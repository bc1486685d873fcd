// SPDX-License-Identifier: Apache-2.0
// Values of fields as objects of Python and back.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <stdexcept>

#include "launch_trace_testing/event.hpp"
#include "launch_trace_testing/launch_run.hpp"

namespace launch_trace_testing {

pybind11::object python_value(const Value& value);
// Throws a TypeError for an object that no field can be equal to.
Value value_of(const pybind11::handle& object);

// A run that can be ended before Python forgets it.
struct Run {
  std::unique_ptr<LaunchRun> launch;  // null: it was closed

  // Throws std::runtime_error when it was closed.
  LaunchRun& open() const {
    if (!launch) {
      throw std::runtime_error("the run is closed");
    }
    return *launch;
  }
};

}  // namespace launch_trace_testing
