// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/run/run_command.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "actions/builtin_actions.hpp"
#include "base/environment/own_prefix.hpp"
#include "base/files/unique_fd.hpp"
#include "base/monotonic_clock.hpp"
#include "base/processes/outside_number.hpp"
#include "base/terminal/terminal.hpp"
#include "launcher/conditions/condition_watch_process.hpp"
#include "launcher/control/control_socket.hpp"
#include "launcher/control/launch_control.hpp"
#include "launcher/invocation/argument_check.hpp"
#include "launcher/invocation/find_launch_file.hpp"
#include "launcher/language/introspection.hpp"
#include "launcher/machines/machine_connections.hpp"
#include "launcher/machines/machine_runner.hpp"
#include "launcher/plan/dry_run.hpp"
#include "launcher/process/guardian/containment.hpp"
#include "launcher/process/guardian/guardian.hpp"
#include "launcher/process/isolation/namespaces.hpp"
#include "launcher/process/output/old_logs.hpp"
#include "launcher/process/process_messages.hpp"
#include "launcher/process/service_manager.hpp"
#include "launcher/python/interpreter/python_guest.hpp"
#include "launcher/python/interpreter/python_module.hpp"
#include "launcher/python/script/script_runtime.hpp"
#include "launcher/ros/ros_client_process.hpp"
#include "launcher/run/launch_service.hpp"
#include "launcher/run/scopes/launch_tracepoints.hpp"
#include "launcher/run/user/status_line.hpp"
#include "launcher/visit/launch_plan.hpp"
#include "programs/command_line/result_output.hpp"
#include "programs/command_line/subcommand.hpp"
#include "programs/launch/commands.hpp"
#include "programs/launch/run/guarded_process.hpp"
#include "programs/launch/run/launch_facts.hpp"
#include "programs/launch/run/log_cleaner.hpp"
#include "programs/launch/run/output_options.hpp"
#include "programs/launch/run/service_status.hpp"
#include "programs/launch/run/watched_files.hpp"

