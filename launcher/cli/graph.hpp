// What `launch graph` draws: the nodes and other processes of a launch, by namespace, with the files that ask for them
// and the topics that they are remapped to.
#pragma once

#include <string>

#include "launcher/core/launch_plan.hpp"

namespace launch {

// A graph in Graphviz's language.
//
// Boxes with a folded corner are launch files, with an arrow to what each includes and asks for. Ellipses are nodes,
// components among them, inside their namespace; boxes are processes that are no nodes. A remap is a line from the node
// to the new name, which all who use it share, labelled with the old one.
std::string plan_as_dot(const LaunchPlan& plan);

// The same drawn by Graphviz's `dot`. Throws LaunchError when that can't be run.
std::string dot_as_svg(const std::string& dot);

}  // namespace launch
