// SPDX-License-Identifier: Apache-2.0
// Tests all quantities of a comparison (docs/comparing_runs.md, "The method").
#pragma once

#include <vector>

#include "tracing/model/compare/compare_options.hpp"
#include "tracing/model/compare/tested_quantity.hpp"

namespace tracing::compare {

// Sets the probabilities of all that were cut. Each needs the others of its sort, which tell how runs differ.
void test_all(std::vector<TestedQuantity>& tests, const CompareOptions& options);

}  // namespace tracing::compare
