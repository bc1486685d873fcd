// SPDX-License-Identifier: Apache-2.0
// `launch graph`: draws what a launch file would run.
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <utility>

#include "actions/builtin_actions.hpp"
#include "base/environment/own_environment.hpp"
#include "base/environment/own_prefix.hpp"
#include "launcher/invocation/find_launch_file.hpp"
#include "launcher/process/output/output_router.hpp"
#include "launcher/python/interpreter/python_guest.hpp"
#include "launcher/visit/launch_plan.hpp"
#include "programs/command_line/result_output.hpp"
#include "programs/command_line/subcommand.hpp"
#include "programs/launch/command_functions.hpp"
#include "programs/launch/graph/graph.hpp"

namespace launch {

namespace {

// The plan without what conditions leave out, which goes to `left_out`. Throws LaunchError.
LaunchPlan plan_with_left_out(LaunchContext& context, const LaunchDescription& description,
                              std::vector<Requests>& left_out) {
  std::vector<Diagnostic> errors;
  context.exploration().begin({.report =
                                   [&](const LaunchError& error, bool of_left_out) {
                                     if (!of_left_out) {
                                       errors.insert(errors.end(), error.diagnostics().begin(),
                                                     error.diagnostics().end());
                                     }
                                   },
                               .left_out = [&](Requests requests) { left_out.push_back(std::move(requests)); },
                               .judges = false});
  LaunchPlan plan = plan_launch(context, description);
  if (!errors.empty()) {
    throw LaunchError(std::move(errors));
  }
  return plan;
}

}  // namespace

int graph_command(const std::vector<std::string>& words) {
  std::string format = "dot";
  std::string output;
  LaunchTarget target;
  TraceToDraw trace;
  std::string seconds = "1";
  bool live = false;
  Subcommand command("launch graph",
                     "Draws what a launch file would run: nodes in their namespaces, processes, included files, "
                     "remapped names. Or draws the nodes and topics of a trace, or of what runs now.");
  command.take_target(target, true);
  command.take_choice("--format", format, {"dot", "svg"}, "dot, for Graphviz, or svg, a picture");
  command.take_text("-o,--output", output, "file to write, instead of standard output");
  command.take_text("--from-trace", trace.directory, "draw the nodes and topics of this trace");
  command.take_flag("--live", live, "draw the nodes and topics of what runs now: records a short trace of it");
  command.take_text("--seconds", seconds, "how long --live records (default: 1)");
  PythonLimits python;
  command.take_python_limits(python);
  if (const auto exit_code = command.parse(words)) {
    return *exit_code;
  }
  if (live || !trace.directory.empty()) {
    char* end = nullptr;
    trace.seconds = std::strtod(seconds.c_str(), &end);
    const std::string wrong = live && !trace.directory.empty() ? "--live and --from-trace exclude each other"
                              : !target.words.empty()          ? "a launch file and a trace exclude each other"
                              : *end != 0 || !(trace.seconds > 0)
                                  ? fmt::format("'{}' is no number of seconds above 0", seconds)
                                  : "";
    if (!wrong.empty()) {
      fmt::print(stderr, "{}", usage_error("launch graph", wrong));
      return kWrongCommandLine;
    }
    trace.as_picture = format == "svg";
    trace.output = output;
    return draw_trace(trace);
  }
  if (target.words.empty()) {
    fmt::print(stderr, "{}", usage_error("launch graph", "no launch file given"));
    return kWrongCommandLine;
  }
  run_python_in_a_guest({std::chrono::seconds(python.seconds), python.memory});
  ResultOutput result("launch graph");
  const Registry registry = builtin_actions();
  LaunchContext context(registry, own_environment(), own_prefix(), [](auto, auto, auto) {});
  context.scope().log_directory = LogDirectory::choose(own_environment());
  for (const auto& [name, value] : target.arguments) {
    context.scope().configurations.insert_or_assign(name, value);
  }
  const auto description = load_launch_files(find_launch_files(target.words, context.scope(), listed_command_names()),
                                             registry, context.scope());
  std::vector<Requests> left_out;
  const LaunchPlan plan = plan_with_left_out(context, *description, left_out);
  const LaunchGraph graph = graph_of(plan, left_out);
  const std::string text = format == "svg" ? graph_as_svg(graph) : graph_as_dot(graph);
  if (output.empty()) {
    result.print(text);
  } else if (!(std::ofstream(output) << text)) {
    throw LaunchError(fmt::format("'{}' can't be written", output), {});
  }
  return result.finish() ? 0 : 1;
}

}  // namespace launch
