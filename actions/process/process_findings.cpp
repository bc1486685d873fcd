// SPDX-License-Identifier: Apache-2.0
#include "actions/process/process_findings.hpp"

#include <fmt/format.h>
#include <sys/sysinfo.h>

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "actions/values/ros_names.hpp"
#include "base/text/names.hpp"

namespace launch {

namespace {

// Tokens with single slashes between them, behind "/" or "~/" or nothing. Wildcards, references and substitutions are
// not judged, because not every release of ROS 2 reads them.
bool is_remappable(std::string_view name) {
  if (name.find_first_of("*\\{}") != std::string_view::npos || name == "~") {
    return true;
  }
  name.remove_prefix(name.starts_with("~/") ? 2 : name.starts_with('/') ? 1 : 0);
  while (true) {
    const std::size_t slash = name.find('/');
    if (!is_valid_node_name(name.substr(0, slash))) {
      return false;
    }
    if (slash == std::string_view::npos) {
      return true;
    }
    name.remove_prefix(slash + 1);
  }
}

void remark_remap(const std::string& name, const SourceRange& where, LaunchContext& context) {
  context.exploration().remark(
      {Severity::kError,
       name.empty() ? "a name of the remap is empty" : fmt::format("'{}' is no name for a remap", name), where,
       "parts of letters, digits and underscores, not starting with a digit, with single slashes between",
       Finding::kInvalidRemap});
}

}  // namespace

void find_missing_directory(const std::string& directory, const SourceRange& where, LaunchContext& context) {
  std::error_code ignored;
  if (!directory.empty() && !std::filesystem::is_directory(directory, ignored)) {
    context.exploration().remark(
        {Severity::kError, fmt::format("the working directory '{}' does not exist", directory), where,
         directory.starts_with('/') ? "" : "a relative path is relative to the launcher's working directory",
         Finding::kMissingDirectory});
  }
}

void find_missing_cpus(const std::vector<int>& cpus, const SourceRange& where, LaunchContext& context) {
  // Most nodes name no CPUs. Counting them opens a file of the system, which takes a fifth of the time of a node.
  if (cpus.empty()) {
    return;
  }
  const int count = get_nprocs_conf();
  const auto missing = std::find_if(cpus.begin(), cpus.end(), [&](int cpu) { return cpu >= count; });
  if (missing != cpus.end()) {
    context.exploration().remark({cpus.front() >= count ? Severity::kError : Severity::kWarning,
                                  fmt::format("this machine has no CPU {}", *missing), where,
                                  fmt::format("its CPUs are 0 to {}", count - 1), Finding::kMissingCpu});
  }
}

void find_invalid_remap(const std::string& from, const SourceRange& from_where, const std::string& to,
                        const SourceRange& to_where, LaunchContext& context) {
  if (!context.exploration().is_on()) {
    return;
  }
  std::string_view before = without_scheme(from);
  const std::string_view after = without_scheme(to);
  if (const std::size_t colon = before.find(':'); colon != std::string_view::npos) {
    before = without_scheme(before.substr(colon + 1));
  }
  if (before.starts_with("__")) {
    return;  // the name of the node or its namespace
  }
  if (!is_remappable(before)) {
    remark_remap(from, from_where, context);
  }
  if (!is_remappable(after)) {
    remark_remap(to, to_where, context);
  }
}

}  // namespace launch
