// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <utility>

#include "base/text/nearest_name.hpp"
#include "base/text/remap_name.hpp"
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

}  // namespace launch
