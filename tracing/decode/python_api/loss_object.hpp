// SPDX-License-Identifier: Apache-2.0
// launch_trace.Loss: events that the tracer could not keep.
#pragma once

#include <pybind11/pybind11.h>

#include "tracing/decode/reader/event.hpp"

namespace tracing::python {

// Adds the type to the module.
void add_loss_type(pybind11::module_& module);

pybind11::object make_loss(const Loss& loss);

}  // namespace tracing::python
