// SPDX-License-Identifier: Apache-2.0
// What `launch graph` draws: the nodes and other processes of a launch, by namespace, with the files that ask for them,
// the topics that they are remapped to, what they wait for, what event handlers and timers start, and what conditions
// leave out.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "launcher/visit/launch_plan.hpp"

namespace launch {

struct LaunchGraph {
  struct Box {
    std::string id;
    std::vector<std::string> lines;  // its text
    bool left_out = false;           // by a condition
    std::string machine{};           // of a node or another process; empty: this machine
  };
  enum class Relation {
    kIncludes,  // a file to a file
    kAsksFor,   // a file to a node or another process
    kLoads,     // a container to a component
    kRemaps,    // a node to a topic; the label is the node's own name for the topic
    kWaitsFor,  // a node or another process to what it depends on; the label is the condition
    kHandles,   // a node or another process to a handler of its events
    kStarts,    // a handler to a node or another process; the label is what it does to it
  };
  struct Edge {
    std::string from;
    std::string to;
    Relation relation;
    std::string label;
  };

  std::map<std::string, Box> files;               // by their path; a file that several places include stands here once
  std::map<std::string, std::vector<Box>> nodes;  // by their namespace, components among them
  std::vector<Box> processes;                     // processes that are no nodes
  std::vector<Box> handlers;                      // event handlers
  std::vector<Box> topics;                        // topics that something is remapped to, sorted
  std::vector<Edge> edges;                        // in the order of the plan

  // The machines of nodes and other processes, sorted, this one first. One alone gets no box.
  std::vector<std::string> machines() const;
};

// The text of the box of a machine: "machine arm".
std::string title_of_machine(const std::string& machine);

// `left_out` are the requests of actions that their conditions leave out.
LaunchGraph graph_of(const LaunchPlan& plan, const std::vector<Requests>& left_out = {});

// In Graphviz's language. Boxes with a folded corner are launch files, with an arrow to what each includes and asks
// for. Ellipses are nodes inside their namespace; boxes are other processes; those of several machines stand in a box
// for each machine. A remap is a line from the node to the new
// name, labelled with the old one.
std::string graph_as_dot(const LaunchGraph& graph);

// As a picture, which needs no Graphviz: files on the left, nodes and processes in the middle, topics on the right.
std::string graph_as_svg(const LaunchGraph& graph);

// `launch graph --from-trace` and `--live`: the graph that a trace shows. Other programs record and read the trace.
struct TraceToDraw {
  std::string directory;  // of a trace; empty: record what runs now
  double seconds = 0;     // how long to record
  bool as_picture = false;
  std::string output;  // a file; empty: standard output
};

// Has `launch report` draw the graph. Without a directory it records what runs into a temporary one first: processes
// that run already record their nodes and topics again when a session starts. Returns the exit code.
int draw_trace(const TraceToDraw& trace);

}  // namespace launch
