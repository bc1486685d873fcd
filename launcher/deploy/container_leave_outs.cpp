// SPDX-License-Identifier: Apache-2.0
#include "launcher/deploy/container_leave_outs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "base/text/utf8.hpp"

namespace launch {

void leave_out_of_containers(const Service& service, const DeploymentOptions& options, std::vector<LeftOut>& left_out) {
  const ProcessSpec& spec = *service.spec;
  const auto leave_out = [&](bool is_there, const std::string& what) {
    if (is_there) {
      left_out.push_back({fmt::format("{} of '{}'", what, service.name), spec.origin});
    }
  };
  // Texts in YAML are of characters.
  for (std::size_t i = 0; i < spec.argv.size(); ++i) {
    leave_out(!is_utf8(spec.argv[i]), fmt::format("bytes of argument {}, which is no UTF-8,", i));
  }
  for (const auto& [name, value] : variables_of(spec, shell_of(spec, options), ShellVariables::kSettings).set) {
    leave_out(!is_utf8(value), fmt::format("bytes of the variable '{}', which is no UTF-8,", name));
  }
  leave_out(!is_utf8(spec.working_directory), "bytes of the working directory, which is no UTF-8,");
  // Files that the launch has made are there as volumes.
  for (std::size_t i = 1; i < spec.argv.size(); ++i) {
    const bool is_made = std::any_of(spec.files.begin(), spec.files.end(),
                                     [i](const GeneratedFile& file) { return file.argument == i; });
    if (spec.argv[i - 1] == "--params-file" && !is_made) {
      left_out.push_back(
          {fmt::format("the parameter file {} of '{}', which the image must have", spec.argv[i], service.name),
           spec.origin});
    }
  }
  leave_out(service.delay > Duration{0}, "the timer before the start");
  leave_out(spec.required || spec.shutdown_on_exit, "the end of all with the end");
  leave_out(spec.respawn.enabled && spec.respawn.backoff != 1.0, "the growing delay of the respawns");
  leave_out(spec.start_limit.starts > 0, "the limit of starts");
  leave_out(spec.allowed_exits.any || !spec.allowed_exits.codes.empty(), "the allowed exit codes");
  leave_out(spec.limits.niceness.has_value(), "the niceness");
  leave_out(spec.limits.policy.has_value(), "the scheduling policy");
  leave_out(spec.limits.timer_slack.has_value(), "the timer slack");
  leave_out(spec.control_limits.memory_high.has_value(), "memory_high");
  leave_out(spec.control_limits.io_weight.has_value(), "io_weight");
  leave_out(!spec.control_groups.empty(), "the limits of the group");
}

}  // namespace launch
