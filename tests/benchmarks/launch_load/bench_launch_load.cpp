// SPDX-License-Identifier: Apache-2.0
// Measures the time to load and visit launch files, up to the list of what would run: many nodes in one file, a chain
// of includes, and a tree of real launch files with what conditions leave out. The floor is the bare parser of the
// format, tinyxml2 or yaml-cpp, over the same text. It measures processor time of this process, in turns in the same
// run, and prints medians.
#include <fmt/format.h>
#include <stdlib.h>
#include <time.h>
#include <tinyxml2.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "actions/builtin_actions.hpp"
#include "launcher/python/interpreter/python_module.hpp"
#include "launcher/visit/launch_plan.hpp"
#include "tests/benchmarks/launch_load/corpus_tree.hpp"
#include "tests/benchmarks/launch_load/made_launch_files.hpp"
#include "tests/benchmarks/samples/samples_file.hpp"

namespace {

namespace fs = std::filesystem;

constexpr int kNodes = 1000;
constexpr int kDepth = 50;
constexpr int kRuns = 15;

// Milliseconds of processor time.
double now() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_nsec) / 1e6;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

struct Times {
  std::vector<double> ours;
  std::vector<double> floor;
};

Times measure(const std::function<void()>& ours, const std::function<void()>& floor) {
  std::vector<double> our_times;
  std::vector<double> floor_times;
  for (int run = 0; run < kRuns; ++run) {
    double begin = now();
    ours();
    our_times.push_back(now() - begin);
    begin = now();
    floor();
    floor_times.push_back(now() - begin);
  }
  return {our_times, floor_times};
}

const launch::Registry& registry() {
  static const launch::Registry instance = launch::builtin_actions();
  return instance;
}

launch::Environment small_environment() {
  return {{"HOME", "/root"}, {"LANG", "C.UTF-8"}, {"PATH", "/usr/bin:/bin"}, {"USER", "user"}};
}

void expect(bool condition, const char* what) {
  if (!condition) {
    fmt::print(stderr, "bench_launch_load: {}\n", what);
    std::exit(1);
  }
}

void load_and_visit(const std::string& file, std::size_t processes) {
  launch::LaunchContext context(registry(), small_environment(), "", [](auto...) {});
  const auto description = launch::load_launch_description(file, registry(), context.scope());
  expect(launch::plan_launch(context, *description).processes.size() == processes, "not all processes are there");
}

// Also visits what conditions leave out, and goes on after errors, as `launch check` does. Returns the number of
// includes.
int explore(const bench::CorpusTree& tree) {
  launch::LaunchContext context(registry(), tree.environment, "", [](auto...) {});
  context.scope().configurations = tree.arguments;
  context.exploration().begin({.report = [](const launch::LaunchError&, bool) {}, .left_out = {}});
  const auto description = launch::load_launch_description(tree.file, registry(), context.scope());
  return launch::plan_launch(context, *description).includes;
}

std::string text_of(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

void bare_xml(const std::string& file) {
  const std::string text = text_of(file);
  tinyxml2::XMLDocument document;
  expect(document.Parse(text.data(), text.size()) == tinyxml2::XML_SUCCESS, "tinyxml2 fails");
}

// yaml-cpp without a tree: its events are dropped.
class NoTree : public YAML::EventHandler {
 public:
  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t, const std::string&) override {}
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {}
  void OnMapEnd() override {}
};

void bare_yaml(const std::string& file) {
  std::ifstream stream(file);
  YAML::Parser parser(stream);
  NoTree dropped;
  parser.HandleNextDocument(dropped);
}

void print(const std::string& what, const Times& times, const char* floor) {
  const double ours = median(times.ours);
  const double least = median(times.floor);
  fmt::print("  {:<34} {:8.2f} ms   {} {:6.2f} ms, ratio {:.1f}\n", what, ours, floor, least, ours / least);
  benchmarks::report({what, "ms", times.ours, floor, times.floor});
}

// One format: many nodes, and how the time of one node grows with their number.
void bench_nodes(const fs::path& directory, const std::string& suffix, std::string (*nodes)(int),
                 void (*bare)(const std::string&), const char* parser) {
  const auto measure_nodes = [&](int count) {
    const std::string file = directory / fmt::format("nodes_{}{}", count, suffix);
    std::ofstream(file) << nodes(count);
    return measure([&] { load_and_visit(file, static_cast<std::size_t>(count)); }, [&] { bare(file); });
  };
  print(fmt::format("{} nodes, {}", kNodes, suffix), measure_nodes(kNodes), parser);
  const double one_of_few = median(measure_nodes(kNodes / 2).ours) / (kNodes / 2);
  const double one_of_many = median(measure_nodes(kNodes * 2).ours) / (kNodes * 2);
  fmt::print("  {:<34} {:8.2f} us of {}, {:.2f} us of {}: ratio {:.2f}\n", "one node, " + suffix, one_of_few * 1e3,
             kNodes / 2, one_of_many * 1e3, kNodes * 2, one_of_many / one_of_few);
}

void bench_include_chain(const fs::path& directory) {
  const std::string outermost = bench::write_include_chain(directory, kDepth);
  const Times times = measure([&] { load_and_visit(outermost, 1); },
                              [&] {
                                for (int level = 0; level < kDepth; ++level) {
                                  bare_xml(directory / fmt::format("level_{}.launch.xml", level));
                                }
                              });
  print(fmt::format("{} files, each including the next", kDepth), times, "tinyxml2");
}

void bench_corpus_tree(const fs::path& directory) {
  const bench::CorpusTree tree = bench::prepare_corpus_tree(directory);
  if (tree.file.empty()) {
    fmt::print("  a tree of real launch files: skipped, because its prefix could not be made\n");
    return;
  }
  int includes = 0;
  std::vector<double> times;
  for (int run = 0; run < kRuns / 3; ++run) {
    const double begin = now();
    includes = explore(tree);
    times.push_back(now() - begin);
  }
  fmt::print("  {:<34} {:8.2f} ms   {} includes visited, left out ones besides\n", "the largest tree of real files",
             median(times), includes);
}

}  // namespace

int main() {
  launch::use_python_module(PYTHON_MODULE);
  char pattern[] = "/tmp/bench-launch-load-XXXXXX";
  const fs::path directory = mkdtemp(pattern);
  fmt::print("from the file to the list of what would run, median of {} runs\n", kRuns);
  bench_nodes(directory, ".launch.xml", bench::nodes_as_xml, bare_xml, "tinyxml2");
  bench_nodes(directory, ".launch.yaml", bench::nodes_as_yaml, bare_yaml, "yaml-cpp");
  bench_include_chain(directory);
  bench_corpus_tree(directory);
  fs::remove_all(directory);
}
