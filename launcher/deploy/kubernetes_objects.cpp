// SPDX-License-Identifier: Apache-2.0
// Objects for `kubectl apply -f DIR`: for each process a Deployment, or a Pod if it does not respawn, and a ConfigMap
// with the parameter files.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "launcher/deploy/container_leave_outs.hpp"
#include "launcher/deploy/deployment.hpp"
#include "launcher/deploy/yaml_text.hpp"

namespace launch {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kLongestName = 50;  // of 63: a Deployment adds to the names of its pods
constexpr double kMilli = 1000.0;

// "$(NAME)" is a variable of Kubernetes, and "$$(NAME)" is this text.
std::string kubernetes_text(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    result += text[i];
    if (text[i] == '$' && i + 1 < text.size() && (text[i + 1] == '(' || text[i + 1] == '$')) {
      result += '$';
    }
  }
  return result;
}

// Lower case, digits and "-", with a letter or digit at both ends.
std::string object_name(const std::string& text) {
  std::string name;
  for (const char c : text) {
    const auto lower = static_cast<unsigned char>(std::tolower(static_cast<unsigned char>(c)));
    const bool allowed = std::isalnum(lower) != 0;
    if (allowed || (!name.empty() && name.back() != '-')) {
      name += allowed ? static_cast<char>(lower) : '-';
    }
  }
  name.resize(std::min(name.size(), kLongestName));
  while (name.ends_with('-')) {
    name.pop_back();
  }
  return name.empty() ? "launch" : name;
}

class ObjectWriter {
 public:
  ObjectWriter(const LaunchPlan& plan, const DeploymentOptions& options)
      : options_(options), plan_(deployment_of(plan)), whole_(object_name(options.name)) {
    result_.left_out = plan_.left_out;
  }

  Deployment write() {
    std::map<std::string, int> count;
    for (const Service& service : plan_.services) {
      std::string name = object_name(whole_ + "-" + service.name);
      if (const int number = ++count[name]; number > 1) {
        name += fmt::format("-{}", number);
      }
      add(name + ".yaml", object_of(service, name));
    }
    if (!parameters_.empty()) {
      const Json map = {{"apiVersion", "v1"},
                        {"kind", "ConfigMap"},
                        {"metadata", metadata(whole_ + "-parameters", "parameters")},
                        {"data", parameters_}};
      add(whole_ + "-parameters.yaml", map);
    }
    return std::move(result_);
  }

 private:
  void add(const std::string& path, const Json& object) {
    result_.files.push_back({path, fmt::format("{}\n{}", export_mark(options_), as_yaml(object))});
  }

  Json metadata(const std::string& name, const std::string& component) const {
    return {{"name", name}, {"labels", labels(component)}};
  }

  Json labels(const std::string& component) const {
    return {{"app.kubernetes.io/name", component}, {"app.kubernetes.io/part-of", whole_}};
  }

  Json object_of(const Service& service, const std::string& name) {
    const ProcessSpec& spec = *service.spec;
    Json pod = {
        {"hostNetwork", true},
        {"hostIPC", true},
        {"terminationGracePeriodSeconds",
         std::lround(std::ceil(std::chrono::duration<double>(spec.sigterm_timeout + spec.sigkill_timeout).count()))},
        {"containers", Json::array({container_of(service)})}};
    if (!spec.files.empty()) {
      pod["volumes"] = Json::array({{{"name", "parameters"}, {"configMap", {{"name", whole_ + "-parameters"}}}}});
    }
    leave_out_more(service);
    if (!spec.respawn.enabled) {
      pod["restartPolicy"] = "Never";
      return {{"apiVersion", "v1"}, {"kind", "Pod"}, {"metadata", metadata(name, name)}, {"spec", pod}};
    }
    return {{"apiVersion", "apps/v1"},
            {"kind", "Deployment"},
            {"metadata", metadata(name, name)},
            {"spec",
             {{"replicas", 1},
              {"strategy", {{"type", "Recreate"}}},
              {"selector", {{"matchLabels", labels(name)}}},
              {"template", {{"metadata", {{"labels", labels(name)}}}, {"spec", pod}}}}}};
  }

  Json container_of(const Service& service) {
    const ProcessSpec& spec = *service.spec;
    Json container = {{"name", object_name(service.name)}, {"image", options_.image}};
    std::vector<std::string> paths;
    Json mounts = Json::array();
    for (const std::string& name : file_names_of(service)) {
      parameters_[name] = spec.files[paths.size()].content;
      paths.push_back("/launch/parameters/" + name);
      mounts.push_back({{"name", "parameters"}, {"mountPath", paths.back()}, {"subPath", name}, {"readOnly", true}});
    }
    Json command = Json::array();
    for (const std::string& word : command_line_of(spec, paths)) {
      command.push_back(kubernetes_text(word));
    }
    container["command"] = command;
    if (!spec.working_directory.empty()) {
      container["workingDir"] = spec.working_directory;
    }
    for (const auto& [name, value] : variables_of(spec, options_.shell, ShellVariables::kSettings).set) {
      container["env"].push_back({{"name", name}, {"value", kubernetes_text(value)}});
    }
    if (spec.control_limits.memory_max) {
      container["resources"]["limits"]["memory"] = std::to_string(*spec.control_limits.memory_max);
    }
    if (spec.control_limits.cpu_quota) {
      container["resources"]["limits"]["cpu"] =
          fmt::format("{}m", std::max(std::lround(*spec.control_limits.cpu_quota * kMilli), 1L));
    }
    if (!mounts.empty()) {
      container["volumeMounts"] = mounts;
    }
    return container;
  }

  void leave_out_more(const Service& service) {
    const ProcessSpec& spec = *service.spec;
    leave_out_of_containers(service, result_.left_out);
    const auto leave_out = [&](bool is_there, const std::string& what) {
      if (is_there) {
        result_.left_out.push_back({fmt::format("{} of '{}'", what, service.name), spec.origin});
      }
    };
    for (const ServiceBefore& before : service.before) {
      result_.left_out.push_back({fmt::format("'{}' waits until '{}' has {}", service.name,
                                              plan_.services[before.service].name, before.ended ? "ended" : "started"),
                                  spec.origin});
    }
    leave_out(spec.respawn.enabled && spec.respawn.delay > Duration{0}, "the respawn delay");
    leave_out(spec.respawn.enabled && spec.respawn.max_retries >= 0, "the limit of respawns");
    leave_out(!spec.limits.cpus.empty(), "the set of processors");
    leave_out(spec.limits.open_files || spec.limits.memory || spec.limits.core_files || spec.limits.locked_memory,
              "the resource limits");
    leave_out(spec.limits.oom_score_adj.has_value(), "oom_score_adj");
    leave_out(spec.control_limits.cpu_weight.has_value(), "cpu_weight");
    leave_out(spec.control_limits.pids_max.has_value(), "pids_max");
  }

  const DeploymentOptions& options_;
  const DeploymentPlan plan_;
  const std::string whole_;
  Json parameters_ = Json::object();
  Deployment result_;
};

}  // namespace

Deployment as_kubernetes_objects(const LaunchPlan& plan, const DeploymentOptions& options) {
  return ObjectWriter(plan, options).write();
}

}  // namespace launch
