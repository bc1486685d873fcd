// SPDX-License-Identifier: Apache-2.0
// Reads the events of one name into columns.
#pragma once

#include <pybind11/pybind11.h>

#include <optional>
#include <string>
#include <vector>

#include "tracing/decode/reader/trace_reader.hpp"

namespace tracing::python {

// Adds the type that memoryviews without NumPy are views of.
void add_buffer_type(pybind11::module_& module);

// A dict from names to columns. A name is that of a field, of a context, or one of time_ns, cpu_id, vpid, vtid,
// procname and host; without names it has all of these and all fields. Throws KeyError for a name that the event does
// not have.
pybind11::dict read_columns(TraceReader& reader, const std::string& event,
                            const std::optional<std::vector<std::string>>& names);

}  // namespace tracing::python
