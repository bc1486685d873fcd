// SPDX-License-Identifier: Apache-2.0
// Writes elements of XML and YAML files as the Python package `launch` reads them (launch/frontend/_element.py).
#pragma once

#include <pybind11/pybind11.h>

#include "launcher/python/interpreter/python_runtime.hpp"

namespace launch::python {

// (file, line, first byte, end byte)
pybind11::tuple write_place(const Place& place);

// (tag, place, attributes, children, number, whether it is an item); an attribute is (name, value, place of the value,
// place of the name, untyped).
pybind11::tuple write_element(const Element& element);

}  // namespace launch::python
