// SPDX-License-Identifier: Apache-2.0
// The nodes of a recorded run, and what they tell of a plan.
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>
#include <utility>

#include "base/diagnostics/command_error.hpp"
#include "base/environment/own_prefix.hpp"
#include "base/files/pipe.hpp"
#include "base/processes/spawn.hpp"
#include "base/text/names.hpp"
#include "launcher/plan/node_names.hpp"
#include "programs/launch/check/finders.hpp"

namespace launch {

namespace {

// The kernel keeps so many characters of the name of a process.
constexpr std::size_t kLongestProcessName = 15;

using Remaps = std::vector<std::pair<std::string, std::string>>;

class RecordedFindings {
 public:
  RecordedFindings(const std::vector<RecordedNode>& recorded, const std::function<void(Diagnostic)>& report)
      : recorded_(recorded), report_(report) {}

  void add(const LaunchPlan& plan) {
    for (const NodeDescription& node : plan.nodes) {
      const ProcessSpec& spec = plan.processes[node.process];
      add(node.name.value_or(""), node.name_space.value_or("/"), spec.argv.front(), remaps_of(spec.argv), spec.origin);
    }
    for (const LoadRequest& load : plan.loads) {
      for (const ComposableNode& node : load.nodes) {
        if (!node.name.empty()) {
          add(node.name, node.name_space, "", node.remaps, node.origin);
        }
      }
    }
    std::for_each(plan.reactions.begin(), plan.reactions.end(), [&](const LaunchPlan& reaction) { add(reaction); });
  }

  void tell() const {
    for (const auto& [rule, use] : uses_) {
      if (!use.has_effect) {
        report_({Severity::kWarning,
                 fmt::format("remap '{}:={}' changes nothing: the recorded node '{}' has neither name", rule.first,
                             rule.second, use.node),
                 use.where, use.help, Finding::kUselessRemap});
      }
    }
  }

 private:
  struct Use {
    bool has_effect = false;
    std::string node;  // the first that has the rule
    SourceRange where;
    std::string help;
  };

  // The node may be several ones, when only its program is known.
  std::vector<const RecordedNode*> find(const std::string& name, const std::string& full_name,
                                        const std::string& program) const {
    const std::string process = std::filesystem::path(program).filename().string().substr(0, kLongestProcessName);
    std::vector<const RecordedNode*> found;
    for (const RecordedNode& node : recorded_) {
      if (name.empty() ? node.program == process : node.name == full_name) {
        found.push_back(&node);
      }
    }
    return found;
  }

  void add(const std::string& name, const std::string& name_space, const std::string& program, const Remaps& remaps,
           const SourceRange& where) {
    const std::vector<const RecordedNode*> nodes = find(name, joined_name(name_space, name), program);
    if (nodes.empty()) {
      return;
    }
    for (const auto& [from, to] : remaps) {
      const std::string_view bare = without_scheme(from);
      const std::string asked(bare.substr(bare.find(':') + 1));  // without the node that a rule is for
      Use& use = uses_[{from, to}];
      for (const RecordedNode* node : nodes) {
        const std::string space = node->name.substr(0, node->name.rfind('/'));
        const std::string before = resolved_name(asked, space, node->name);
        use.has_effect |= node->names.contains(before) || node->names.contains(resolved_name(to, space, node->name));
        if (use.node.empty()) {
          use = {use.has_effect, node->name, where,
                 did_you_mean(before, std::vector<std::string>(node->names.begin(), node->names.end()))};
        }
      }
    }
  }

  const std::vector<RecordedNode>& recorded_;
  const std::function<void(Diagnostic)>& report_;
  std::map<std::pair<std::string, std::string>, Use> uses_;  // of each rule
};

}  // namespace

void find_remaps_of_unknown_names(const LaunchPlan& plan, const std::vector<RecordedNode>& recorded,
                                  const std::function<void(Diagnostic)>& report) {
  RecordedFindings findings(recorded, report);
  findings.add(plan);
  findings.tell();
}

namespace {

class Nodes {
 public:
  void add(const nlohmann::json& event) {
    const nlohmann::json& fields = event.at("fields");
    const auto of = [&](const char* field) { return fields.value(field, std::string()); };
    if (event.at("event") == "ros2:rcl_node_init") {
      const std::string space = of("namespace");
      add_node(event, (space == "/" ? "" : space) + "/" + of("node_name"));
      return;
    }
    const std::string name = fields.contains("topic_name") ? of("topic_name") : of("service_name");
    const auto newest = newest_.find(key(event));
    if (newest != newest_.end() && !name.empty()) {
      nodes_[newest->second].names.insert(name);
    }
  }

  std::vector<RecordedNode> take() { return std::move(nodes_); }

 private:
  using Key = std::tuple<std::string, std::int64_t, std::uint64_t>;  // host, process, handle

  static Key key(const nlohmann::json& event) {
    return {event.value("hostname", std::string()), event.value("vpid", std::int64_t{0}),
            event.at("fields").value("node_handle", std::uint64_t{0})};
  }

  // A trace that starts late tells of a node again; another node may get the handle of one that is gone.
  void add_node(const nlohmann::json& event, const std::string& name) {
    const auto [newest, is_new] = newest_.try_emplace(key(event), nodes_.size());
    if (is_new || nodes_[newest->second].name != name) {
      newest->second = nodes_.size();
      nodes_.push_back({name, event.value("procname", std::string()), {}});
    }
  }

  std::vector<RecordedNode> nodes_;
  std::map<Key, std::size_t> newest_;
};

Nodes nodes_of(const std::string& lines) {
  Nodes nodes;
  for (std::size_t begin = 0; begin < lines.size();) {
    const std::size_t end = std::min(lines.find('\n', begin), lines.size());
    const nlohmann::json event =
        nlohmann::json::parse(lines.begin() + static_cast<std::ptrdiff_t>(begin),
                              lines.begin() + static_cast<std::ptrdiff_t>(end), nullptr, false);
    if (event.is_object() && event.contains("event")) {
      nodes.add(event);
    }
    begin = end + 1;
  }
  return nodes;
}

}  // namespace

std::optional<std::vector<RecordedNode>> read_recorded_nodes(const std::string& trace_directory) {
  Pipe pipe = make_pipe();
  const pid_t reader =
      spawn({.program = own_library_file("launch-trace-read"),
             .argv = {"launch check", trace_directory, "--format", "json", "--event", "ros2:rcl_*_init"},
             .descriptors = {{STDOUT_FILENO, pipe.write.get()}}});
  pipe.write.reset();
  const std::string lines = read_to_end(pipe.read);
  const int status = wait_for(reader);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    return std::nullopt;
  }
  std::vector<RecordedNode> found = nodes_of(lines).take();
  if (found.empty()) {
    fmt::print(stderr, "{}",
               command_error("launch check", fmt::format("the trace '{}' has no nodes", trace_directory),
                             "launch --trace FILE records one"));
    return std::nullopt;
  }
  return found;
}

}  // namespace launch
