// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fnmatch.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <variant>

#include "base/overloaded.hpp"
#include "launcher/substitution/unrun_commands.hpp"
#include "launcher/visit/process_table.hpp"
#include "programs/launch/check/finders.hpp"

namespace launch {

namespace {

std::string full_name(const std::string& space, const std::string& name) {
  return (space.empty() || space.front() != '/' ? "/" : "") + space +
         (space.empty() || space.back() == '/' ? "" : "/") + name;
}

// The first place of each name.
class Names {
 public:
  // The place that has the name already, if there is one.
  std::optional<SourceRange> add(const std::string& name, const SourceRange& where) {
    const auto [first, is_new] = seen_.emplace(name, where);
    return is_new ? std::nullopt : std::optional(first->second);
  }
  bool has(const std::string& name) const { return seen_.contains(name); }
  std::vector<std::string> all() const {
    std::vector<std::string> names;
    for (const auto& [name, where] : seen_) {
      names.push_back(name);
    }
    return names;
  }

 private:
  std::map<std::string, SourceRange> seen_;
};

class PlanFindings {
 public:
  PlanFindings(const LaunchPlan& plan, const std::vector<Requests>& left_out,
               const std::function<void(Diagnostic)>& report)
      : plan_(plan), left_out_(left_out), report_(report) {}

  void run() {
    find_same_nodes(plan_);
    note(plan_);
    for (const Requests& requests : left_out_) {
      note_names(requests.processes, requests.nodes);
      note_components(requests.loads);
      for (const ProcessSpec& spec : requests.processes) {
        find_faults_of_process(spec, true, report_);
      }
    }
    check(plan_);
  }

 private:
  static std::string first_at(const SourceRange& where) { return "the first is at " + to_string(where); }

  // Nodes that run at one time: handlers may start a node again.
  void find_same_nodes(const LaunchPlan& plan) {
    Names names;
    const auto add = [&](const std::string& name, const SourceRange& where) {
      if (const std::optional<SourceRange> first = names.add(name, where)) {
        report_({Severity::kWarning, fmt::format("another node is named '{}'", name), where, first_at(*first),
                 Finding::kSameNode});
      }
    };
    for (const NodeDescription& node : plan.nodes) {
      if (node.name) {
        add(full_name(node.name_space.value_or("/"), *node.name), plan.processes[node.process].origin);
      }
    }
    for (const LoadRequest& load : plan.loads) {
      for (const ComposableNode& node : load.nodes) {
        if (!node.name.empty()) {
          add(full_name(node.name_space, node.name), node.origin);
        }
      }
    }
  }

  // Takes note of what there is, also in handlers.
  void note(const LaunchPlan& plan) {
    note_names(plan.processes, plan.nodes);
    note_components(plan.loads);
    is_complete_ = is_complete_ && plan.left_to_run.empty() && plan.python_includes.empty() && plan.coroutines.empty();
    std::for_each(plan.reactions.begin(), plan.reactions.end(), [&](const LaunchPlan& reaction) { note(reaction); });
  }

  void note_names(const std::vector<ProcessSpec>& processes, const std::vector<NodeDescription>& nodes) {
    for (const ProcessSpec& spec : processes) {
      for (const std::string& name : names_of(spec)) {
        processes_.add(name, spec.origin);
      }
    }
    std::set<std::size_t> named;
    for (const NodeDescription& node : nodes) {
      if (node.name) {
        nodes_.add(full_name(node.name_space.value_or("/"), *node.name), processes[node.process].origin);
        named.insert(node.process);
      }
    }
    has_unnamed_node_ |= named.size() < processes.size();
    // The name of a node that the program decides is not known. It may be a container.
    for (std::size_t i = 0; i < processes.size(); ++i) {
      has_unnamed_container_ |=
          !named.contains(i) &&
          fmt::format("{}", fmt::join(processes[i].argv, " ")).find("container") != std::string::npos;
    }
  }

  void note_components(const std::vector<LoadRequest>& loads) {
    for (const LoadRequest& load : loads) {
      for (const ComposableNode& node : load.nodes) {
        if (node.name.empty()) {
          has_unnamed_node_ = true;
        } else {
          components_.add(full_name(node.name_space, node.name), node.origin);
        }
      }
    }
  }

