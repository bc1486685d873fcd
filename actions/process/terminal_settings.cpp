// SPDX-License-Identifier: Apache-2.0
#include "actions/process/terminal_settings.hpp"

#include <fmt/format.h>

#include <optional>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/substitution/boolean.hpp"

namespace launch {

void perform_stdin(const Fields& fields, Scope& scope, ProcessSpec& spec) {
  const std::string text = fields.text("stdin").perform(scope);
  if (text != "terminal" && text != "none") {
    throw LaunchError(fmt::format("'{}' is no standard input, expected terminal or none", text), fields.where("stdin"),
                      did_you_mean(text, {"terminal", "none"}));
  }
  spec.terminal_input = text == "terminal";
}

void perform_tty(const Fields& fields, Scope& scope, ProcessSpec& spec) {
  spec.tty = fields.boolean("tty", false).perform(scope);
  if (!spec.tty) {
    return;
  }
  if (spec.terminal_input) {
    throw LaunchError("a process with tty=\"true\" reads a terminal of its own, not that of the launch",
                      fields.where("stdin"), "leave out stdin or tty", Finding::kExclusive);
  }
  if (fields.has("stderr")) {
    throw LaunchError("stderr has no effect with tty=\"true\": what is printed on a terminal is one stream",
                      fields.where("stderr"), "stdout says where it goes", Finding::kExclusive);
  }
  if (fields.boolean("leave-running", false).perform(scope)) {
    throw LaunchError("a process with tty=\"true\" can't be left running: its terminal ends with the launch",
                      fields.where("leave-running"), "leave out leave-running or tty", Finding::kExclusive);
  }
  // A launch that systemd or cron has started has none, and programs take that for a terminal that can do nothing.
  spec.environment.emplace("TERM", "xterm");
}

void perform_emulated_terminals(const Fields& fields, Scope& scope, ProcessSpec& spec) {
  const auto configuration = scope.configurations.find("emulate_tty");
  if (configuration == scope.configurations.end()) {
    spec.emulate_tty = fields.boolean("emulate_tty", false).perform(scope);
    return;
  }
  const std::optional<bool> value = condition_boolean(configuration->second);
  if (!value) {
    throw LaunchError(fmt::format("launch configuration 'emulate_tty' is expected to be true or false, got '{}'",
                                  configuration->second),
                      fields.where());
  }
  spec.emulate_tty = *value;
}

}  // namespace launch
