// SPDX-License-Identifier: Apache-2.0
#include "actions/process/machine_settings.hpp"

#include <fmt/format.h>

#include <utility>
#include <variant>

namespace launch {
namespace {

[[noreturn]] void refuse(const std::string& what, const SourceRange& where, const MachineView& machine) {
  throw LaunchError(
      fmt::format("{} works on this machine only, and the process runs on machine '{}'", what, machine.name()), where,
      {}, Finding::kExclusive);
}

}  // namespace

AttributeSpec machine_attribute(std::string help) {
  return {"machine", AttributeType::kText, false, "that of the scope", std::move(help), true};
}

std::shared_ptr<MachineView> machine_of(const Fields& fields, LaunchContext& context) {
  if (!fields.has("machine")) {
    return context.scope().machine;
  }
  const Template& name = fields.text("machine");
  return context.machines().find(name.perform(context.scope()), name.where());
}

std::shared_ptr<MachineView> machine_of_process(const Fields& fields, LaunchContext& context,
                                                const std::function<AssignableProcess(Scope&)>& describe) {
  if (context.machines().has_assignments()) {
    if (const MachineAssignment* const assignment = context.machines().assigned(describe(context.scope()))) {
      return context.machines().find(assignment->machine, assignment->where);
    }
  }
  return machine_of(fields, context);
}

void put_on_machine(const Fields& fields, LaunchContext& context, ProcessSpec& spec) {
  const std::shared_ptr<MachineView>& machine = context.scope().machine;
  if (machine == nullptr) {
    return;
  }
  spec.machine = machine->name();
  if (spec.terminal_input) {
    refuse("stdin=\"terminal\"", fields.where("stdin"), *machine);
  }
  if (spec.tty) {
    refuse("tty=\"true\"", fields.where("tty"), *machine);
  }
  if (fields.has("crash-dir")) {
    refuse("crash-dir", fields.where("crash-dir"), *machine);
  }
  if (spec.control_limits.any() || !spec.control_groups.empty()) {
    refuse("a limit by a cgroup", spec.control_groups.empty() ? fields.where() : spec.control_groups.back()->where,
           *machine);
  }
  for (const HealthWatch& watch : spec.watches) {
    if (!std::holds_alternative<OutputLines>(watch.subject)) {
      refuse("a watch of another kind than output", watch.where, *machine);
    }
  }
  spec.crash_directory.clear();  // of the command line
  spec.limits.core_files = false;
}

}  // namespace launch
