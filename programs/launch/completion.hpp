// SPDX-License-Identifier: Apache-2.0
// `launch complete`: what the shells' completion (programs/launch/completion/) offers for the last word of a command
// line.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "launcher/language/registry.hpp"
#include "launcher/substitution/scope.hpp"

namespace launch {

// Candidates for the last of the words after `launch trace`.
using CompleteTrace = std::function<std::vector<std::string>(const std::vector<std::string>& words)>;

// `words` are the words after `launch`; the last one may be empty or incomplete. The shell itself completes names of
// files.
std::vector<std::string> completions(const std::vector<std::string>& words, const Registry& registry,
                                     const Environment& environment, const CompleteTrace& trace_words);

}  // namespace launch
