// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/handlers/condition_handlers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <variant>

#include "base/overloaded.hpp"

namespace launch {

namespace {

const OnCondition& condition_of(const EventHandler& handler) {
  return std::get<OnCondition>(handler.event);
}

// What has never been there.
std::string nobody_of(const tracing::LiveCondition& condition) {
  using Subject = tracing::LiveCondition::Subject;
  switch (condition.subject) {
    case Subject::kTopic:
      return fmt::format("no {} of {}",
                         condition.kind == tracing::LiveCondition::Kind::kLate ? "subscription" : "publisher",
                         condition.name);
    case Subject::kNode:
      return fmt::format("no node {}", condition.name);
    case Subject::kService:
      return fmt::format("no client of {}", condition.name);
  }
  return "";
}

}  // namespace

void ConditionHandlers::use(ConditionWatch& watch, Callbacks callbacks) {
  watch_ = &watch;
  callbacks_ = std::move(callbacks);
  watch.observe([this](const tracing::ConditionReport& report) { on_report(report); });
}

void ConditionHandlers::add(EventHandler handler) {
  if (watch_ == nullptr) {
    fail_(LaunchError("nobody watches conditions on what nodes do here", handler.where));
    return;
  }
  const auto added = std::make_shared<const EventHandler>(std::move(handler));
  const tracing::ConditionId id = ++last_id_;
  handlers_.emplace(id, Watched{added, std::nullopt, nullptr});
  watch_->watch(id, condition_of(*added).condition);
}

bool ConditionHandlers::remove(const std::string& name) {
  return std::erase_if(handlers_, [&](const auto& each) {
           const bool is_meant = each.second.handler->name == name;
           if (is_meant) {
             watch_->forget(each.first);
           }
           return is_meant;
         }) != 0;
}

void ConditionHandlers::clear() {
  for (const auto& [id, watched] : handlers_) {
    watch_->forget(id);
  }
  handlers_.clear();
}

void ConditionHandlers::shutdown() {
  handlers_.clear();
  if (watch_ != nullptr) {
    watch_->close();
  }
}

void ConditionHandlers::on_report(const tracing::ConditionReport& report) {
  std::visit(Overloaded{
                 [this](const tracing::NodesAreRecorded&) { recorded_ = true; },
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

void ConditionHandlers::on_change(tracing::ConditionId id, const tracing::ConditionChange& change) {
  const auto found = handlers_.find(id);
  if (found == handlers_.end()) {
    return;  // removed meanwhile
  }
  Watched& watched = found->second;
  const std::shared_ptr<const EventHandler> handler = watched.handler;
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
  const Duration now = loop_.now();
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
    watch_->forget(id);
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
  std::string help = did_you_mean(condition.name, unseen.known);
  if (!help.empty()) {
    help = "; " + help;
  }
  callbacks_.message(LogLevel::kWarning,
                     fmt::format("{} was ever seen, {} after the begin of the recording ({}){}", nobody_of(condition),
                                 tracing::time_text(condition.grace), to_string(handler.where), help));
}

void ConditionHandlers::on_failure(const tracing::WatchFailed& failed) {
  if (handlers_.empty()) {
    return;
  }
  if (failed.tries_again) {
    callbacks_.message(LogLevel::kWarning,
                       fmt::format("conditions on what nodes do are not watched for a moment: {}", failed.error));
  } else if (recorded_) {
    callbacks_.message(LogLevel::kError,
                       fmt::format("conditions on what nodes do are not watched any more: {}", failed.error));
  } else {
    fail_(LaunchError(fmt::format("this condition can't be watched: {}", failed.error),
                      handlers_.begin()->second.handler->where, failed.help));
  }
}

}  // namespace launch
