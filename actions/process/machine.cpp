// SPDX-License-Identifier: Apache-2.0
// <machine name="…" connect="…"/>: another machine, on which processes can run.
#include <fmt/format.h>

#include "actions/row_action.hpp"
#include "base/text/quoted_text.hpp"
#include "launcher/substitution/template_parser.hpp"

namespace launch {

namespace {

void perform_connect(const Fields& fields, Scope& scope, MachineDeclaration& machine) {
  const Template& text = fields.text("connect");
  machine.connect = text.perform(scope);
  machine.connect_where = text.where();
  if (split_shell_words(machine.connect, text.where()).empty()) {
    throw LaunchError("connect is empty", text.where(), "it is a command that leads there, such as \"ssh robot\"");
  }
}

// A shell there may read these words; others than those of a plain path would not arrive as they are.
void perform_launch(const Fields& fields, Scope& scope, MachineDeclaration& machine) {
  const Template& text = fields.text("launch");
  machine.launch = text.perform(scope);
  if (machine.launch.empty() || machine.launch.starts_with('-') || shell_quoted(machine.launch) != machine.launch) {
    throw LaunchError(fmt::format("'{}' is no plain path of a program", machine.launch), text.where(),
                      "use letters, digits and the characters / . _ - +");
  }
}

void perform_seconds(const char* name, const Fields& fields, Scope& scope, Duration& time, double least = 0.5) {
  constexpr double kMost = 86400;
  NumberField number = *fields.number(name);
  const double seconds = number.perform(scope);
  if (!(seconds >= least && seconds <= kMost)) {
    throw LaunchError(fmt::format("{} must be from {} to {} seconds, got {}", name, least, kMost, seconds),
                      fields.where(name));
  }
  time = as_duration(seconds);
}

// Each policy has a time of its own.
void require_fitting_times(const Fields& fields, const MachineDeclaration& machine) {
  const char* const unused = machine.keep ? "grace" : "keep_for";
  if (fields.has(unused)) {
    throw LaunchError(fmt::format("{} has no effect with on_disconnect=\"{}\"", unused, machine.keep ? "keep" : "stop"),
                      fields.where(unused),
                      machine.keep ? "keep_for says how long what runs there goes on"
                                   : "grace says how long what runs there goes on; keep_for belongs to "
                                     "on_disconnect=\"keep\"",
                      Finding::kExclusive);
  }
}

void require_pattern(const Fields& fields) {
  if (!fields.has("package") && !fields.has("namespace") && !fields.has("process")) {
    throw LaunchError("assign_machine needs a pattern", fields.where(),
                      "give package, namespace or process; * stands for any text", Finding::kMissingAttribute);
  }
}

}  // namespace

ActionType assign_machine_action() {
  return action_of<MachineAssignment>(
      {.tag = "assign_machine",
       .help = "Puts processes on a machine that launch files after it start, whatever they say themselves.",
       .extension = true},
      {{.attribute = {"machine", AttributeType::kText, true, "", "the machine; local: this one"},
        .place = place_of(&MachineAssignment::machine)},
       {.attribute = {"package", AttributeType::kText, false, "any", "pattern for the package of a node"},
        .place = place_of(&MachineAssignment::package)},
       {.attribute = {"namespace", AttributeType::kText, false, "any",
                      "pattern for the namespace of a node, or for one above it"},
        .place = place_of(&MachineAssignment::name_space)},
       {.attribute = {"process", AttributeType::kText, false, "any",
                      "pattern for the label of a process without its number, or for the name of a node"},
        .place = place_of(&MachineAssignment::process)}},
      [](const Fields& fields, LaunchContext& context, MachineAssignment& assignment) {
        assignment.where = fields.where("machine");
        context.machines().assign(std::move(assignment));
      },
      require_pattern);
}

ActionType machine_action() {
  return action_of<MachineDeclaration>(
      {.tag = "machine", .help = "Declares another machine, on which processes can run.", .extension = true},
      {{.attribute = {"name", AttributeType::kText, true, "", "its name in the launch file"},
        .place = place_of(&MachineDeclaration::name)},
       {.attribute = {"connect", AttributeType::kText, true, "",
                      "the command whose standard input and output reach a program there, such as \"ssh robot\"; "
                      "local: it is this machine"},
        .perform = perform_connect},
       {.attribute = {"launch", AttributeType::kText, false, "launch", "the program launch there"},
        .perform = perform_launch},
       {.attribute = {"setup", AttributeType::kText, false, "none",
                      "a file there that is sourced before anything else, such as a setup.bash"},
        .place = place_of(&MachineDeclaration::setup)},
       {.attribute = {"keepalive", AttributeType::kFloat, false, "5",
                      "seconds after which a connection that is silent is lost"},
        .perform = [](const Fields& fields, Scope& scope,
                      MachineDeclaration& machine) { perform_seconds("keepalive", fields, scope, machine.keepalive); }},
       {.attribute = {"connect_timeout", AttributeType::kFloat, false, "30",
                      "seconds within which launch must have answered there"},
        .perform =
            [](const Fields& fields, Scope& scope, MachineDeclaration& machine) {
              perform_seconds("connect_timeout", fields, scope, machine.connect_timeout);
            }},
       {.attribute = {"on_disconnect", AttributeType::kText, false, "stop",
                      "when the connection is lost: stop, what runs there is ended; or keep, it goes on, and launch "
                      "connects again"},
        .place = [](MachineDeclaration& machine) -> SettingPlace {
          return SettingChoice{
              {"stop", "keep"}, machine.keep ? 1U : 0U, [&machine](std::size_t word) { machine.keep = word == 1; }};
        }},
       {.attribute = {"grace", AttributeType::kFloat, false, "0",
                      "with stop: seconds after which what runs there is asked to end"},
        .perform = [](const Fields& fields, Scope& scope,
                      MachineDeclaration& machine) { perform_seconds("grace", fields, scope, machine.grace, 0); }},
       {.attribute = {"keep_for", AttributeType::kFloat, false, "300",
                      "with keep: seconds after which what runs there is asked to end, if launch has not come back"},
        .perform = [](const Fields& fields, Scope& scope,
                      MachineDeclaration& machine) { perform_seconds("keep_for", fields, scope, machine.keep_for); }}},
      [](const Fields& fields, LaunchContext& context, MachineDeclaration& machine) {
        require_fitting_times(fields, machine);
        machine.where = fields.where();
        context.machines().declare(std::move(machine));
      });
}

}  // namespace launch
