// SPDX-License-Identifier: Apache-2.0
// `launch test FILE|DIRECTORY…`: runs the tests of launch files. `launch` executes this program.
#include <fmt/format.h>
#include <fnmatch.h>
#include <signal.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <thread>

#include "actions/builtin_actions.hpp"
#include "base/environment/home_directory.hpp"
#include "base/environment/own_environment.hpp"
#include "base/environment/own_prefix.hpp"
#include "base/terminal/terminal.hpp"
#include "launcher/invocation/argument_check.hpp"
#include "launcher/language/introspection.hpp"
#include "launcher/substitution/package_index.hpp"
#include "launcher/substitution/template_parser.hpp"
#include "launcher/testing/engine_task.hpp"
#include "launcher/testing/finished_trace.hpp"
#include "launcher/testing/launch_testing_files.hpp"
#include "launcher/testing/result_files.hpp"
#include "launcher/testing/seeds.hpp"
#include "launcher/testing/shrink.hpp"
#include "launcher/testing/test_files.hpp"
#include "launcher/testing/test_queue.hpp"
#include "launcher/testing/test_report.hpp"
#include "programs/command_line/subcommand.hpp"

namespace launch {

namespace fs = std::filesystem;

namespace {

constexpr int kInterrupted = 130;

struct Options {
  LaunchTarget target;
  std::string jobs;
  std::vector<std::string> names;
  bool list = false;
  std::string directory;
  bool keep = false;
  std::string junit;
  std::string tap;
  std::string json;
  bool github = false;
  std::string repeat;
  bool until_failure = false;
  std::string retries;
  std::string shard;
  std::string engine;
  SeedOptions seeds;
  bool shrink = false;
  std::vector<std::string> traces;
  bool skip_others = false;
};

std::vector<TestCase> list_all(const Options& options, const Registry& registry, const Environment& environment) {
  Scope scope;
  scope.environment = environment;
  scope.packages = std::make_shared<PackageIndex>(own_prefix());
  std::vector<TestCase> tests;
  std::vector<Diagnostic> errors;
  const std::vector<std::string> files = find_test_files(options.target.words, scope);
  for (const std::string& file : files) {
    try {
      const ProcessNames names = options.traces.empty() ? ProcessNames::kOfLaunchFile : ProcessNames::kAny;
      std::vector<TestCase> found = list_tests(file, registry, environment, options.target.arguments, names);
      // Of several files, each may declare other arguments.
      if (files.size() == 1 && !options.target.arguments.empty()) {
        const LaunchDescription& description = *found.front().description;
        fmt::print(stderr, "{}",
                   render(check_arguments(options.target.arguments, description,
                                          find_arguments(description, registry, scope), Severity::kWarning),
                          shows_colour(STDERR_FILENO), "launch test"));
      }
      std::move(found.begin(), found.end(), std::back_inserter(tests));
    } catch (const LaunchError& error) {
      errors.insert(errors.end(), error.diagnostics().begin(), error.diagnostics().end());
    }
  }
  if (!errors.empty()) {
    throw LaunchError(std::move(errors));
  }
  return tests;
}

void keep_named(const std::vector<std::string>& patterns, std::vector<TestCase>& tests) {
  if (patterns.empty()) {
    return;
  }
  std::vector<std::string> names;
  for (const TestCase& test : tests) {
    names.push_back(test.name);
  }
  const auto matches = [](const std::string& pattern, const std::string& name) {
    return ::fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
  };
  for (const std::string& pattern : patterns) {
    if (std::none_of(names.begin(), names.end(), [&](const auto& name) { return matches(pattern, name); })) {
      throw LaunchError(fmt::format("no test is named '{}'", pattern), {}, did_you_mean(pattern, names));
    }
  }
  std::erase_if(tests, [&](const TestCase& test) {
    return std::none_of(patterns.begin(), patterns.end(),
                        [&](const std::string& pattern) { return matches(pattern, test.name); });
  });
}

// "2/5": the second of five parts.
void keep_shard(const std::string& text, std::vector<TestCase>& tests) {
  if (text.empty()) {
    return;
  }
  const std::size_t slash = std::min(text.find('/'), text.size());
  const std::size_t part = whole_number(text.substr(0, slash), "--shard I/N");
  const std::size_t parts = whole_number(slash < text.size() ? text.substr(slash + 1) : "", "--shard I/N");
  if (part > parts) {
    throw UsageError(fmt::format("--shard {}: there are only {} parts", text, parts));
  }
  std::size_t number = 0;
  std::erase_if(tests, [&](const TestCase&) { return number++ % parts != part - 1; });
}

std::vector<std::string> words_of(const std::string& command) {
  std::vector<std::string> words;
  if (command.empty()) {
    return words;
  }
  Scope nothing;
  for (const Template& word : split_command_line(parse_template(LocatedText(command)))) {
    words.push_back(word.perform(nothing));
  }
  if (words.empty()) {
    throw UsageError("--engine takes a command, got an empty one");
  }
  return words;
}

// "DIR/2026-05-04-12-30-59-4711" below the home of ROS.
std::string default_directory(const Environment& environment) {
  const std::time_t now = ::time(nullptr);
  tm local{};
  ::localtime_r(&now, &local);
  std::array<char, 32> date{};
  std::strftime(date.data(), date.size(), "%Y-%m-%d-%H-%M-%S", &local);
  return fmt::format("{}/test/{}-{}", ros_home(environment), date.data(), ::getpid());
}

// False when it can't be written; that is told.
bool write(const std::string& path, const std::string& text) {
  if (path.empty()) {
    return true;
  }
  std::error_code ignored;
  if (const fs::path folder = fs::path(path).parent_path(); !folder.empty()) {
    fs::create_directories(folder, ignored);
  }
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) {
    fmt::print(stderr, "{}", command_error("launch test", fmt::format("can't write '{}'", path)));
  }
  return static_cast<bool>(file);
}

bool write_results(const Options& options, const std::vector<TestResult>& results) {
  const bool junit = options.junit.empty() || write(options.junit, as_junit(results));
  const bool tap = options.tap.empty() || write(options.tap, as_tap(results));
  const bool json = options.json.empty() || write(options.json, as_json(results));
  return junit && tap && json;
}

// Files of launch_testing have a program of their own.
void run_if_launch_testing(const Options& options) {
  const std::vector<std::string>& files = options.target.words;
  const auto is_one = [](const std::string& file) { return is_launch_testing_file(file); };
  const auto first = std::find_if(files.begin(), files.end(), is_one);
  if (first == files.end()) {
    return;
  }
  if (!std::all_of(files.begin(), files.end(), is_one)) {
    throw UsageError(fmt::format("'{}' is a file of launch_testing: such files run without others", *first));
  }
  const bool has_options =
      !options.jobs.empty() || !options.names.empty() || options.list || !options.directory.empty() || options.keep ||
      !options.tap.empty() || !options.json.empty() || options.github || !options.repeat.empty() ||
      options.until_failure || !options.retries.empty() || !options.shard.empty() || !options.engine.empty() ||
      !options.seeds.seed.empty() || !options.seeds.seeds.empty() || !options.seeds.faults.empty() || options.shrink ||
      !options.traces.empty() || options.skip_others;
  if (has_options) {
    throw UsageError(fmt::format("'{}' is a file of launch_testing: of the options only --junit goes with it", *first));
  }
  run_launch_testing_files(files, options.target.arguments, options.junit);
}

// Options that say how tests run do not go with a trace of a run that is over.
void check_trace_options(const Options& options) {
  if (options.traces.empty()) {
    if (options.skip_others) {
      throw UsageError("--skip-others needs --trace DIR");
    }
    return;
  }
  const std::pair<const char*, bool> others[] = {{"--jobs", !options.jobs.empty()},
                                                 {"--directory", !options.directory.empty()},
                                                 {"--keep", options.keep},
                                                 {"--repeat", !options.repeat.empty()},
                                                 {"--until-failure", options.until_failure},
                                                 {"--retries", !options.retries.empty()},
                                                 {"--engine", !options.engine.empty()},
                                                 {"--seed", !options.seeds.seed.empty()},
                                                 {"--seeds", !options.seeds.seeds.empty()},
                                                 {"--faults", !options.seeds.faults.empty()},
                                                 {"--shrink", options.shrink}};
  for (const std::string& directory : options.traces) {
    std::error_code ignored;
    if (!fs::is_directory(directory, ignored)) {
      throw UsageError(fmt::format("--trace: there is no directory '{}'", directory));
    }
  }
  for (const auto& [name, is_given] : others) {
    if (is_given) {
      throw UsageError(fmt::format("{} does not go with --trace, which starts nothing", name));
    }
  }
}

void list(const std::vector<TestCase>& tests) {
  for (const TestCase& test : tests) {
    fmt::print("{}:{}: {}\n", test.file, test.line, test.full_name());
  }
}

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// Prints and writes them, and returns the exit code.
int conclude(const Options& options, const std::vector<TestResult>& results, bool interrupted) {
  if (options.github) {
    std::error_code ignored;
    fmt::print("{}", as_github(results, fs::current_path(ignored).string()));
  }
  const bool written = write_results(options, results);
  const bool passed = std::all_of(results.begin(), results.end(), [](const auto& result) { return result.passed(); });
  return interrupted ? kInterrupted : passed && written ? 0 : 1;
}

int judge_traces(const Options& options) {
  const Environment environment = own_environment();
  const Registry registry = builtin_actions();
  std::vector<TestCase> tests = list_all(options, registry, environment);
  keep_named(options.names, tests);
  keep_shard(options.shard, tests);
  if (options.list) {
    list(tests);
    return 0;
  }
  const auto begin = std::chrono::steady_clock::now();
  TestReport report(stdout);
  const FinishedTrace trace{{options.traces.begin(), options.traces.end()}, options.skip_others};
  const std::vector<TestResult> results =
      judge_finished_trace(tests, registry, environment, options.target.arguments, trace, report);
  report.finish(results, results.size(), seconds_since(begin), false);
  return conclude(options, results, false);
}

int run(const Options& options) {
  run_if_launch_testing(options);
  check_trace_options(options);
  if (!options.traces.empty()) {
    return judge_traces(options);
  }
  const Environment environment = own_environment();
  const Registry registry = builtin_actions();
  QueueOptions queue;
  queue.jobs =
      options.jobs.empty() ? std::max(1U, std::thread::hardware_concurrency()) : whole_number(options.jobs, "--jobs");
  queue.keep = options.keep;
  queue.rounds = !options.repeat.empty()                                ? whole_number(options.repeat, "--repeat")
                 : options.until_failure && options.seeds.seeds.empty() ? 0
                                                                        : 1;
  queue.stop_at_failure = options.until_failure;
  queue.retries = options.retries.empty() ? 0 : whole_number(options.retries, "--retries");
  queue.engine = words_of(options.engine);
  std::vector<TestCase> tests = list_all(options, registry, environment);
  keep_named(options.names, tests);
  apply_seeds(options.seeds, tests);
  keep_shard(options.shard, tests);
  if (options.list) {
    list(tests);
    return 0;
  }
  queue.directory = fs::absolute(options.directory.empty() ? default_directory(environment) : options.directory);
  std::error_code failed;
  if (fs::create_directories(queue.directory, failed); failed) {
    throw std::runtime_error(fmt::format("cannot make '{}': {}", queue.directory, failed.message()));
  }

  const auto begin = std::chrono::steady_clock::now();
  TestReport report(stdout);
  bool interrupted = false;
  std::vector<TestResult> results =
      run_tests(tests, registry, environment, options.target.arguments, queue, report, interrupted);
  if (options.shrink && !interrupted) {
    shrink_failures(
        results, tests, registry, environment, options.target.arguments, queue,
        [&](const TestResult& result) { report.on_shrunk(result); }, interrupted);
  }
  const bool is_open = queue.stop_at_failure || queue.rounds == 0;
  report.finish(results, is_open ? results.size() : tests.size() * queue.rounds, seconds_since(begin), interrupted);
  std::error_code not_empty;
  fs::remove(queue.directory, not_empty);
  const int code = conclude(options, results, interrupted);
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    throw std::runtime_error("cannot write the output");
  }
  return code;
}

