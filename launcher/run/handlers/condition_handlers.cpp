// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/handlers/condition_handlers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fnmatch.h>

#include <algorithm>
#include <variant>

#include "base/overloaded.hpp"

namespace launch {

namespace {

const OnCondition& condition_of(const EventHandler& handler) {
  return std::get<OnCondition>(handler.event);
}

// The name that nothing has: of a chain, that of its first node that is not there.
std::string unseen_name(const tracing::LiveCondition& condition, const std::vector<std::string>& known) {
  if (condition.subject == tracing::LiveCondition::Subject::kChain) {
    for (const std::string& node : tracing::nodes_of_chain(condition.name).value_or(std::vector<std::string>())) {
      const bool is_known = std::any_of(known.begin(), known.end(), [&](const std::string& other) {
        return fnmatch(node.c_str(), other.c_str(), 0) == 0;
      });
      if (!is_known) {
        return node;
      }
    }
  }
  return condition.name;
}

// What of that name has never been there.
const char* kind_of_unseen(const tracing::LiveCondition& condition) {
  using Subject = tracing::LiveCondition::Subject;
  using Kind = tracing::LiveCondition::Kind;
  switch (condition.subject) {
    case Subject::kTopic:
      return condition.kind == Kind::kLate || condition.kind == Kind::kLoss ? "subscription of" : "publisher of";
    case Subject::kNode:
    case Subject::kTimer:
    case Subject::kChain:
      return "node";
    case Subject::kService:
    case Subject::kAction:
      return "client of";
    case Subject::kProcess:
      return "process";
  }
  return "";
}

}  // namespace

void ConditionHandlers::use(ConditionWatch& recorded, ConditionWatch& processes, Callbacks callbacks) {
  recorded_watch_ = &recorded;
  process_watch_ = &processes;
  callbacks_ = std::move(callbacks);
  for (ConditionWatch* const watch : {recorded_watch_, process_watch_}) {
    watch->observe([this](const tracing::ConditionReport& report) { on_report(report); });
  }
}

ConditionWatch& ConditionHandlers::watch_of(const EventHandler& handler) const {
  return is_of_process(condition_of(handler).condition) ? *process_watch_ : *recorded_watch_;
}

void ConditionHandlers::add(EventHandler handler) {
  if (recorded_watch_ == nullptr) {
    fail_(LaunchError("nobody watches conditions on what nodes do here", handler.where));
    return;
  }
  const auto added = std::make_shared<const EventHandler>(std::move(handler));
  const tracing::ConditionId id = ++last_id_;
  handlers_.emplace(id, Watched{.handler = added});
  watch_of(*added).watch(id, condition_of(*added).condition);
}

bool ConditionHandlers::remove(const std::string& name) {
  return std::erase_if(handlers_, [&](const auto& each) {
           const bool is_meant = each.second.handler->name == name;
           if (is_meant) {
             watch_of(*each.second.handler).forget(each.first);
           }
           return is_meant;
         }) != 0;
}

void ConditionHandlers::clear() {
  for (const auto& [id, watched] : handlers_) {
    watch_of(*watched.handler).forget(id);
  }
  handlers_.clear();
}

void ConditionHandlers::shutdown() {
  handlers_.clear();
  for (ConditionWatch* const watch : {recorded_watch_, process_watch_}) {
    if (watch != nullptr) {
      watch->close();
    }
  }
}

void ConditionHandlers::on_report(const tracing::ConditionReport& report) {
  std::visit(Overloaded{
                 [this](const tracing::NodesAreRecorded&) {
                   if (std::exchange(recorded_, true)) {
                     begin_anew();  // another program of the watch
                   }
                 },
                 [this](const tracing::ConditionChanged& changed) { on_change(changed.id, changed.change); },
                 [this](const tracing::NameNotSeen& unseen) { on_unseen(unseen); },
                 [this](const tracing::RecordingIsBehind& behind) {
                   callbacks_.message(behind.seconds > 0 ? LogLevel::kWarning : LogLevel::kInfo,
                                      behind.seconds > 0
                                          ? fmt::format("what nodes do comes {:.0f} s late: until then no condition is "
                                                        "decided",
                                                        behind.seconds)
                                          : "what nodes do is known in time again");
                 },
                 [this](const tracing::WatchFailed& failed) { on_failure(failed); },
             },
             report);
}

void ConditionHandlers::begin_anew() {
  constexpr std::chrono::seconds kStart{5};
  for (auto& [id, watched] : handlers_) {
    const tracing::LiveCondition& condition = condition_of(*watched.handler).condition;
    if (is_of_process(condition) || !watched.holds) {
      continue;
    }
    watched.holds = false;
    watched.goes_on_until = loop_.now() + 2 * condition.window + kStart;
    watched.owes_visit = watched.later != nullptr;
    watched.later.reset();
  }
}

void ConditionHandlers::suspend(bool stops) {
  for (const auto& [id, watched] : handlers_) {
    const tracing::LiveCondition& condition = condition_of(*watched.handler).condition;
    if (is_of_process(condition)) {
      continue;
    }
    if (stops) {
      recorded_watch_->forget(id);
    } else {
      recorded_watch_->watch(id, condition);
    }
  }
  if (!stops) {
    begin_anew();
  }
}

void ConditionHandlers::on_change(tracing::ConditionId id, const tracing::ConditionChange& change) {
  const auto found = handlers_.find(id);
  if (found == handlers_.end()) {
    return;  // removed meanwhile
  }
  Watched& watched = found->second;
  const std::shared_ptr<const EventHandler> handler = watched.handler;
  const Duration now = loop_.now();
  if (change.holds && watched.holds) {
    return;
  }
  watched.holds = change.holds;
  const std::optional<Duration> goes_on_until = std::exchange(watched.goes_on_until, std::nullopt);
  if (change.holds && goes_on_until && now < *goes_on_until && !std::exchange(watched.owes_visit, false)) {
    return;  // it was visited for that
  }
  const OnCondition& wanted = condition_of(*handler);
  const std::string of =
      change.processes.empty() ? std::string() : fmt::format(" ({})", fmt::join(change.processes, ", "));
  callbacks_.message(change.holds ? LogLevel::kWarning : LogLevel::kInfo,
                     fmt::format("{}{}", sentence(wanted.condition, change), of));
  callbacks_.changed({wanted.condition, change, handler->where});
  watched.later.reset();
  if (!change.holds) {
    return;
  }
  if (watched.visited && now - *watched.visited < wanted.cool_down) {
    watched.later = loop_.after(*watched.visited + wanted.cool_down - now, [this, id, change] { visit(id, change); });
    return;
  }
  visit(id, change);
}

void ConditionHandlers::visit(tracing::ConditionId id, const tracing::ConditionChange& change) {
  const auto found = handlers_.find(id);
  if (found == handlers_.end()) {
    return;
  }
  const std::shared_ptr<const EventHandler> handler = found->second.handler;
  found->second.visited = loop_.now();
  if (handler->once) {
    watch_of(*handler).forget(id);
    handlers_.erase(found);
  }
  invoke_({{handler, values_of(condition_of(*handler), change)}});
}

void ConditionHandlers::on_unseen(const tracing::NameNotSeen& unseen) {
  const auto found = handlers_.find(unseen.id);
  if (found == handlers_.end()) {
    return;
  }
  const EventHandler& handler = *found->second.handler;
  const tracing::LiveCondition& condition = condition_of(handler).condition;
  const std::string name = unseen_name(condition, unseen.known);
  std::string help = did_you_mean(name, unseen.known);
  if (!help.empty()) {
    help = "; " + help;
  }
  callbacks_.message(LogLevel::kWarning,
                     fmt::format("no {} {} was ever seen, {} after the begin of the {} ({}){}",
                                 kind_of_unseen(condition), name, tracing::time_text(condition.grace),
                                 is_of_process(condition) ? "watch" : "recording", to_string(handler.where), help));
}

void ConditionHandlers::on_failure(const tracing::WatchFailed& failed) {
  const auto first = std::find_if(handlers_.begin(), handlers_.end(), [](const auto& each) {
    return !is_of_process(condition_of(*each.second.handler).condition);
  });
  if (first == handlers_.end()) {
    return;
  }
  if (failed.tries_again) {
    callbacks_.message(LogLevel::kWarning,
                       fmt::format("conditions on what nodes do are not watched for a moment: {}", failed.error));
  } else if (recorded_) {
    callbacks_.message(LogLevel::kError,
                       fmt::format("conditions on what nodes do are not watched any more: {}", failed.error));
  } else {
    fail_(LaunchError(fmt::format("this condition can't be watched: {}", failed.error), first->second.handler->where,
                      failed.help));
  }
}

}  // namespace launch
