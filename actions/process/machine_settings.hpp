// SPDX-License-Identifier: Apache-2.0
// The attribute `machine`: on which machine a process runs, and what does not work for one on another machine.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "launcher/language/fields.hpp"
#include "launcher/process/process_spec.hpp"
#include "launcher/visit/at_machine.hpp"

namespace launch {

// The declaration of the attribute, with its help.
AttributeSpec machine_attribute(std::string help);

// The machine that the attribute names, or that of the scope; null for this machine. Throws LaunchError.
std::shared_ptr<MachineView> machine_of(const Fields& fields, LaunchContext& context);

// The same for a process. What an <assign_machine> says of it counts before the attribute. `describe` evaluates what
// assignments go by, and is only called if there are some.
std::shared_ptr<MachineView> machine_of_process(const Fields& fields, LaunchContext& context,
                                                const std::function<AssignableProcess(Scope&)>& describe);

// Notes in the spec that it runs on the machine of the scope. Throws LaunchError for what it asks for that works on
// this machine alone.
void put_on_machine(const Fields& fields, LaunchContext& context, ProcessSpec& spec);

}  // namespace launch