// `words` come after "launch test". Returns the exit code: 0 when every test has passed, 1 when one has failed or a
// launch file has an error, 2 for a wrong command line, 128+N after signal N.
int test_command(std::vector<std::string> words) {
  if (words.size() == 2 && words.front() == "--task") {
    return run_task(words.back(), builtin_actions());
  }
  Options options;
  Subcommand command("launch test", "Runs the tests of launch files, each in its own isolation.");
  command.take_target(options.target);
  command.take_text("-j,--jobs", options.jobs, "how many tests run at the same time; default: one for each processor");
  command.take_texts("-n,--name", options.names, "only tests of this name, which may hold * and ?; may be repeated");
  command.take_flag("--list", options.list, "only print the tests");
  command.take_text("--directory", options.directory,
                    "where the files of failed tests are kept; default: below ~/.ros/test");
  command.take_flag("--keep", options.keep, "also keep the files of tests that pass");
  command.take_text("--junit", options.junit, "write the results to this file as JUnit XML");
  command.take_text("--tap", options.tap, "write the results to this file in the Test Anything Protocol");
  command.take_text("--json", options.json, "write the results to this file as JSON");
  command.take_flag("--github", options.github, "also print the failures as annotations for GitHub's workflows");
  command.take_text("--repeat", options.repeat, "run all tests so often");
  command.take_flag("--until-failure", options.until_failure,
                    "begin no test after one has failed; without --repeat and --seeds, go on until then");
  command.take_text("--retries", options.retries,
                    "run a test that has failed again, at most so often; the result says so");
  command.take_text("--shard", options.shard, "I/N: only the I-th of N parts of the tests");
  command.take_text("--engine", options.engine, "hand each test to this command, such as 'srun' or 'ssh HOST'");
  command.take_text("--seed", options.seeds.seed, "from which the random parts of faults are drawn; default: 1");
  command.take_text("--seeds", options.seeds.seeds, "run each test so often, with the seeds from 1 on");
  command.take_text("--faults", options.seeds.faults,
                    "only apply the faults with these numbers, such as 1,3, or none of them");
  command.take_flag("--shrink", options.shrink,
                    "run tests that have failed again, to find the fewest faults with which they still fail");
  command.take_texts("--trace", options.traces,
                     "judge what the tests expect of the traces in this directory, and start nothing; may be repeated");
  command.take_flag("--skip-others", options.skip_others,
                    "with --trace: leave out what a finished trace does not tell, instead of failing");
  if (const std::optional<int> code = command.parse(std::move(words))) {
    return *code;
  }
  try {
    return run(options);
  } catch (const UsageError& error) {
    fmt::print(stderr, "{}", usage_error("launch test", error.what()));
    return kWrongCommandLine;
  } catch (const LaunchError& error) {
    print_errors(error, "launch test");
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}", command_error("launch test", error.what()));
  }
  return 1;
}

}  // namespace
}  // namespace launch

int main(int argc, char** argv) {
  return launch::test_command({argv + 1, argv + argc});
}
