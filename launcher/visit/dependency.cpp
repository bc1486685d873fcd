// SPDX-License-Identifier: Apache-2.0
#include "launcher/visit/dependency.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <unordered_map>

#include "base/diagnostics/diagnostic.hpp"
#include "base/overloaded.hpp"
#include "launcher/visit/process_table.hpp"

namespace launch {

std::string describe(const Dependency& dependency) {
  if (const auto* const readiness = std::get_if<std::shared_ptr<ReadinessCondition>>(&dependency.condition)) {
    return (*readiness)->describe();
  }
  const auto& condition = std::get<ProcessCondition>(dependency.condition);
  return std::visit(
      Overloaded{
          [&](const UntilStarted&) { return fmt::format("'{}' has started", condition.process); },
          [&](const UntilExited& until) {
            return fmt::format("'{}' has exited with exit code {}", condition.process, until.exit_code.text());
          },
          [&](const UntilOutput& until) {
            const std::string times = until.occurrence == 1 ? "" : fmt::format(", {} times", until.occurrence);
            return fmt::format("'{}' has written {}{}", condition.process, until.pattern.describe(), times);
          },
          [&](const UntilHealthy&) { return fmt::format("'{}' is healthy", condition.process); },
      },
      condition.state);
}

std::string_view to_string(OnFailure on_failure) {
  switch (on_failure) {
    case OnFailure::kShutdown:
      return "shutdown";
    case OnFailure::kStart:
      return "start";
    case OnFailure::kSkip:
      return "skip";
  }
  return "";
}

namespace {

using Numbers = std::unordered_map<const TrackedProcess*, std::size_t>;  // of the processes of a traversal

TrackedProcess* find_target(const std::string& name, const Numbers& now, const ProcessTable& table,
                            const SourceRange& where) {
  const std::vector<TrackedProcess*> named = table.find(name);
  if (named.empty()) {
    const std::string suggestion = did_you_mean(name, table.names());
    throw LaunchError(
        fmt::format("no process is named '{}'", name), where,
        suggestion.empty() ? "what a timer or an event handler starts is not known before it does" : suggestion,
        Finding::kUnknownProcess);
  }
  std::vector<TrackedProcess*> asked_for;
  std::copy_if(named.begin(), named.end(), std::back_inserter(asked_for),
               [&](const TrackedProcess* process) { return now.contains(process); });
  if (asked_for.size() > 1) {
    throw LaunchError(fmt::format("{} processes are named '{}'", asked_for.size(), name), where,
                      "use the full name of the node, such as /left/talker, or give each a name of its own",
                      Finding::kUnknownProcess);
  }
  return asked_for.empty() ? named.back() : asked_for.front();
}

Numbers numbered(const std::vector<TrackedProcess*>& processes) {
  Numbers numbers;
  for (std::size_t i = 0; i < processes.size(); ++i) {
    numbers.emplace(processes[i], i);
  }
  return numbers;
}

void find_targets(std::vector<Dependency>& dependencies, const Numbers& numbers, const ProcessTable& table) {
  std::vector<Diagnostic> errors;
  for (Dependency& dependency : dependencies) {
    const auto* const condition = std::get_if<ProcessCondition>(&dependency.condition);
    if (condition == nullptr) {
      continue;
    }
    try {
      dependency.target = find_target(condition->process, numbers, table, dependency.where);
      if (std::holds_alternative<UntilHealthy>(condition->state) && !dependency.target->is_watched) {
        throw LaunchError(fmt::format("nothing tells whether '{}' is healthy", condition->process), dependency.where,
                          "give it a <watch>, such as <watch kind=\"executor\"/>", Finding::kStartOrder);
      }
    } catch (const LaunchError& error) {
      errors.insert(errors.end(), error.diagnostics().begin(), error.diagnostics().end());
    }
  }
  if (!errors.empty()) {
    throw LaunchError(std::move(errors));
  }
}

// Throws LaunchError for the first cycle.
class CycleSearch {
 public:
  CycleSearch(const std::vector<Dependency>& dependencies, const std::vector<TrackedProcess*>& processes,
              const Numbers& numbers)
      : processes_(processes), edges_(processes.size()), marks_(processes.size(), Mark::kNew) {
    for (const Dependency& dependency : dependencies) {
      if (const auto target = numbers.find(dependency.target); target != numbers.end()) {
        edges_[dependency.process].push_back({target->second, &dependency.where});
      }
    }
  }

  void run() {
    for (std::size_t i = 0; i < processes_.size(); ++i) {
      visit(i);
    }
  }

 private:
  enum class Mark { kNew, kOnPath, kDone };
  struct Edge {
    std::size_t to;
    const SourceRange* where;
  };

  void visit(std::size_t process) {
    if (marks_[process] != Mark::kNew) {
      return;
    }
    marks_[process] = Mark::kOnPath;
    path_.push_back(process);
    for (const Edge& edge : edges_[process]) {
      if (marks_[edge.to] == Mark::kOnPath) {
        report(edge);
      }
      visit(edge.to);
    }
    path_.pop_back();
    marks_[process] = Mark::kDone;
  }

  [[noreturn]] void report(const Edge& closing) const {
    std::string text;
    for (auto step = std::find(path_.begin(), path_.end(), closing.to); step != path_.end(); ++step) {
      text += fmt::format("'{}' waits for ", processes_[*step]->names.front());
    }
    throw LaunchError(fmt::format("no start order is possible: {}'{}'", text, processes_[closing.to]->names.front()),
                      *closing.where, "remove one of these depends_on", Finding::kStartOrder);
  }

  const std::vector<TrackedProcess*>& processes_;
  std::vector<std::vector<Edge>> edges_;
  std::vector<Mark> marks_;
  std::vector<std::size_t> path_;
};

}  // namespace

void resolve_targets(std::vector<Dependency>& dependencies, const std::vector<TrackedProcess*>& asked_for,
                     const ProcessTable& table) {
  find_targets(dependencies, numbered(asked_for), table);
}

void resolve_dependencies(std::vector<Dependency>& dependencies, const std::vector<TrackedProcess*>& asked_for,
                          const ProcessTable& table) {
  if (dependencies.empty()) {
    return;
  }
  const Numbers numbers = numbered(asked_for);
  find_targets(dependencies, numbers, table);
  CycleSearch(dependencies, asked_for, numbers).run();
}

}  // namespace launch
