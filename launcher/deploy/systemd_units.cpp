// SPDX-License-Identifier: Apache-2.0
// A unit for each process and a target for all (systemd.service(5), systemd.target(5)).
#include <fmt/format.h>
#include <sched.h>
#include <signal.h>
#include <string.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <system_error>

#include "base/text/utf8.hpp"
#include "launcher/deploy/deployment.hpp"
#include "launcher/deploy/systemd_text.hpp"
#include "launcher/deploy/systemd_watch.hpp"
#include "launcher/process/spawn/program_search.hpp"

namespace launch {
namespace {

namespace fs = std::filesystem;

constexpr double kPercent = 100.0;

// "SIGTERM", "RTMIN+2"
std::string signal_text(int signal) {
  const char* const name = ::sigabbrev_np(signal);
  return name != nullptr ? fmt::format("SIG{}", name) : fmt::format("RTMIN+{}", signal - SIGRTMIN);
}

// Of one machine.
class UnitWriter {
 public:
  UnitWriter(const std::vector<Service>& services, const DeploymentOptions& options)
      : options_(options), services_(services), target_(unit_name(options.name) + ".target") {}

  Deployment write() {
    // Whoever is waited for until it has ended is a unit that is "activating" for so long.
    for (const Service& service : services_) {
      for (const ServiceBefore& before : service.before) {
        if (before.ended) {
          awaited_.insert(before.service);
        }
        if (before.ends_all) {
          (before.ended ? ends_all_by_failure_ : ends_all_unless_it_starts_).insert(before.service);
        }
      }
    }
    for (std::size_t i = 0; i < services_.size(); ++i) {
      watches_.push_back(systemd_watch_of(services_[i], awaited_.contains(i)));
    }
    std::string wants;
    for (std::size_t i = 0; i < services_.size(); ++i) {
      wants += fmt::format("Wants={}\n", write_service(i));
    }
    result_.files.insert(result_.files.begin(),
                         {target_, fmt::format("{}\n[Unit]\nDescription={}\n{}\n[Install]\nWantedBy={}\n",
                                               export_mark(options_), systemd_line(options_.name), wants,
                                               options_.of_user ? "default.target" : "multi-user.target")});
    return std::move(result_);
  }

 private:
  void leave_out(const Service& service, const std::string& what) {
    result_.left_out.push_back({fmt::format("{} of '{}'", what, service.name), service.spec->origin});
  }

  std::string unit_of(const Service& service) const {
    return fmt::format("{}-{}.service", unit_name(options_.name), service.word);
  }

  // Returns what the target wants: the unit, or the timer that starts it.
  std::string write_service(std::size_t index) {
    const Service& service = services_[index];
    const std::string unit = unit_of(service);
    std::string text = fmt::format("{}\n# {}\n[Unit]\nDescription={}\nPartOf={}\n", export_mark(options_),
                                   systemd_line(to_string(service.spec->origin)), systemd_line(service.name), target_);
    text += order_of(service) + start_limit_of(service);
    const SystemdWatch& watch = watches_[index];
    result_.left_out.insert(result_.left_out.end(), watch.left_out.begin(), watch.left_out.end());
    text += "\n[Service]\n" + command_of(index) + watch.settings + restarts_of(service, watch) + end_of_all(index) +
            limits_of_service(service);
    result_.files.push_back({unit, text});
    write_slices(*service.spec);
    if (service.delay <= Duration{0}) {
      return unit;
    }
    const std::string timer = unit.substr(0, unit.rfind('.')) + ".timer";
    result_.files.push_back(
        {timer, fmt::format("{}\n[Unit]\nDescription=starts {}\nPartOf={}\n\n[Timer]\nOnActiveSec={}\n"
                            "AccuracySec=1ms\nRemainAfterElapse=no\n",
                            export_mark(options_), systemd_line(service.name), target_, seconds_text(service.delay))});
    return timer;
  }

  std::string order_of(const Service& service) {
    std::string text;
    for (const ServiceBefore& before : service.before) {
      if (before.healthy && !watches_[before.service].notifies) {
        result_.left_out.push_back({before.waits + "; the start is what is waited for", before.where});
      }
      const std::string other = unit_of(services_[before.service]);
      const bool must = !before.wanted && (!before.ended || before.succeeded);
      text += fmt::format("After={}\n{}={}\n", other, must ? "Requires" : "Wants", other);
    }
    return text;
  }

  std::string start_limit_of(const Service& service) {
    const ProcessSpec& spec = *service.spec;
    if (spec.start_limit.starts > 0) {
      if (spec.respawn.enabled && spec.respawn.max_retries >= 0) {
        leave_out(service, "the limit of respawns, beside that of starts,");
      }
      return fmt::format("StartLimitIntervalSec={}\nStartLimitBurst={}\n", seconds_text(spec.start_limit.within),
                         spec.start_limit.starts);
    }
    if (spec.respawn.enabled && spec.respawn.max_retries >= 0) {
      return fmt::format("StartLimitIntervalSec=infinity\nStartLimitBurst={}\n", spec.respawn.max_retries + 1);
    }
    return "StartLimitIntervalSec=0\n";
  }

