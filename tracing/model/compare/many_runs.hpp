// SPDX-License-Identifier: Apache-2.0
// What many runs on each side tell of the work of callbacks.
//
// A single run can't tell how runs differ, so the test of a pair of runs assumes much (tested_quantity.cpp). Four runs
// on each side show it: callbacks on two processors that share a core are slower by a tenth in some runs, and one in a
// hundred takes half as long again in a whole run. A change holds in most pairs of runs nevertheless.
#pragma once

#include <vector>

#include "tracing/model/compare/compare_options.hpp"
#include "tracing/model/compare/tested_quantity.hpp"

namespace tracing::compare {

// Whether there are enough of them, and the quantity is the work of a callback and no delay.
bool has_many_runs(const TestedQuantity& tested);

// Sets the probabilities of quantities of one sort, all of which have many runs.
void test_many_runs(const std::vector<TestedQuantity*>& sort, const CompareOptions& options);

}  // namespace tracing::compare
