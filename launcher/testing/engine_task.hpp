// SPDX-License-Identifier: Apache-2.0
// The other side of an engine (engine.hpp): runs the test that was handed over.
#pragma once

#include <string>

#include "launcher/language/registry.hpp"

namespace launch {

// Runs the test of the word and prints its result. Returns the exit code.
int run_task(const std::string& word, const Registry& registry);

}  // namespace launch
