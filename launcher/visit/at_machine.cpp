// SPDX-License-Identifier: Apache-2.0
#include "launcher/visit/at_machine.hpp"

#include <utility>

namespace launch {

AtMachine::AtMachine(LaunchContext& context, const std::shared_ptr<MachineView>& machine)
    : context_(context),
      environment_(context.scope().environment),
      packages_(context.scope().packages),
      machine_(context.scope().machine),
      home_(context.scope().home) {
  move_to_machine(context.scope(), machine, context.initial_environment());
}

AtMachine::~AtMachine() {
  Scope& scope = context_.scope();
  scope.environment = std::move(environment_);
  scope.packages = std::move(packages_);
  scope.machine = std::move(machine_);
  scope.home = std::move(home_);
}

}  // namespace launch
