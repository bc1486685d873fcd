// SPDX-License-Identifier: Apache-2.0
// A table for libraries that know Apache Arrow, through its C stream interface: pyarrow, polars, DuckDB and others take
// it without a copy of the numbers. The two structures of the interface are stable, so no library is needed here.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>

#include "tracing/show/tables/table_columns.hpp"

namespace tracing::python {

// A capsule "arrow_array_stream" with one batch. Integers are int64, real numbers float64, texts a dictionary.
pybind11::capsule arrow_stream(std::shared_ptr<const TableColumns> table);

}  // namespace tracing::python