  std::string command_of(std::size_t index) {
    const Service& service = services_[index];
    const ProcessSpec& spec = *service.spec;
    std::vector<std::string> paths;
    for (std::size_t i = 0; i < service.files.size(); ++i) {
      const std::string path = "parameters/" + unit_name(options_.name) + "/" + service.files[i];
      result_.files.push_back({path, fmt::format("{}\n{}", export_mark(options_), spec.files[i].content)});
      paths.push_back(options_.install_directory + "/" + path);
    }
    // A unit that has only been asked to start is "started" for its order: as soon as the program runs.
    std::string text = awaited_.contains(index)   ? "Type=oneshot\nRemainAfterExit=yes\n"
                       : watches_[index].notifies ? "Type=notify\n"
                                                  : "Type=exec\n";
    const std::string directory = directory_of(spec);
    std::vector<std::string> words = command_line_of(spec, paths);
    const std::string program = spec.shell ? words.front() : program_of(spec, directory);
    const bool is_plain_directory = directory == "~" || is_systemd_path(directory);
    words.front() = program;
    if (!spec.machine.empty() && directory != "~" && !directory.starts_with('/')) {
      leave_out(service, fmt::format("the working directory {}, which is no absolute path,", directory));
    }
    if (!is_plain_directory) {
      words.insert(words.begin(), {"/bin/sh", "-c", "cd -- \"$0\" && exec \"$@\"", directory});
    } else if (is_systemd_path(program)) {
      words.front() = fs::path(program).lexically_normal();
    } else if (program.find('/') != std::string::npos || !spec.machine.empty()) {
      words.insert(words.begin(), {"/bin/sh", "-c", "exec \"$0\" \"$@\""});
    }
    text += "ExecStart=";
    for (const std::string& word : words) {
      text += (text.back() == '=' ? "" : " ") + systemd_quoted(word, true);
    }
    text += "\n";
    if (is_plain_directory) {
      text += fmt::format("WorkingDirectory={}\n", systemd_line(directory));
    }
    if (!options_.user.empty()) {
      text += fmt::format("User={}\n", options_.user);
    }
    const ServiceVariables variables = variables_of(spec, shell_of(spec, options_), ShellVariables::kAll);
    for (const auto& [name, value] : variables.set) {
      if (!is_utf8(value)) {
        leave_out(service, fmt::format("the variable '{}', which is no UTF-8,", name));
        continue;
      }
      text += fmt::format("Environment={}\n", systemd_quoted(name + "=" + value, false));
    }
    for (const std::string& name : variables.removed) {
      text += fmt::format("UnsetEnvironment={}\n", name);
    }
    return text;
  }

  // Of another machine: what its user has as home, in which a connecting command begins, too.
  std::string directory_of(const ProcessSpec& spec) const {
    if (!spec.machine.empty()) {
      return spec.working_directory.empty() ? "~" : spec.working_directory;
    }
    return spec.working_directory.empty() ? options_.working_directory
                                          : (fs::path(options_.working_directory) / spec.working_directory).string();
  }

  // Where it is now; as it was given if it is not there, or on another machine. The search of systemd knows folders of
  // its own only.
  static std::string program_of(const ProcessSpec& spec, const std::string& directory) {
    fs::path program = spec.argv.front();
    if (!spec.machine.empty()) {
      return program;
    }
    try {
      program = find_program(spec);
    } catch (const std::system_error&) {
      if (program.native().find('/') == std::string::npos) {
        return program;
      }
    }
    return fs::path(directory) / program;
  }

  std::string restarts_of(const Service& service, const SystemdWatch& watch) {
    const ProcessSpec& spec = *service.spec;
    // The end of a launch is SIGINT, then SIGTERM, then SIGKILL. systemd has two of these.
    std::string text = fmt::format("KillSignal=SIGINT\nTimeoutStopSec={}\n", seconds_text(stop_timeout_of(spec)));
    if (spec.respawn.enabled) {
      text += fmt::format("Restart=always\nRestartSec={}\n", seconds_text(spec.respawn.delay));
      if (spec.respawn.backoff != 1.0) {
        leave_out(service, "the growing delay of the respawns");
      }
    } else if (watch.restarts) {
      text += "Restart=on-watchdog\nRestartSec=0\n";
    }
    if (spec.allowed_exits.any) {
      leave_out(service, "the permission to end with any exit code");
    } else if (!spec.allowed_exits.codes.empty()) {
      text += "SuccessExitStatus=";
      for (const int code : spec.allowed_exits.codes) {
        text +=
            fmt::format("{}{}", text.back() == '=' ? "" : " ", code < 0 ? signal_text(-code) : std::to_string(code));
      }
      text += "\n";
    }
    return text;
  }

