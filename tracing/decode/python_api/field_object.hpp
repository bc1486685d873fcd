// SPDX-License-Identifier: Apache-2.0
// The values of fields as objects of Python.
#pragma once

#include <pybind11/pybind11.h>

#include <string_view>

#include "tracing/decode/reader/event.hpp"

namespace tracing::python {

// Bytes that are not UTF-8 become U+FFFD.
pybind11::object text_object(std::string_view text);

// An integer, a float or a text; an enumeration's value with a label is this label; an array is a tuple, a structure a
// dict, a variant its selected option.
pybind11::object field_object(const FieldValue& value);

}  // namespace tracing::python
