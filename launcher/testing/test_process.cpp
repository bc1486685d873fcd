// SPDX-License-Identifier: Apache-2.0
#include "launcher/testing/test_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>

#include "base/environment/domain_lease.hpp"
#include "base/environment/own_prefix.hpp"
#include "base/environment/test_run_variables.hpp"
#include "base/processes/process_mark.hpp"
#include "launcher/conditions/condition_watch_process.hpp"
#include "launcher/process/guardian/guardian.hpp"
#include "launcher/process/process_messages.hpp"
#include "launcher/ros/ros_client_process.hpp"
#include "launcher/run/launch_service.hpp"
#include "launcher/run/scopes/launch_tracepoints.hpp"
#include "launcher/run/system_test/test_disks.hpp"
#include "launcher/run/system_test/test_network.hpp"
#include "launcher/testing/artefacts.hpp"
#include "launcher/testing/run_judge.hpp"
#include "launcher/testing/test_result.hpp"
#include "tracing/record/lttng/session_daemon.hpp"

namespace launch {

namespace {

Environment own_surroundings(const TestRun& run, int domain) {
  Environment environment = run.environment;
  environment["ROS_DOMAIN_ID"] = std::to_string(domain);
  environment["LAUNCH_TEST_SEED"] = std::to_string(run.test.seed);
  environment["ROS_HOME"] = run.directory + "/ros";
  environment["ROS_LOG_DIR"] = run.directory + "/log";
  environment["ROS_TRACE_DIR"] = own_trace_directory(run.directory);
  environment[kSessionSuffixVariable] = fmt::format("-{}", ::getpid());
  return environment;
}

// Nothing without faults of the network, or if they can't be applied here; then the result has a failure.
std::optional<TestHosts> make_hosts(const TestRun& run, TestResult& result) {
  if (run.test.network.empty()) {
    return std::nullopt;
  }
  try {
    return TestHosts::make(run.test.network);
  } catch (const std::system_error& error) {
    result.failures.push_back(
        as_text(Failure{.message = fmt::format("faults of the network are not possible here: {}", error.what()),
                        .where = run.test.network.front().where,
                        .help = "they need network namespaces and /dev/net/tun, as root or with user namespaces"}));
    return std::nullopt;
  }
}

// A session daemon that began later would see the disks of the test, as long as it lives.
void begin_session_daemon() {
  try {
    tracing::ensure_session_daemon();
  } catch (const std::exception&) {
    // The recording of the test tells why.
  }
}

// None without faults of disks, or if they can't be applied here; then the result has a failure.
std::unique_ptr<TestDisks> make_disks(const TestRun& run, const Environment& environment,
                                      const std::string& log_directory, TestResult& result) {
  if (!run.test.fills_disk) {
    return nullptr;
  }
  try {
    DiskPlan plan = plan_disks(run.test, run.registry, environment, run.arguments, log_directory);
    if (plan.faults.empty()) {
      return nullptr;  // this run has none: the file reads the environment
    }
    if (run.test.traced) {
      plan.traces.push_back(trace_directory(run.directory));
    }
    if (!plan.traces.empty()) {
      begin_session_daemon();
    }
    return std::make_unique<TestDisks>(
        plan.faults, TestDisks::Places{run.directory, environment.at("ROS_LOG_DIR"), std::move(plan.traces)});
  } catch (const LaunchError& error) {
    for (const Diagnostic& diagnostic : error.diagnostics()) {
      result.failures.push_back(as_text(diagnostic));
    }
    return nullptr;
  }
}

// Makes everything that a run needs. The order is that of destruction, backwards.
void run_launch(const TestRun& run, Guardian& guardian, TestResult& result) {
  const DomainLease domain;
  const Environment environment = own_surroundings(run, domain.id());
  std::filesystem::create_directories(environment.at("ROS_HOME"));
  ::setenv("ROS_DOMAIN_ID", std::to_string(domain.id()).c_str(), 1);
  const LogDirectory log_directory = LogDirectory::create(LogDirectory::choose(environment));

  // While there is one thread. A host has the disks, too.
  const std::unique_ptr<TestDisks> disks = make_disks(run, environment, log_directory.path, result);
  std::optional<TestHosts> hosts = make_hosts(run, result);
  if (!result.failures.empty()) {
    return;
  }
  OutputRouter::Options options;
  options.log_directory = log_directory.path;
  const std::unique_ptr<EventLoop> loop = make_sd_event_loop();
  options.loop = loop.get();
  OutputRouter output(options);
  std::optional<TestNetwork> network;
  if (hosts) {
    network.emplace(*loop, std::move(*hosts));
  }
  const std::unique_ptr<ProcessRunner> runner = make_posix_process_runner(
      default_exec_program(), [&](const ProcessSpec& spec) { return network ? &network->host_of(spec) : nullptr; });
  guardian.set_log(log_directory.path + "/launch.log");

  RosClientProcess ros_client(*loop, network ? &network->common_host() : nullptr);
  ConditionWatchProcess conditions(*loop, guardian.id());
  LaunchContext context(run.registry, environment, own_prefix(),
                        [&output](LogLevel level, std::string_view logger, std::string_view text) {
                          output.message(level, logger, text);
                        });
  context.machines().refuse("launch test can't reach other machines");
  context.scope().log_directory = log_directory.path;
  for (const auto& [name, value] : run.arguments) {
    context.scope().configurations.insert_or_assign(name, value);
  }
  context.scope().configurations.insert_or_assign("crash-dir", crash_directory(run.directory));
  context.tests().take(run.test.number);
  context.tests().choose_faults({run.test.seed, run.test.faults});

  LaunchService* service = nullptr;
  RunJudge judge(*loop, trace_directory(run.directory), [&](const std::string& reason) { service->end(reason); });
  ProcessSupervisor supervisor(*loop, *runner, output);
  supervisor.use_guardian(guardian);
  supervisor.observe(process_messages(output));
  LaunchTracepoints tracepoints(own_prefix());
  LaunchService launch(context, *loop, supervisor, [&](const LaunchError& error) {
    fmt::print(stderr, "{}", render(error.diagnostics()));
    judge.on_error(error);
  });
  service = &launch;
  supervisor.observe([&](const ProcessEvent& event) { judge.on_process(event); });
  launch.use_ros_client(ros_client);
  launch.use_condition_watch(conditions);
  launch.use_guardian(guardian);
  launch.record_to(tracepoints);
  if (network) {
    launch.test().use_network(*network);
  }
  if (disks) {
    launch.test().use_disks(*disks);
  }
  launch.test().use({[&](TestRequest test) {
                       if (test.name == run.test.name) {
                         judge.begin(std::move(test));
                       }
                     },
                     [&](const ProcessSpec& spec, const std::string& label, OutputStream stream,
                         std::string_view line) { judge.on_line(spec, label, stream, line); },
                     [&] { judge.on_shutdown(); }, [&](const FaultEvent& event) { judge.on_fault(event); }});
  launch.test().prepare_by([&](ProcessSpec& spec) { expect_no_crash_bundle(judge.expectations(), spec); });
  guardian.wait_until_ready();
  launch.run(run.test.traced ? *recorded(*run.test.description, run.registry, run.directory, run.test.events)
                             : *run.test.description);
  judge.finish();
  result.failures = judge.failures();
  if (!result.failures.empty()) {
    write_reports(run.directory, judge.pids());
  }
  result.met = judge.met();
  result.not_judged = judge.not_judged();
  result.faults = judge.faults();
}

[[noreturn]] void run_in_child(const TestRun& run) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  TestResult result;
  result.file = run.test.file;
  result.name = run.test.name;
  result.line = run.test.line;
  result.directory = run.directory;
  if (run.test.shows_seed) {
    result.seed = run.test.seed;
  }
  try {
    Guardian guardian = Guardian::put_above({"launch", "test", run.test.file, run.test.name});
    const std::string mark = guardian.mark("launch test", {});
    ::setenv(kMarkVariable, mark.c_str() + std::string_view(kMarkVariable).size() + 1, 1);
    run_launch(run, guardian, result);
  } catch (const std::exception& error) {
    result.failures.push_back({.message = error.what(), .text = fmt::format("error: {}\n", error.what())});
  }
  result.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  const std::string text = to_json(result) + "\n";
  std::ofstream(run.directory + "/result.json") << text;
  for (std::size_t written = 0; written < text.size();) {
    const ssize_t count = ::write(run.result, text.data() + written, text.size() - written);
    if (count < 0 && errno != EINTR) {
      break;  // the one who has started the test tells that there is no result
    }
    written += count > 0 ? static_cast<std::size_t>(count) : 0;
  }
  std::fflush(nullptr);
  ::_exit(0);
}

}  // namespace

pid_t start_test(const TestRun& run) {
  std::fflush(nullptr);
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child < 0) {
    throw std::system_error(errno, std::system_category(), "cannot start the process of a test");
  }
  if (child > 0) {
    return child;
  }
  ::setpgid(0, 0);
  if (::prctl(PR_SET_PDEATHSIG, SIGTERM) != 0 || ::getppid() != parent) {
    ::_exit(1);
  }
  for (const int signal : {SIGINT, SIGQUIT, SIGTERM, SIGHUP, SIGTSTP}) {
    ::signal(signal, SIG_DFL);
  }
  ::signal(SIGPIPE, SIG_IGN);
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  const int input = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  const int output = ::open((run.directory + "/output.txt").c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (input < 0 || output < 0 || ::dup2(input, STDIN_FILENO) < 0 || ::dup2(output, STDOUT_FILENO) < 0 ||
      ::dup2(output, STDERR_FILENO) < 0) {
    ::_exit(1);
  }
  run_in_child(run);
}

}  // namespace launch
