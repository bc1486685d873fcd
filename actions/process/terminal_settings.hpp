// SPDX-License-Identifier: Apache-2.0
// What a process has to do with terminals: the one of the launch, one of its own, or outputs that only look like one.
#pragma once

#include "launcher/language/fields.hpp"
#include "launcher/process/process_spec.hpp"
#include "launcher/substitution/scope.hpp"

namespace launch {

// The attributes stdin and tty, in this order; the environment of the process must be there. Throw LaunchError.
void perform_stdin(const Fields& fields, Scope& scope, ProcessSpec& spec);
void perform_tty(const Fields& fields, Scope& scope, ProcessSpec& spec);

// The attribute emulate_tty, which a launch configuration overrules. Throws LaunchError.
void perform_emulated_terminals(const Fields& fields, Scope& scope, ProcessSpec& spec);

}  // namespace launch