  void check(const LaunchPlan& plan) {
    for (const ProcessSpec& spec : plan.processes) {
      find_faults_of_process(spec, false, report_);
    }
    for_each_request(plan, Overloaded{
                               [&](const RunScopePtr& scope) {
                                 find_same_session(*scope);
                                 find_unknown_nodes(*scope);
                               },
                               [&](const LoadRequest& load) { find_missing_container(load); },
                               PassOver<ProcessCommand, UnregisterRequest, TestRequest, TimerRequest, TransitionRequest,
                                        CoroutineRequest, ShutdownRequest, NodeDescription, Dependency>(),
                               PassOver<ProcessSpec, EventHandler>(),  // before and after the others
                           });
    for (std::size_t i = 0; i < plan.handlers.size(); ++i) {
      find_unknown_process(plan.handlers[i]);
      check(plan.reactions[i]);
    }
  }

  void find_same_session(const RunScope& scope) {
    for (const ShownSetting& setting : scope.describe()) {
      const auto* const name = std::get_if<std::string>(&setting.value);
      if (setting.name != "session-name" || name == nullptr || name->find(kUnknownOutput) != std::string::npos) {
        continue;
      }
      if (const std::optional<SourceRange> first = sessions_.add(*name, scope.origin())) {
        report_({Severity::kError, fmt::format("another trace has the session name '{}'", *name), scope.origin(),
                 first_at(*first), Finding::kSameSession});
      }
    }
  }

  void find_unknown_nodes(const RunScope& scope) {
    std::vector<std::string> names = nodes_.all();
    for (const std::string& name : components_.all()) {
      names.push_back(name);
    }
    for (const NamedNode& node : scope.named_nodes()) {
      const bool is_there = std::any_of(names.begin(), names.end(), [&](const std::string& name) {
        return ::fnmatch(node.name.c_str(), name.c_str(), 0) == 0;
      });
      std::string help = did_you_mean(node.name, names);
      if (is_there || !is_complete_ || (has_unnamed_node_ && help.empty())) {
        continue;
      }
      report_({Severity::kWarning,
               fmt::format("no node of this launch is named '{}', as {} says", node.name, node.what), node.where,
               std::move(help), Finding::kUnknownChainNode});
    }
  }

  void find_missing_container(const LoadRequest& load) {
    const std::string target = load.target.starts_with('/') ? load.target : "/" + load.target;
    if (!is_complete_ || has_unnamed_container_ || nodes_.has(target)) {
      return;
    }
    const std::vector<std::string> names = nodes_.all();
    std::string help = did_you_mean(target, names);
    const auto namesake =
        std::find_if(names.begin(), names.end(), [&](const std::string& name) { return name.ends_with(target); });
    if (namesake != names.end()) {
      help = fmt::format("did you mean '{}'?", *namesake);
    }
    report_({Severity::kWarning, fmt::format("no node of this launch is the container '{}'", target), load.origin,
             help.empty() ? "another launch must start it" : std::move(help), Finding::kMissingContainer});
  }

  void find_unknown_process(const EventHandler& handler) {
    if (!is_complete_ || handler.process.empty() || processes_.has(handler.process) || is_label(handler.process)) {
      return;
    }
    report_({Severity::kWarning, fmt::format("no process is named '{}'", handler.process), handler.where,
             did_you_mean(handler.process, processes_.all()), Finding::kUnknownProcess});
  }

  // "talker-2"
  bool is_label(const std::string& name) const {
    const std::size_t dash = name.rfind('-');
    return dash != std::string::npos && dash + 1 < name.size() &&
           name.find_first_not_of("0123456789", dash + 1) == std::string::npos && processes_.has(name.substr(0, dash));
  }

  const LaunchPlan& plan_;
  const std::vector<Requests>& left_out_;
  const std::function<void(Diagnostic)>& report_;
  Names processes_;
  Names nodes_;
  Names components_;
  Names sessions_;
  bool is_complete_ = true;             // nothing is left to a run
  bool has_unnamed_container_ = false;  // a process may be a container of any name
  bool has_unnamed_node_ = false;       // a process may have nodes of any names
};

}  // namespace

void find_faults_of_plan(const LaunchPlan& plan, const std::vector<Requests>& left_out,
                         const std::function<void(Diagnostic)>& report) {
  PlanFindings(plan, left_out, report).run();
}

}  // namespace launch
