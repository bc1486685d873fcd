// SPDX-License-Identifier: Apache-2.0
// Why a callback takes longer or shorter than before, as the events of the scheduler tell.
#pragma once

#include <string>

#include "tracing/model/compare/run_summary.hpp"

namespace tracing::compare {

// What the mean of the callback's duration has changed by: its time on a processor, its waits for one, or its sleep.
// "more waiting for a processor, same running time"; "" if that is not known, or nothing stands out.
std::string cause_of(const std::string& callback, bool slower, const Runs& before, const Runs& after);

}  // namespace tracing::compare
