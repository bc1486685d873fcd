// SPDX-License-Identifier: Apache-2.0
// A file for `docker compose` and `podman compose`: a service for each process (https://compose-spec.io).
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "launcher/deploy/container_leave_outs.hpp"
#include "launcher/deploy/deployment.hpp"
#include "launcher/deploy/yaml_text.hpp"

namespace launch {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kUsualShares = 1024.0;  // of a processor; cgroups of version 2 have 100 for that
constexpr double kUsualWeight = 100.0;

// "$" begins a variable of Compose.
std::string compose_text(const std::string& text) {
  std::string result;
  for (const char c : text) {
    result += c == '$' ? "$$" : std::string(1, c);
  }
  return result;
}

// "7.5s"
std::string duration_text(Duration time) {
  return seconds_text(time) + "s";
}

Json compose_limits(const ProcessSpec& spec) {
  Json limits = Json::object();
  const ControlGroupLimits& control = spec.control_limits;
  if (control.memory_max) {
    limits["mem_limit"] = *control.memory_max;
  }
  if (control.cpu_quota) {
    limits["cpus"] = *control.cpu_quota;
  }
  if (control.cpu_weight) {
    limits["cpu_shares"] =
        std::max(std::lround(static_cast<double>(*control.cpu_weight) * kUsualShares / kUsualWeight), 2L);
  }
  if (control.pids_max) {
    limits["pids_limit"] = *control.pids_max;
  }
  if (!spec.limits.cpus.empty()) {
    limits["cpuset"] = cpu_list(spec.limits.cpus);
  }
  if (spec.limits.oom_score_adj) {
    limits["oom_score_adj"] = *spec.limits.oom_score_adj;
  }
  if (spec.limits.open_files) {
    limits["ulimits"]["nofile"] = *spec.limits.open_files;
  }
  if (spec.limits.memory) {
    limits["ulimits"]["data"] = *spec.limits.memory;
  }
  if (spec.limits.core_files) {
    limits["ulimits"]["core"] = -1;
  }
  if (spec.limits.locked_memory) {
    limits["ulimits"]["memlock"] =
        *spec.limits.locked_memory == kUnlimited ? Json(-1) : Json(*spec.limits.locked_memory);
  }
  return limits;
}

// Of one machine.
class ComposeWriter {
 public:
  ComposeWriter(const std::vector<Service>& services, const DeploymentOptions& options)
      : options_(options), services_(services) {
    for (const Service& service : services) {
      health_checks_.push_back(health_check_of(service));
    }
  }

  Deployment write() {
    Json services = Json::object();
    for (std::size_t i = 0; i < services_.size(); ++i) {
      services[services_[i].word] = service_of(i);
    }
    const Json root = {{"services", services}};
    result_.files.insert(result_.files.begin(),
                         {"compose.yaml", fmt::format("{}\n{}", export_mark(options_), as_yaml(root))});
    return std::move(result_);
  }

 private:
  // A command that tells whether the process is healthy; null: there is none.
  Json health_check_of(const Service& service) {
    Json check;
    for (const HealthWatch& watch : service.spec->watches) {
      const auto* const command = std::get_if<CommandSucceeds>(&watch.subject);
      const SourceRange& where = watch.where ? watch.where : service.spec->origin;
      if (command == nullptr || !check.is_null()) {
        result_.left_out.push_back({fmt::format("'{}' is healthy while {}", service.name, describe(watch)), where});
        continue;
      }
      check["test"].push_back("CMD");
      for (const std::string& word : command->argv) {
        check["test"].push_back(compose_text(word));
      }
      check["interval"] = duration_text(watch.interval);
      check["timeout"] = duration_text(watch.timeout);
      check["retries"] = watch.failures;
      check["start_period"] = duration_text(watch.start_period);
      if (watch.reaction != OnUnhealthy::kNothing) {
        result_.left_out.push_back(
            {fmt::format("the {} when '{}' gets unhealthy", to_string(watch.reaction), service.name), where});
      }
    }
    return check;
  }

  Json service_of(std::size_t index) {
    const Service& service = services_[index];
    const ProcessSpec& spec = *service.spec;
    Json json;
    json["image"] = compose_text(options_.image);
    std::vector<std::string> paths;
    for (const std::string& name : service.files) {
      paths.push_back("/launch/parameters/" + name);
      json["volumes"].push_back(fmt::format("./parameters/{}:/launch/parameters/{}:ro", name, name));
      result_.files.push_back(
          {"parameters/" + name, fmt::format("{}\n{}", export_mark(options_), spec.files[paths.size() - 1].content)});
    }
    for (const std::string& word : command_line_of(spec, paths)) {
      json["command"].push_back(compose_text(word));
    }
    if (!spec.working_directory.empty()) {
      json["working_dir"] = compose_text(spec.working_directory);
    }
    for (const auto& [name, value] : variables_of(spec, shell_of(spec, options_), ShellVariables::kSettings).set) {
      json["environment"][name] = compose_text(value);
    }
    // Nodes find each other in the network of the host, and pass messages through its shared memory.
    json["network_mode"] = "host";
    json["ipc"] = "host";
    json["restart"] = restart_of(service);
    json["stop_signal"] = "SIGINT";
    json["stop_grace_period"] = duration_text(spec.sigterm_timeout + spec.sigkill_timeout);
    if (!health_checks_[index].is_null()) {
      json["healthcheck"] = health_checks_[index];
    }
    for (const ServiceBefore& before : service.before) {
      add_order(json, service, before);
    }
    json.update(compose_limits(spec));
    leave_out_of_containers(service, options_, result_.left_out);
    return json;
  }

  std::string restart_of(const Service& service) {
    const RespawnPolicy& respawn = service.spec->respawn;
    if (!respawn.enabled) {
      return "no";
    }
    if (respawn.delay > Duration{0}) {
      leave_out(service, "the respawn delay");
    }
    if (respawn.max_retries >= 0) {
      leave_out(service, "a respawn after exit code 0");
      return fmt::format("on-failure:{}", respawn.max_retries);
    }
    return "always";
  }

  void add_order(Json& json, const Service& service, const ServiceBefore& before) {
    const Service& other = services_[before.service];
    if (before.ended && !before.succeeded) {
      result_.left_out.push_back({before.waits, before.where});
      return;
    }
    const bool is_checked = !health_checks_[before.service].is_null();
    if (before.healthy && !is_checked) {
      result_.left_out.push_back({before.waits + "; the start is what is waited for", before.where});
    }
    json["depends_on"][other.word]["condition"] = before.ended                   ? "service_completed_successfully"
                                                  : before.healthy && is_checked ? "service_healthy"
                                                                                 : "service_started";
    if (before.wanted) {
      json["depends_on"][other.word]["required"] = false;
    }
    if (before.ends_all) {
      result_.left_out.push_back(
          {fmt::format("the end of all if '{}' can't start, because of '{}'", service.name, other.name), before.where});
    }
  }

  void leave_out(const Service& service, const std::string& what) {
    result_.left_out.push_back({fmt::format("{} of '{}'", what, service.name), service.spec->origin});
  }

  const DeploymentOptions& options_;
  const std::vector<Service>& services_;
  std::vector<Json> health_checks_;  // of each service
  Deployment result_;
};

}  // namespace

Deployment as_compose_file(const LaunchPlan& plan, const DeploymentOptions& options) {
  return deploy_parts(plan, options, [](const std::vector<Service>& services, const DeploymentOptions& there) {
    return ComposeWriter(services, there).write();
  });
}

}  // namespace launch
