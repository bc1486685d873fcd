// SPDX-License-Identifier: Apache-2.0
#include "launcher/cli/graph/graph_command.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <fstream>

#include "launcher/base/own_prefix.hpp"
#include "launcher/cli/find_launch_file.hpp"
#include "launcher/cli/graph/graph.hpp"
#include "launcher/cli/result_output.hpp"
#include "launcher/cli/subcommand.hpp"
#include "launcher/visit/launch_plan.hpp"

namespace launch {

int graph_command(const std::vector<std::string>& words, const Registry& registry, const Environment& environment) {
  std::string format = "dot";
  std::string output;
  LaunchTarget target;
  Subcommand command(
      "launch graph",
      "Draws what a launch file would run: nodes in their namespaces, processes, included files, remapped names.");
  command.take_target(target);
  command.take_choice("--format", format, {"dot", "svg"}, "dot, for Graphviz, or svg, a picture");
  command.take_text("-o,--output", output, "file to write, instead of standard output");
  if (const auto exit_code = command.parse(words)) {
    return *exit_code;
  }
  ResultOutput result;
  try {
    LaunchContext context(registry, environment, own_prefix(), [](auto, auto, auto) {});
    for (const auto& [name, value] : target.arguments) {
      context.scope().configurations.insert_or_assign(name, value);
    }
    const auto description =
        load_launch_files(find_launch_files(target.words, context.scope()), registry, context.scope());
    const LaunchGraph graph = graph_of(plan_launch(context, *description));
    const std::string text = format == "svg" ? graph_as_svg(graph) : graph_as_dot(graph);
    if (output.empty()) {
      result.print(text);
    } else if (!(std::ofstream(output) << text)) {
      throw LaunchError(fmt::format("'{}' can't be written", output), {});
    }
    return result.finish() ? 0 : 1;
  } catch (const LaunchError& error) {
    print_errors(error);
    return 1;
  }
}

}  // namespace launch
