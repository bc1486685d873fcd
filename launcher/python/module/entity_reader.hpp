// SPDX-License-Identifier: Apache-2.0
// Reads the entities that the Python package `launch` makes of its objects.
#pragma once

#include <pybind11/pybind11.h>

#include <vector>

#include "launcher/python/interpreter/python_runtime.hpp"

namespace launch::python {

// A list of (tag, place, attributes, children, object, process name), as launch/_entities.py gives them.
std::vector<Entity> read_entities(const pybind11::handle& entities);

// Wraps a Python object that the launch will ask later.
ObjectPtr make_object(pybind11::object object);

// Reads a text: a str, a substitution, or a tuple of them, which is pasted together.
Text read_text(const pybind11::handle& value);

}  // namespace launch::python
