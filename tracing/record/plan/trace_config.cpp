// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/plan/trace_config.hpp"

#include <array>
#include <ctime>
#include <filesystem>

#include "base/environment/home_directory.hpp"

namespace tracing {
namespace {

std::string value_or_empty(const std::map<std::string, std::string>& environment, const std::string& name) {
  const auto found = environment.find(name);
  return found == environment.end() ? std::string() : found->second;
}

std::string absolute_normalised(const std::string& path, const std::map<std::string, std::string>& environment) {
  const std::filesystem::path expanded = launch::expand_home(path, environment);
  // The empty last component ("a/" is "a" and "") is dropped, else the session's name would not follow a single slash.
  const std::filesystem::path normal = std::filesystem::absolute(expanded).lexically_normal();
  return (normal.has_filename() || normal == normal.root_path() ? normal : normal.parent_path()).string();
}

}  // namespace

const std::vector<std::string>& default_context_fields() {
  static const std::vector<std::string> fields = {"procname", "vpid", "vtid"};
  return fields;
}

std::string TraceConfig::trace_directory() const {
  std::filesystem::path directory = std::filesystem::path(base_path) / session_name;
  if (!part.empty()) {
    directory /= part;
  }
  if (dual_runtime) {
    return (directory / "runtime").string();
  }
  if (dual_session) {
    return (directory / "snapshot").string();
  }
  return directory.string();
}

std::vector<std::string> TraceConfig::all_events_ust() const {
  std::vector<std::string> all = events_ust;
  all.insert(all.end(), further_events_ust.begin(), further_events_ust.end());
  for (const ChannelConfig& channel : channels) {
    all.insert(all.end(), channel.events_ust.begin(), channel.events_ust.end());
  }
  return all;
}

std::string TraceConfig::destination() const {
  if (!over_network()) {
    return trace_directory();
  }
  return url.empty() ? kLocalRelayDaemon : url;
}

std::string TraceConfig::lttng_session_name() const {
  if (dual_runtime) {
    return session_name + "-runtime";
  }
  if (dual_session) {
    return session_name + "-snapshot";
  }
  return session_name;
}

std::string trace_base_path(const std::string& given, const std::map<std::string, std::string>& environment) {
  if (!given.empty()) {
    return absolute_normalised(given, environment);
  }
  if (std::string trace_directory = value_or_empty(environment, "ROS_TRACE_DIR"); !trace_directory.empty()) {
    return absolute_normalised(trace_directory, environment);
  }
  return absolute_normalised(launch::ros_home(environment) + "/tracing", environment);
}

std::string session_timestamp() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  std::array<char, sizeof "-YYYYMMDDHHMMSS"> text{};
  std::strftime(text.data(), text.size(), "-%Y%m%d%H%M%S", &local);
  return text.data();
}

}  // namespace tracing
