// SPDX-License-Identifier: Apache-2.0
#include "launcher/testing/test_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "base/diagnostics/diagnostic.hpp"
#include "base/environment/home_directory.hpp"
#include "base/environment/own_prefix.hpp"
#include "base/environment/test_run_variables.hpp"
#include "launcher/invocation/find_launch_file.hpp"
#include "launcher/substitution/package_index.hpp"
#include "launcher/testing/checks/trace_check.hpp"
#include "launcher/visit/launch_plan.hpp"
#include "launcher/visit/process_table.hpp"

namespace launch {

namespace fs = std::filesystem;

namespace {

bool may_hold_test(const fs::path& path) {
  const std::string name = path.filename().string();
  const bool is_xml = name.ends_with(".xml");
  if (!is_xml && !name.ends_with(".yaml") && !name.ends_with(".yml")) {
    return false;
  }
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const bool is_launch_file = text.find(is_xml ? "<launch" : "launch:") != std::string::npos;
  return is_launch_file && text.find(is_xml ? "<test" : "test:") != std::string::npos;
}

std::vector<std::string> search(const std::string& directory) {
  std::vector<std::string> found;
  std::error_code unreadable;
  for (const fs::directory_entry& entry :
       fs::recursive_directory_iterator(directory, fs::directory_options::skip_permission_denied, unreadable)) {
    if (entry.is_regular_file(unreadable) && may_hold_test(entry.path())) {
      found.push_back(entry.path().string());
    }
  }
  std::sort(found.begin(), found.end());
  if (found.empty()) {
    throw LaunchError(fmt::format("no launch file below '{}' has a test", directory), {});
  }
  return found;
}

// A visit of the file with the tests in it.
LaunchPlan plan_of(const LaunchDescription& description, const Registry& registry, const Environment& environment,
                   const LaunchArguments& arguments, std::optional<std::size_t> chosen,
                   const std::string& log_directory) {
  LaunchContext context(registry, environment, own_prefix(), [](LogLevel, std::string_view, std::string_view) {});
  context.scope().log_directory = log_directory;
  for (const auto& [name, value] : arguments) {
    context.scope().configurations.insert_or_assign(name, value);
  }
  context.tests().take(chosen);
  return plan_launch(context, description);
}

// A launch file whose tests are looked for.
struct TestFile {
  TestFile(const std::string& path, const Registry& with, const Environment& in, const LaunchArguments& given)
      : file(path), registry(with), environment(with_variables_of_a_test_run(in)), arguments(given) {
    Scope scope;
    scope.environment = environment;
    scope.packages = std::make_shared<PackageIndex>(own_prefix());
    description = load_launch_files({file}, registry, scope);
  }

  // `chosen` as in TestVisits::take().
  LaunchPlan plan(std::optional<std::size_t> chosen) const {
    return plan_of(*description, registry, environment, arguments, chosen, {});
  }

  TestCase test_case(const TestRequest& test, std::size_t number) const;

  const std::string& file;
  const Registry& registry;
  const Environment environment;
  const LaunchArguments& arguments;
  std::shared_ptr<const LaunchDescription> description;
};

void add_names(const LaunchPlan& plan, std::set<std::string>& names, bool& is_complete) {
  for (const ProcessSpec& spec : plan.processes) {
    const std::vector<std::string> more = names_of(spec);
    names.insert(more.begin(), more.end());
  }
  is_complete = is_complete && plan.left_to_run.empty() && plan.coroutines.empty();
  for (const LaunchPlan& reaction : plan.reactions) {
    add_names(reaction, names, is_complete);
  }
}

// "talker" of "talker-2".
std::string without_number(const std::string& label) {
  const std::size_t dash = label.rfind('-');
  const bool has_number = dash != std::string::npos && dash + 1 < label.size() &&
                          label.find_first_not_of("0123456789", dash + 1) == std::string::npos;
  return has_number ? label.substr(0, dash) : label;
}

std::vector<NetworkFault::Member> network_of(const TestRequest& test) {
  std::vector<NetworkFault::Member> members;
  for (const FaultRequest& fault : test.faults) {
    if (const auto* const network = std::get_if<NetworkFault>(&fault.what)) {
      members.insert(members.end(), network->group.begin(), network->group.end());
      members.insert(members.end(), network->from.begin(), network->from.end());
    }
  }
  return members;
}

std::vector<DiskFault> disks_of(const TestRequest& test) {
  std::vector<DiskFault> disks;
  for (const FaultRequest& fault : test.faults) {
    if (const auto* const disk = std::get_if<DiskFault>(&fault.what)) {
      disks.push_back(*disk);
    }
  }
  return disks;
}

void check_names(const TestRequest& test, const LaunchPlan& plan, std::vector<Diagnostic>& errors) {
  std::set<std::string> names;
  bool is_complete = true;
  add_names(plan, names, is_complete);
  if (!is_complete) {
    return;  // what a function of a Python launch file starts is not known
  }
  const auto check = [&](const std::string& name, const SourceRange& where) {
    if (!name.empty() && !names.contains(name) && !names.contains(without_number(name))) {
      errors.push_back({Severity::kError, fmt::format("no process is named '{}'", name), where,
                        did_you_mean(name, {names.begin(), names.end()}), Finding::kUnknownProcess});
    }
  };
  for (const Expectation& expectation : test.expectations) {
    check(expectation.process, expectation.process_where);
    const auto* const trace = std::get_if<TraceExpectation>(&expectation.what);
    if (const auto* const order = trace == nullptr ? nullptr : std::get_if<ExpectedEventOrder>(trace)) {
      for (const ExpectedEventOrder::Step& step : order->steps) {
        check(step.process, step.process_where);
      }
    }
  }
  for (const FaultRequest& fault : test.faults) {
    check(fault.process, fault.process_where);
  }
  for (const NetworkFault::Member& member : network_of(test)) {
    check(member.name, member.where);
  }
}

// Events that the session of a test must be asked for, because they are not of ROS 2.
std::vector<std::string> other_events(const TestRequest& test) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    if (!name.starts_with("ros2:") && !name.starts_with("ros2_ext:") && !name.starts_with("launch:")) {
      names.push_back(name);
    }
  };
  for (const Expectation& expectation : test.expectations) {
    const auto* const trace = std::get_if<TraceExpectation>(&expectation.what);
    if (trace == nullptr) {
      continue;
    }
    if (const auto* const event = std::get_if<ExpectedEvent>(trace)) {
      add(event->name);
    } else if (const auto* const order = std::get_if<ExpectedEventOrder>(trace)) {
      for (const ExpectedEventOrder::Step& step : order->steps) {
        add(step.event.name);
      }
    } else if (std::holds_alternative<ExpectedAllocations>(*trace)) {
      add("lttng_ust_libc:*");
    }
  }
  return names;
}

