// SPDX-License-Identifier: Apache-2.0
// The scope of a machine, for as long as one action is visited.
#pragma once

#include <memory>

#include "launcher/visit/launch_context.hpp"

namespace launch {

// While it lives, the scope of the context is that of a machine: its environment, with what the launch file has
// changed, and its packages. Null: of this machine.
class AtMachine {
 public:
  AtMachine(LaunchContext& context, const std::shared_ptr<MachineView>& machine);
  ~AtMachine();
  AtMachine(const AtMachine&) = delete;
  AtMachine& operator=(const AtMachine&) = delete;

 private:
  LaunchContext& context_;
  Environment environment_;
  std::shared_ptr<PackageIndex> packages_;
  std::shared_ptr<MachineView> machine_;
  std::shared_ptr<const HomeMachine> home_;
};

}  // namespace launch