  // What stops the target when the service has ended: any end of a required one, a failure of one that another waits
  // for, or a program that can't be executed (systemd.exec(5): 203), for which somebody waits, too.
  std::string end_of_all(std::size_t index) const {
    const ProcessSpec& spec = *services_[index].spec;
    const std::string stop = fmt::format("systemctl {}--no-block stop {}", options_.of_user ? "--user " : "", target_);
    const char* const rights = options_.of_user ? "" : "+";
    if (spec.required || spec.shutdown_on_exit) {
      return fmt::format("ExecStopPost={}{}\n", rights, stop);
    }
    const std::string as_shell = fmt::format("ExecStopPost={}/bin/sh -c ", rights);
    if (ends_all_by_failure_.contains(index)) {
      return as_shell + fmt::format("'test \"$$SERVICE_RESULT\" = success || {}'\n", stop);
    }
    std::string commands;
    if (watches_[index].ends_all) {
      commands += as_shell + fmt::format("'case \"$$SERVICE_RESULT\" in watchdog|timeout) {};; esac'\n", stop);
    }
    if (ends_all_unless_it_starts_.contains(index)) {
      commands += as_shell + fmt::format("'test \"$$EXIT_STATUS\" != 203 || {}'\n", stop);
    }
    return commands;
  }

  std::string limits_of_service(const Service& service) {
    const ResourceLimits& limits = service.spec->limits;
    std::string text;
    const auto add = [&](const char* key, const auto& value) {
      if (value) {
        text += fmt::format("{}={}\n", key, *value);
      }
    };
    add("Nice", limits.niceness);
    if (limits.policy == kDeadlinePolicy) {
      leave_out(service, "the scheduling policy deadline");
    } else if (limits.policy) {
      text += fmt::format("CPUSchedulingPolicy={}\n", scheduling_policy_name(*limits.policy));
      if (*limits.policy == SCHED_FIFO || *limits.policy == SCHED_RR) {
        text += fmt::format("CPUSchedulingPriority={}\n", limits.priority);
      }
    }
    if (!limits.cpus.empty()) {
      text += fmt::format("CPUAffinity={}\n", cpu_list(limits.cpus));
    }
    add("LimitDATA", limits.memory);
    add("LimitNOFILE", limits.open_files);
    if (limits.core_files) {
      text += "LimitCORE=infinity\n";
    }
    if (limits.timer_slack) {
      text += fmt::format("TimerSlackNSec={}\n", limits.timer_slack->count());
    }
    add("OOMScoreAdjust", limits.oom_score_adj);
    if (limits.locked_memory) {
      text += *limits.locked_memory == kUnlimited ? std::string("LimitMEMLOCK=infinity\n")
                                                  : fmt::format("LimitMEMLOCK={}\n", *limits.locked_memory);
    }
    if (const std::string slice = slice_of(service.spec->control_groups); !slice.empty()) {
      text += fmt::format("Slice={}\n", slice);
    }
    return text + control_limits(service.spec->control_limits);
  }

  static std::string control_limits(const ControlGroupLimits& limits) {
    std::string text;
    const auto add = [&](const char* key, const auto& value) {
      if (value) {
        text += fmt::format("{}={}\n", key, *value);
      }
    };
    add("MemoryMax", limits.memory_max);
    add("MemoryHigh", limits.memory_high);
    if (limits.cpu_quota) {
      text += fmt::format("CPUQuota={}%\n", std::max(std::lround(*limits.cpu_quota * kPercent), 1L));
    }
    add("CPUWeight", limits.cpu_weight);
    add("IOWeight", limits.io_weight);
    add("TasksMax", limits.pids_max);
    return text;
  }

  // The slice of the innermost group: "robot-1-2.slice" is one in "robot-1.slice", in "robot.slice".
  std::string slice_of(const std::vector<std::shared_ptr<const ControlGroup>>& groups) {
    if (groups.empty()) {
      return "";
    }
    std::string name = unit_name(options_.name);
    std::replace(name.begin(), name.end(), '-', '_');
    for (const auto& group : groups) {
      name += fmt::format("-{}", slices_.try_emplace(group.get(), slices_.size() + 1).first->second);
    }
    return name + ".slice";
  }

  void write_slices(const ProcessSpec& spec) {
    for (std::size_t depth = 1; depth <= spec.control_groups.size(); ++depth) {
      const ControlGroup& group = *spec.control_groups[depth - 1];
      if (written_.insert(&group).second) {
        result_.files.push_back({slice_of({spec.control_groups.begin(), spec.control_groups.begin() + depth}),
                                 fmt::format("{}\n# {}\n[Slice]\n{}", export_mark(options_),
                                             systemd_line(to_string(group.where)), control_limits(group.limits))});
      }
    }
  }

  const DeploymentOptions& options_;
  const std::vector<Service>& services_;
  const std::string target_;
  std::vector<SystemdWatch> watches_;  // of each service
  std::set<std::size_t> awaited_;
  std::set<std::size_t> ends_all_by_failure_;
  std::set<std::size_t> ends_all_unless_it_starts_;
  std::map<const ControlGroup*, std::size_t> slices_;
  std::set<const ControlGroup*> written_;
  Deployment result_;
};

}  // namespace

Deployment as_systemd_units(const LaunchPlan& plan, const DeploymentOptions& options) {
  return deploy_parts(plan, options, [](const std::vector<Service>& services, const DeploymentOptions& there) {
    return UnitWriter(services, there).write();
  });
}

}  // namespace launch
