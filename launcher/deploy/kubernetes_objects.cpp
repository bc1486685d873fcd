// SPDX-License-Identifier: Apache-2.0
// Objects for `kubectl apply -f DIR`: for each process a Deployment, or a Pod if it does not respawn, and a ConfigMap
// with the parameter files.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <variant>

#include "base/text/utf8.hpp"
#include "launcher/deploy/container_leave_outs.hpp"
#include "launcher/deploy/deployment.hpp"
#include "launcher/deploy/yaml_text.hpp"

namespace launch {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kLongestName = 50;  // of 63: a Deployment adds to the names of its pods
constexpr std::size_t kLargestMap = std::size_t{1} << 20U;
constexpr double kMilli = 1000.0;
constexpr const char* kMachineLabel = "launch.machine";  // of the node that is a machine of the launch file

std::int64_t whole_seconds(Duration time) {
  return std::max(std::chrono::ceil<std::chrono::seconds>(time).count(), std::int64_t{1});
}

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
    std::set<std::string> taken = {whole_ + "-parameters"};
    for (const Service& service : plan_.services) {
      const std::string first = object_name(whole_ + "-" + service.name);
      std::string name = first;
      for (int number = 2; !taken.insert(name).second; ++number) {
        name = fmt::format("{}-{}", first, number);
      }
      add(name + ".yaml", object_of(service, name));
    }
    if (!parameters_.empty()) {
      if (parameters_.dump(-1, ' ', false, Json::error_handler_t::replace).size() > kLargestMap) {
        result_.left_out.push_back(
            {"parameter files of more than 1 MiB in one ConfigMap, which Kubernetes refuses", {}});
      }
      const Json map = {{"apiVersion", "v1"},
                        {"kind", "ConfigMap"},
                        {"metadata", metadata(whole_ + "-parameters", "parameters")},
                        {"data", parameters_}};
      add(whole_ + "-parameters.yaml", map);
    }
    add_head(result_);
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
    Json pod = {{"hostNetwork", true},
                {"hostIPC", true},
                {"terminationGracePeriodSeconds", whole_seconds(spec.sigterm_timeout + spec.sigkill_timeout)},
                {"containers", Json::array({container_of(service)})}};
    if (!spec.files.empty()) {
      pod["volumes"] = Json::array({{{"name", "parameters"}, {"configMap", {{"name", whole_ + "-parameters"}}}}});
    }
    if (!spec.machine.empty()) {
      pod["nodeSelector"] = {{kMachineLabel, spec.machine}};
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
    for (const std::string& name : service.files) {
      parameters_[name] = spec.files[paths.size()].content;
      paths.push_back("/launch/parameters/" + name);
      mounts.push_back({{"name", "parameters"}, {"mountPath", paths.back()}, {"subPath", name}, {"readOnly", true}});
    }
    Json command = Json::array();
    for (const std::string& word : command_line_of(spec, paths)) {
      command.push_back(kubernetes_text(word));
    }
    container["args"] = command;  // behind the entry point of the image, as Compose does it
    if (!spec.working_directory.empty()) {
      container["workingDir"] = spec.working_directory;
    }
    for (const auto& [name, value] : variables_of(spec, shell_of(spec, options_), ShellVariables::kSettings).set) {
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
    add_probes(container, service);
    return container;
  }

  // What restarts a container that gets unhealthy is its liveness; without a reaction it is no longer ready.
  void add_probes(Json& container, const Service& service) {
    const ProcessSpec& spec = *service.spec;
    for (const HealthWatch& watch : spec.watches) {
      const bool restarts = watch.reaction == OnUnhealthy::kRestart && spec.respawn.enabled;
      const char* const kind = restarts ? "livenessProbe" : "readinessProbe";
      Json probe = probe_of(watch);
      if (probe.is_null() || container.contains(kind)) {
        result_.left_out.push_back({fmt::format("'{}' is healthy while {}", service.name, describe(watch)),
                                    watch.where ? watch.where : spec.origin});
        continue;
      }
      probe["periodSeconds"] = whole_seconds(watch.interval);
      probe["timeoutSeconds"] = whole_seconds(watch.timeout);
      probe["failureThreshold"] = watch.failures;
      if (watch.start_period > Duration{0}) {
        probe["initialDelaySeconds"] = whole_seconds(watch.start_period);
      }
      container[kind] = probe;
      if (watch.reaction != OnUnhealthy::kNothing && !restarts) {
        result_.left_out.push_back(
            {fmt::format("the {} when '{}' gets unhealthy", to_string(watch.reaction), service.name),
             watch.where ? watch.where : spec.origin});
      }
    }
  }

  static Json probe_of(const HealthWatch& watch) {
    Json probe;
    if (const auto* const command = std::get_if<CommandSucceeds>(&watch.subject)) {
      probe["exec"]["command"] = command->argv;  // Kubernetes looks for no variables there
    } else if (const auto* const port = std::get_if<PortAccepts>(&watch.subject);
               port != nullptr && port->protocol == PortAccepts::Protocol::kTcp) {
      probe["tcpSocket"]["host"] = port->host;
      probe["tcpSocket"]["port"] = port->port;
    }
    return probe;
  }

  void leave_out_more(const Service& service) {
    const ProcessSpec& spec = *service.spec;
    leave_out_of_containers(service, options_, result_.left_out);
    const auto leave_out = [&](bool is_there, const std::string& what) {
      if (is_there) {
        result_.left_out.push_back({fmt::format("{} of '{}'", what, service.name), spec.origin});
      }
    };
    for (const ServiceBefore& before : service.before) {
      result_.left_out.push_back({before.waits, before.where});
    }
    for (const GeneratedFile& file : spec.files) {
      leave_out(!is_utf8(file.content), "bytes of a parameter file, which is no UTF-8,");
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