TestCase TestFile::test_case(const TestRequest& test, std::size_t number) const {
  return {.file = file,
          .description = description,
          .number = number,
          .name = test.name,
          .line = test.where ? test.where.file->position(test.where.begin).line : 0,
          .where = test.where,
          .timeout = test.timeout,
          .traced = test.is_traced(),
          .events = other_events(test),
          .fault_count = test.faults.size(),
          .network = network_of(test),
          .fills_disk = !disks_of(test).empty(),
          .shows_seed = !test.faults.empty()};
}

}  // namespace

std::vector<std::string> find_test_files(const std::vector<std::string>& words, const Scope& scope) {
  std::error_code ignored;
  if (std::none_of(words.begin(), words.end(), [&](const auto& word) { return fs::is_directory(word, ignored); })) {
    return find_launch_files(words, scope);
  }
  std::vector<std::string> files;
  for (const std::string& word : words) {
    const std::vector<std::string> found =
        fs::is_directory(word, ignored) ? search(word) : find_launch_files({word}, scope);
    files.insert(files.end(), found.begin(), found.end());
  }
  return files;
}

std::vector<TestCase> list_tests(const std::string& file, const Registry& registry, const Environment& environment,
                                 const LaunchArguments& arguments, ProcessNames process_names) {
  const TestFile tests_of(file, registry, environment, arguments);
  const LaunchPlan all = tests_of.plan(std::nullopt);
  if (all.tests.empty()) {
    throw LaunchError("the launch file has no test", SourceRange{tests_of.description->file, 0, 0},
                      "a test says what must happen: <test name=\"…\"><output text=\"…\"/></test>");
  }
  std::vector<TestCase> tests;
  std::set<std::string> names;
  std::vector<Diagnostic> errors;
  for (const TestRequest& test : all.tests) {
    if (!names.insert(test.name).second) {
      errors.push_back({Severity::kError, fmt::format("two tests are named '{}'", test.name), test.name_where,
                        "in a loop, put $(index …) or $(for-var …) into the name", Finding::kNone});
    }
    for (const Expectation& expectation : test.expectations) {
      try {
        check_trace_expectation(expectation);
      } catch (const LaunchError& error) {
        errors.insert(errors.end(), error.diagnostics().begin(), error.diagnostics().end());
      }
    }
    // A test without actions starts what the file starts. So a file of many such tests is visited once.
    const std::optional<LaunchPlan> own = test.has_actions ? std::optional(tests_of.plan(tests.size())) : std::nullopt;
    const TestRequest& same = own ? own->tests.front() : test;
    if (process_names == ProcessNames::kOfLaunchFile) {
      check_names(same, own ? *own : all, errors);
    }
    tests.push_back(tests_of.test_case(same, tests.size()));
    tests.back().is_only = all.tests.size() == 1;
  }
  if (!errors.empty()) {
    throw LaunchError(std::move(errors));
  }
  return tests;
}

TestCase find_test(const std::string& file, const Registry& registry, const Environment& environment,
                   const LaunchArguments& arguments, std::size_t number, const std::string& name) {
  const TestFile tests_of(file, registry, environment, arguments);
  const LaunchPlan whole = tests_of.plan(number);
  if (whole.tests.empty() || whole.tests.front().name != name) {
    throw LaunchError(fmt::format("test {} of the launch file is not '{}' here", number + 1, name),
                      SourceRange{tests_of.description->file, 0, 0});
  }
  return tests_of.test_case(whole.tests.front(), number);
}

TestRequest request_of(const TestCase& test, const Registry& registry, const Environment& environment,
                       const LaunchArguments& arguments) {
  LaunchPlan plan =
      plan_of(*test.description, registry, with_variables_of_a_test_run(environment), arguments, test.number, {});
  return std::move(plan.tests.at(0));
}

DiskPlan plan_disks(const TestCase& test, const Registry& registry, const Environment& environment,
                    const LaunchArguments& arguments, const std::string& log_directory) {
  const LaunchPlan plan = plan_of(*test.description, registry, environment, arguments, test.number, log_directory);
  DiskPlan disks;
  if (!plan.tests.empty()) {
    disks.faults = disks_of(plan.tests.front());
  }
  for (const std::unique_ptr<RunScope>& scope : plan.scopes) {
    for (const ShownSetting& setting : scope->describe()) {
      const auto* const directory = std::get_if<std::string>(&setting.value);
      if (setting.name == "trace-directory" && directory != nullptr) {
        disks.traces.push_back(*directory);
      }
    }
  }
  return disks;
}

}  // namespace launch