namespace launch {

namespace {

void set_arguments(const CommandLine& command, LaunchContext& context) {
  std::vector<LaunchContext::NodeLogLevel> levels;
  for (const auto& [node, level] : command.log_levels) {
    levels.push_back({node, level});
  }
  context.set_log_levels(std::move(levels));
  context.machines().set_commands(command.machines);
  if (command.contain || command.isolate) {
    context.machines().refuse(
        fmt::format("a launch with {} can't reach other machines", command.contain ? "--contain" : "--isolate"));
  }
  context.set_wishes({.process_output = command.show_all_output ? "both" : "", .report = command.report});
  Scope& scope = context.scope();
  for (const auto& [name, value] : command.arguments) {
    scope.configurations.insert_or_assign(name, value);
  }
  if (!command.crash_directory.empty()) {
    scope.configurations.insert_or_assign("crash-dir", command.crash_directory);
  }
  if (!command.launch_prefix.empty()) {
    scope.configurations.insert_or_assign("launch-prefix", command.launch_prefix);
  }
  if (!command.launch_prefix_filter.empty()) {
    scope.configurations.insert_or_assign("launch-prefix-filter", command.launch_prefix_filter);
  }
}

std::shared_ptr<const LaunchDescription> load(const CommandLine& command, const Registry& registry,
                                              LaunchContext& context, const std::vector<std::string>& files) {
  std::shared_ptr<const LaunchDescription> description = load_launch_files(files, registry, context.scope());
  return command.trace || command.report ? with_trace(*description, registry) : description;
}

// Throws LaunchError if a problem with the launch arguments is an error, else warns.
void report_arguments(const CommandLine& command, const LaunchDescription& description, const ArgumentList& declared) {
  const Severity severity = command.strict_arguments ? Severity::kError : Severity::kWarning;
  std::vector<Diagnostic> found = check_arguments(command.arguments, description, declared, severity);
  if (command.strict_arguments && !found.empty()) {
    throw LaunchError(std::move(found));
  }
  fmt::print(stderr, "{}", render(found, shows_colour(STDERR_FILENO), "launch"));
}

void print_timing(const std::vector<TimedStep>& steps) {
  fmt::print(stderr, "timing:\n");
  for (const TimedStep& step : steps) {
    fmt::print(stderr, "  {:<36} {:>9.3f} ms\n", step.name,
               std::chrono::duration<double, std::milli>(step.took).count());
  }
}

// Makes everything that a run needs. The order is that of destruction, backwards.
int run(const CommandLine& command, const Registry& registry, const Environment& environment,
        const std::shared_ptr<const LaunchDescription>& description, const std::vector<std::string>& files,
        Guardian& guardian, const Isolation& isolation, const std::optional<ServiceAddress>& service_manager,
        const std::string& chosen_log_directory, TimedStep load_step, LaunchRecord load_record) {
  // A signal that was ignored when we started would never arrive. Shells ignore some for programs in the background.
  // nohup(1) ignores SIGHUP, which stays so.
  for (const int signal : {SIGINT, SIGQUIT, SIGTERM}) {
    ::signal(signal, SIG_DFL);
  }
  ::signal(SIGPIPE, SIG_IGN);

  const LogLimits limits_of_logs = log_limits(command, environment);
  const LogDirectory log_directory = LogDirectory::create(chosen_log_directory);
  const std::unique_ptr<EventLoop> loop = make_sd_event_loop();
  const OutputRouter::Options options = output_options(command, environment, log_directory.path, *loop);
  const std::string log = log_directory.path + "/" + options.log_name;
  OutputRouter output(options);
  output.message(LogLevel::kInfo, "launch", fmt::format("All log files can be found below {}", log_directory.path));
  output.message(LogLevel::kInfo, "launch",
                 fmt::format("Default logging verbosity is set to {}", command.debug ? "DEBUG" : "INFO"));
  if (!log_directory.warning.empty()) {
    output.message(LogLevel::kWarning, "launch", log_directory.warning);
  }

  tell_isolation(command, isolation, output);

  const Namespaces* const namespaces = isolation.namespaces ? &*isolation.namespaces : nullptr;
  const std::unique_ptr<ProcessRunner> runner_here = make_posix_process_runner(default_exec_program(), namespaces);
  MachineConnections machines(*loop, LAUNCH_VERSION, [&output](LogLevel level, const std::string& text) {
    output.message(level, "launch", text);
  });
  const std::unique_ptr<ProcessRunner> runner = make_machine_runner(*runner_here, machines);
  guardian.set_log(log);
  ProcessSupervisor supervisor(*loop, *runner, output);
  supervisor.use_guardian(guardian);
  supervisor.observe(process_messages(output));
  if (options.journal) {
    output.describe_processes([&supervisor](ProcessId id) { return origin_of(supervisor.view(id)); });
  }
  if (const UniqueFd terminal(::open("/dev/tty", O_RDONLY | O_NOCTTY | O_CLOEXEC)); terminal) {
    supervisor.watch_terminal();
  }

  RosClientProcess ros_client(*loop, namespaces);
  ConditionWatchProcess conditions(*loop, guardian.id());
  LaunchContext context(registry, environment, own_prefix(),
                        [&output](LogLevel level, std::string_view logger, std::string_view text) {
                          output.message(level, logger, text);
                        });
  context.scope().log_directory = log_directory.path;
  set_arguments(command, context);
  context.machines().use_connector(machines);

  LaunchTracepoints tracepoints(own_prefix());
  LaunchService service(context, *loop, supervisor, [&output](const LaunchError& error) {
    output.error(render(error.diagnostics(), shows_colour(STDERR_FILENO), "launch"));
  });
  service.use_ros_client(ros_client);
  service.use_condition_watch(conditions);
  service.use_guardian(guardian);
  machines.observe_losses([&service](const LostMachine& lost) { service.on_lost_machine(lost); });
  machines.observe_returns([&service](const ReturnedMachine& returned) { service.on_returned_machine(returned); });
  service.observe_end([&machines] { machines.expect_end(); });
  service.steering().use_reach([&machines](const std::string& machine) { return !machines.is_away(machine); });
  service.give_up_by([&output] {
    output.show_status("");
    end_of_guest();
    ::_exit(EXIT_FAILURE);
  });
  if (const auto variable = environment.find("OVERRIDE_LAUNCH_IGNORE_FAILURES");
      command.ignore_failures || (variable != environment.end() && variable->second == "1")) {
    service.ignore_failures();
  }
  service.record_to(tracepoints);
  service.record(load_record);
  std::optional<ControlSocket> socket;
  std::optional<LaunchControl> control;
  try {
    socket.emplace(RuntimeDirectory::make(environment), guardian);
    control.emplace(*loop, socket->fd().get(), supervisor, service.steering(),
                    launch_facts(command, files, guardian, isolation, log_directory.path, log));
  } catch (const std::system_error& error) {
    output.message(LogLevel::kWarning, "launch",
                   fmt::format("'launch ps' and other commands can't reach this launch: {}", error.what()));
  }
  std::optional<ServiceStatus> service_status;
  if (service_manager) {
    service_status.emplace(*service_manager, *loop, service, supervisor);
  }
  const bool from_standard_input = std::find(files.begin(), files.end(), "-") != files.end();
  if (!files.empty() && !from_standard_input) {
    service.reloads().use([&] { return load(command, registry, context, files); });
  }
  if (control) {
    service.observe_conditions([&control](const ConditionEvent& event) { control->on_condition(event); });
    control->use_reloads(service.reloads());
    control->use_scaling(service.scaling());
  }
  if (command.reload_on_hangup) {
    service.reload_on_hangup();
  }
  std::optional<WatchedFiles> watched;
  if (command.watch) {
    watched.emplace(*loop, service, context, output);
  }
  std::optional<StatusLine> status;
  if (service_status || output.can_show_status()) {
    status.emplace(*loop, supervisor, service.steering(), [&](const std::string& line) {
      output.show_status(line);
      if (service_status) {
        service_status->show(line);
      }
    });
  }
  service.observe_suspension([&status, &machines](bool stops) {
    if (status) {
      status->suspend(stops);
    }
    machines.suspend(stops);
  });
  LogCleaner cleaner(*loop, log_directory, limits_of_logs, output);
  guardian.wait_until_ready();
  const int exit_code = service.run(*description);
  output.show_status("");
  if (command.timing) {
    std::vector<TimedStep> steps = {std::move(load_step)};
    steps.insert(steps.end(), service.timing().begin(), service.timing().end());
    print_timing(steps);
  }
  return exit_code;
}

std::string dry_run(const CommandLine& command, LaunchContext& context, const LaunchDescription& description,
                    const Environment& environment) {
  const LaunchPlan plan = plan_launch(context, description);
  const auto show = command.mode == CommandMode::kDryRunJson    ? plan_as_json
                    : command.mode == CommandMode::kDryRunShell ? plan_as_shell_script
                                                                : plan_as_text;
  return show(plan, environment);
}

}  // namespace

int run_command(const CommandLine& command, Environment environment,
                std::shared_ptr<const LaunchDescription> description) {
  if (command.debug) {
    show_python_tracebacks();
  }
  Isolation isolation;
  std::optional<Guardian> guardian;
  std::optional<ServiceAddress> service_manager;
  std::optional<ScriptOrder> script;
  if (command.mode != CommandMode::kRun) {
    run_python_in_a_guest({std::chrono::seconds(command.python.seconds), command.python.memory});
  }
  if (command.mode == CommandMode::kRun) {
    service_manager = ServiceAddress::take(environment);
    try {
      script = ScriptOrder::take(environment);
    } catch (const std::runtime_error& error) {
      fmt::print(stderr, "{}", command_error("launch", error.what()));
      return 1;
    }
  }
  if (command.mode == CommandMode::kRun) {
    try {
      Containment containment;
      if (command.contain) {
        containment = contain(command);
        keep_proc_of_outside(std::move(containment.proc));
      }
      if (command.isolate) {
        isolation = make_isolation();
      }
      guardian = guard_this_process(command, isolation, std::move(containment));
    } catch (const std::runtime_error& error) {
      fmt::print(stderr, "{}", command_error("launch", error.what()));
      return 1;
    }
  }
  if (isolation.domain) {
    const std::string domain = std::to_string(isolation.domain->id());
    environment.insert_or_assign("ROS_DOMAIN_ID", domain);
    ::setenv("ROS_DOMAIN_ID", domain.c_str(), 1);
  }
  if (script) {
    try {
      use_python_runtime(std::make_unique<ScriptRuntime>(*script));
    } catch (const std::system_error& error) {
      fmt::print(stderr, "{}", command_error("launch", error.what()));
      return 1;
    }
  }
  if (guardian && !script) {
    watch_python(command, *guardian);
  }
  const Registry registry = builtin_actions();
  std::optional<ResultOutput> result;
  if (command.mode != CommandMode::kRun) {
    result.emplace("launch");
  }
  try {
    LaunchContext context(registry, environment, own_prefix(),
                          [](LogLevel, std::string_view logger, std::string_view text) {
                            fmt::print(stderr, "[{}]: {}\n", logger, text);
                          });
    context.scope().log_directory = LogDirectory::choose(environment);
    set_arguments(command, context);

    const std::int64_t begin = monotonic_time();
    std::vector<std::string> files;
    if (description == nullptr) {
      files = find_launch_files(command.target, context.scope(), listed_command_names());
      files.insert(files.begin(), command.machine_files.begin(), command.machine_files.end());
      description = load_launch_files(files, registry, context.scope());
    }
    if (!command.arguments.empty()) {
      report_arguments(command, *description, find_arguments(*description, registry, context.scope()));
    }
    if (command.trace || command.report) {
      description = with_trace(*description, registry);
    }
    const std::int64_t loading = monotonic_time() - begin;
    const TimedStep load = {"load", std::chrono::nanoseconds(loading)};
    switch (command.mode) {
      case CommandMode::kShowArguments:
        result->print(show_arguments(find_arguments(*description, registry, context.scope())));
        return result->finish() ? 0 : 1;
      case CommandMode::kPrint:
        result->print(print_description(*description, registry, context.scope()));
        return result->finish() ? 0 : 1;
      case CommandMode::kDryRunText:
      case CommandMode::kDryRunJson:
      case CommandMode::kDryRunShell:
        result->print(dry_run(command, context, *description, environment));
        return result->finish() ? 0 : 1;
      case CommandMode::kRun:
        return run(command, registry, environment, description, files, *guardian, isolation, service_manager,
                   context.scope().log_directory, load,
                   {.kind = LaunchRecord::Kind::kLoad,
                    .name = description->file == nullptr ? "several files" : description->file->path(),
                    .where = {description->file, 0, 0},
                    .time = begin,
                    .duration = loading});
    }
  } catch (const LaunchError& error) {
    print_errors(error, "launch");
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}", command_error("launch", error.what()));
  }
  return 1;
}

}  // namespace launch
