// SPDX-License-Identifier: Apache-2.0
#include "launcher/visit/launch_context.hpp"

#include <fmt/format.h>

#include "launcher/substitution/package_index.hpp"

namespace launch {

namespace {

// An action that gives itself, or a file that includes itself, would exhaust the stack.
constexpr int kDeepest = 600;

// Runs `restore` at the end of a block, however it ends.
template <typename Restore>
class AtExit {
 public:
  explicit AtExit(Restore restore) : restore_(std::move(restore)) {}
  AtExit(const AtExit&) = delete;
  AtExit& operator=(const AtExit&) = delete;
  ~AtExit() { restore_(); }

 private:
  Restore restore_;
};

// What a visit asks for, without what it leaves to a run.
std::size_t size_of(const Requests& requests) {
  return requests.count() + requests.logs.size();
}

}  // namespace

LaunchContext::LaunchContext(const Registry& registry, Environment environment, std::string own_prefix,
                             MessageSink messages)
    : registry_(registry),
      initial_environment_(std::move(environment)),
      own_prefix_(std::move(own_prefix)),
      messages_(std::move(messages)) {
  scope_.environment = initial_environment_;
  scope_.packages = std::make_shared<PackageIndex>(own_prefix_);
  scope_.anonymous_names = std::make_shared<AnonymousNames>();
  scope_.warn = [this](const SourceRange& where, const std::string& text) {
    message(LogLevel::kWarning, "launch", fmt::format("{}: {}", to_string(where), text));
  };
}

void LaunchContext::visit(const Action& action) {
  if (depth_ == kDeepest) {
    throw LaunchError(fmt::format("actions hold each other more than {} deep", kDeepest), action.where(),
                      "an action that gives itself has no end", Finding::kEndless);
  }
  ++depth_;
  AtExit restore([this] { --depth_; });
  if (action.condition().holds(scope_)) {
    action.execute(*this);
  } else {
    visit_left_out(action);
  }
}

void LaunchContext::visit(const std::vector<ActionPtr>& actions) {
  for (const ActionPtr& action : actions) {
    const std::size_t before = size_of(requests_);
    try {
      visit(*action);
      if (scope_.command_was_left_out()) {
        scope_.forget_left_out_command();
        requests_.left_to_run.push_back({"", "", action->where()});
        scope_.incomplete = scope_.incomplete || size_of(requests_) == before;  // the scope may hold the output
      }
    } catch (const OnlyARunCalls& left) {
      requests_.left_to_run.push_back({left.function(), "", action->where()});
      scope_.incomplete = true;
    } catch (const LaunchError& error) {
      const bool depends_on_command = scope_.command_was_left_out();
      scope_.forget_left_out_command();
      scope_.incomplete = scope_.incomplete || depends_on_command;
      if (scope_.incomplete) {
        requests_.left_to_run.push_back({"", error.diagnostics().front().message, action->where()});
      } else if (exploration_.is_on()) {
        exploration_.report(error);
        // What names something that the action would have given is no error of its own.
        requests_.left_to_run.push_back({"", error.diagnostics().front().message, action->where()});
      } else {
        throw;
      }
    }
  }
}

void LaunchContext::visit(const LaunchDescription& description, const std::function<void()>& before) {
  if (!description.deprecated.empty()) {
    message(LogLevel::kWarning, "launch",
            fmt::format("launch file [{}] is deprecated: {}", description.file->path(), description.deprecated));
  }
  AtExit restore([this, outer = scope_.current_file] { scope_.current_file = outer; });
  scope_.current_file = description.file;
  if (description.file != nullptr) {
    files_.insert(description.file->path());
  }
  for (const auto& [name, value] : description.environment_changes) {
    if (value) {
      scope_.environment.insert_or_assign(name, *value);
    } else {
      scope_.environment.erase(name);
    }
  }
  if (before) {
    before();
  }
  visit(description.actions);
}

void LaunchContext::visit_in(Scope scope, const std::vector<ActionPtr>& actions) {
  AtExit restore([this, outer = scope_]() mutable { scope_ = std::move(outer); });
  scope_ = std::move(scope);
  visit(actions);
}

void LaunchContext::visit(const Invocation& invocation, bool planned) {
  const EventHandler& handler = *invocation.handler;
  if (!handler.live || planned) {
    Scope scope = handler.live ? Invocation::with_values(scope_, invocation.values) : invocation.scope();
    scope.only_planned = scope.only_planned || planned;
    scope.planned_by_timer = scope.planned_by_timer && !planned;
    visit_in(std::move(scope), handler.actions);
    return;
  }
  const auto before = scope_.configurations;
  AtExit restore([this, &invocation, &before, file = scope_.current_file] {
    scope_.current_file = file;
    for (const auto& [name, value] : invocation.values) {
      const std::string key = "event." + name;
      const auto outer = before.find(key);
      if (outer == before.end()) {
        scope_.configurations.erase(key);
      } else {
        scope_.configurations[key] = outer->second;
      }
    }
  });
  scope_.current_file = handler.scope.current_file;
  scope_ = Invocation::with_values(std::move(scope_), invocation.values);
  visit(handler.actions);
}

void LaunchContext::visit_left_out(const Action& action) {
  if (!exploration_.enters_left_out()) {
    return;
  }
  AtExit restore([this, scope = scope_, requests = std::move(requests_), nodes = nodes_,
                  messages = std::move(messages_)]() mutable {
    scope_ = std::move(scope);
    requests_ = std::move(requests);
    nodes_ = std::move(nodes);
    messages_ = std::move(messages);
    exploration_.leave_left_out();
  });
  requests_ = Requests{};
  messages_ = [](LogLevel, std::string_view, std::string_view) {};
  scope_.only_planned = scope_.only_planned || !exploration_.judges();
  try {
    action.execute(*this);
  } catch (const LaunchError& error) {
    if (!scope_.command_was_left_out()) {
      exploration_.report(error);
    }
  }
  scope_.forget_left_out_command();
  exploration_.tell_left_out(std::move(requests_));
}

LaunchContext::State LaunchContext::begin_again(MessageSink messages) {
  State before{std::move(scope_),
               std::move(requests_),
               std::move(nodes_),
               std::move(pushed_environments_),
               std::move(pushed_configurations_),
               std::move(messages_),
               machines_.take_assignments()};
  scope_ = *beginning_;
  scope_.packages = std::make_shared<PackageIndex>(own_prefix_);
  scope_.anonymous_names->used.clear();
  requests_ = Requests{};
  machines_.forget_trace();
  nodes_.clear();
  pushed_environments_.clear();
  pushed_configurations_.clear();
  messages_ = std::move(messages);
  return before;
}

void LaunchContext::put_back(State state) {
  scope_ = std::move(state.scope);
  requests_ = std::move(state.requests);
  nodes_ = std::move(state.nodes);
  pushed_environments_ = std::move(state.pushed_environments);
  pushed_configurations_ = std::move(state.pushed_configurations);
  messages_ = std::move(state.messages);
  machines_.put_assignments(std::move(state.assignments));
}

Requests LaunchContext::take_requests() {
  return std::exchange(requests_, Requests{});
}

// Here, because test_visits.hpp must not know the context that holds its class.
std::vector<FaultRequest> TestVisits::visit(LaunchContext& context, const std::vector<ActionPtr>& actions) {
  AtExit restore([this] { in_test_ = false; });
  in_test_ = true;
  context.visit_in(context.scope(), actions);
  return std::exchange(context.requests().faults, {});
}

void LaunchContext::note_node(const std::string& fully_qualified_name) {
  const int count = ++nodes_[fully_qualified_name];
  if (count > 1) {
    message(LogLevel::kWarning, "launch_ros.actions.node",
            fmt::format("there are now at least {} nodes with the name {} created within this launch context", count,
                        fully_qualified_name));
  }
}

}  // namespace launch
