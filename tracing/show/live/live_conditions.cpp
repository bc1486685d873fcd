// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/live/live_conditions.hpp"

#include <fnmatch.h>

#include <algorithm>
#include <string_view>
#include <utility>

namespace tracing {
namespace {

using Kind = LiveCondition::Kind;
using Subject = LiveCondition::Subject;

// An action is this service of its own.
constexpr std::string_view kResultService = "/_action/get_result";

bool is_of_subscriptions(Kind kind) {
  return kind == Kind::kLate || kind == Kind::kLoss;
}

std::string name_of_client(const LiveCondition& condition) {
  return condition.subject == Subject::kAction ? condition.name + std::string(kResultService) : condition.name;
}

bool fits(const std::string& pattern, const std::string& node) {
  return fnmatch(pattern.c_str(), node.c_str(), 0) == 0;
}

}  // namespace

LiveConditions::LiveConditions(LaunchedProcesses& processes, Tell tell)
    : processes_(processes), tell_(std::move(tell)), analysis_(this) {}

void LiveConditions::watch(ConditionId id, const LiveCondition& condition) {
  forget(id);
  Rule& rule = rules_.emplace(id, Rule{.id = id, .condition = condition}).first->second;
  if (condition.subject == Subject::kChain) {
    rule.chain = nodes_of_chain(condition.name).value_or(std::vector<std::string>());
    follow_chains();
  }
  // What is there already counts as seen now.
  visit_objects([&](const auto& objects, auto& index, auto is_meant, auto process_of) {
    for (ObjectId i = 0; i < index.size(); ++i) {
      if (is_meant(rule, objects[i])) {
        index[i].push_back(&rule);
        see(rule, process_of(objects[i]));
      }
    }
  });
}

template <typename Visit>
void LiveConditions::visit_objects(Visit visit) {
  const ObjectModel& objects = analysis_.objects();
  const auto process = [](const auto& object) { return object.process; };
  visit(
      objects.publishers(), of_publisher_,
      [this](const Rule& rule, const EndpointObject& publisher) { return is_named(rule, publisher, true); }, process);
  visit(
      objects.subscriptions(), of_subscription_,
      [this](const Rule& rule, const EndpointObject& subscription) { return is_named(rule, subscription, false); },
      process);
  visit(
      objects.nodes(), of_node_, [this](const Rule& rule, const NodeObject& node) { return is_named(rule, node); },
      process);
  visit(
      objects.clients(), of_client_,
      [this](const Rule& rule, const ClientObject& client) { return is_named(rule, client); },
      [this](const ClientObject& client) { return process_of(client); });
}

void LiveConditions::forget(ConditionId id) {
  const auto found = rules_.find(id);
  if (found == rules_.end()) {
    return;
  }
  for (std::vector<std::vector<Rule*>>* const index : {&of_publisher_, &of_subscription_, &of_node_, &of_client_}) {
    for (std::vector<Rule*>& rules : *index) {
      std::erase(rules, &found->second);
    }
  }
  const bool is_chain = found->second.condition.subject == Subject::kChain;
  rules_.erase(found);
  if (is_chain) {
    follow_chains();
  }
}

// What is on its way through the chains is not followed any more.
void LiveConditions::follow_chains() {
  std::vector<ChainDefinition> definitions;
  of_chain_.clear();
  chains_.reset();
  for (auto& [id, rule] : rules_) {
    if (!rule.chain.empty()) {
      definitions.push_back({.name = rule.condition.name, .nodes = rule.chain, .budget_ns = std::nullopt});
      of_chain_.push_back(&rule);
    }
  }
  if (!of_chain_.empty()) {
    chains_ = std::make_unique<WatchedChains>(analysis_.objects(), std::move(definitions),
                                              [this](std::size_t chain, std::int64_t input_ns, std::int64_t output_ns) {
                                                took(*of_chain_[chain], input_ns, output_ns);
                                              });
    chains_since_ns_ = now_ns_;
    // Programs declare these once.
    for (const auto& [publisher, subscriptions] : analysis_.chains().links()) {
      chains_->on_message_link({.subscriptions = subscriptions, .publishers = {publisher}});
    }
  }
}

void LiveConditions::on_event(const Event& event) {
  now_ns_ = std::max(now_ns_, event.timestamp_ns);
  analysis_.on_event(event);
  const ObjectModel& objects = analysis_.objects();
  if (of_publisher_.size() != objects.publishers().size() || of_node_.size() != objects.nodes().size() ||
      of_subscription_.size() != objects.subscriptions().size() || of_client_.size() != objects.clients().size()) {
    find_objects();
  }
}

void LiveConditions::on_loss(const Loss& loss) {
  doubt_ns_ = std::max(doubt_ns_, loss.end_ns.value_or(now_ns_));
  running_.clear();  // their ends may be among what was lost
  analysis_.on_loss(loss);
}

// What is late is late for those that get it.
bool LiveConditions::is_named(const Rule& rule, const EndpointObject& endpoint, bool publishes) {
  return rule.condition.subject == Subject::kTopic && publishes != is_of_subscriptions(rule.condition.kind) &&
         endpoint.topic != kNoObject && analysis_.objects().topics()[endpoint.topic].name == rule.condition.name &&
         is_ours(endpoint.process);
}

bool LiveConditions::is_named(const Rule& rule, const NodeObject& node) {
  const Subject subject = rule.condition.subject;
  const bool has_name = subject == Subject::kNode || subject == Subject::kTimer
                            ? node.name == rule.condition.name
                            : std::any_of(rule.chain.begin(), rule.chain.end(),
                                          [&](const std::string& pattern) { return fits(pattern, node.name); });
  return has_name && is_ours(node.process);
}

bool LiveConditions::is_whole(const Rule& rule) {
  const std::set<std::string> known = rule.chain.empty() ? std::set<std::string>() : known_names(rule.condition);
  return std::all_of(rule.chain.begin(), rule.chain.end(), [&](const std::string& pattern) {
    return std::any_of(known.begin(), known.end(), [&](const std::string& node) { return fits(pattern, node); });
  });
}

bool LiveConditions::is_named(const Rule& rule, const ClientObject& client) {
  return (rule.condition.subject == Subject::kService || rule.condition.subject == Subject::kAction) &&
         client.name == name_of_client(rule.condition) && is_ours(process_of(client));
}

ProcessId LiveConditions::process_of(const ClientObject& client) const {
  return client.node == kNoObject ? kNoProcess : analysis_.objects().nodes()[client.node].process;
}

void LiveConditions::find_objects() {
  subscription_since_.resize(analysis_.objects().subscriptions().size(), now_ns_);
  visit_objects([this](const auto& objects, auto& index, auto is_meant, auto process_of) {
    while (index.size() < objects.size()) {
      const auto& object = objects[index.size()];
      std::vector<Rule*>& waiting = index.emplace_back();
      for (auto& [id, rule] : rules_) {
        if (is_meant(rule, object)) {
          waiting.push_back(&rule);
          see(rule, process_of(object));
        }
      }
    }
  });
}

std::optional<std::int64_t> LiveConditions::vpid_of(ProcessId process) const {
  return process < analysis_.processes().size() ? analysis_.processes()[process].vpid : std::nullopt;
}

bool LiveConditions::is_ours(ProcessId process) {
  const auto [known, is_new] = ours_.try_emplace(process, false);
  if (is_new) {
    const std::optional<std::int64_t> vpid = vpid_of(process);
    known->second = vpid && processes_.label(*vpid);
  }
  return known->second;
}

// A new object of the name begins the count anew, unless another one is at work and all is well.
void LiveConditions::see(Rule& rule, ProcessId process) {
  check(rule, now_ns_);
  const bool was_alone = !lives(rule);
  std::erase_if(rule.processes, [&](ProcessId other) {
    const std::optional<std::int64_t> vpid = vpid_of(other);
    return !vpid || !processes_.lives(*vpid);
  });
  rule.processes.insert(process);
  rule.was_seen = is_whole(rule);
  const bool begins_anew = rule.holds || !rule.seen_ns || was_alone;
  if (rule.holds) {
    const Kind kind = rule.condition.kind;
    change(rule, false,
           kind == Kind::kSilence ? seconds_in(now_ns_ - rule.since_ns)
           : kind == Kind::kRate  ? rate_of(rule)
                                  : 0);
  }
  if (begins_anew) {
    rule.seen_ns = now_ns_;
    rule.parts = {};
  }
}

bool LiveConditions::lives(const Rule& rule) {
  return std::any_of(rule.processes.begin(), rule.processes.end(), [&](ProcessId process) {
    const std::optional<std::int64_t> vpid = vpid_of(process);
    return vpid && processes_.lives(*vpid);
  });
}

std::set<std::string> LiveConditions::known_names(const LiveCondition& condition) {
  std::set<std::string> known;
  const ObjectModel& objects = analysis_.objects();
  switch (condition.subject) {
    case Subject::kNode:
    case Subject::kTimer:
    case Subject::kChain:
      for (const NodeObject& node : objects.nodes()) {
        if (is_ours(node.process)) {
          known.insert(node.name);
        }
      }
      break;
    case Subject::kService:
    case Subject::kAction:
      for (const ClientObject& client : objects.clients()) {
        const bool is_action = client.name.ends_with(kResultService);
        if (is_action == (condition.subject == Subject::kAction) && is_ours(process_of(client))) {
          known.insert(client.name.substr(0, client.name.size() - (is_action ? kResultService.size() : 0)));
        }
      }
      break;
    case Subject::kProcess:
      break;
    case Subject::kTopic:
      for (const EndpointObject& endpoint :
           is_of_subscriptions(condition.kind) ? objects.subscriptions() : objects.publishers()) {
        if (endpoint.topic != kNoObject && is_ours(endpoint.process)) {
          known.insert(objects.topics()[endpoint.topic].name);
        }
      }
      break;
  }
  return known;
}

void LiveConditions::tell_unseen(std::chrono::nanoseconds now) {
  for (auto& [id, rule] : rules_) {
    if (rule.was_seen || rule.told_unseen) {
      continue;
    }
    if (!rule.unseen_since) {
      rule.unseen_since = now;
    }
    if (now - *rule.unseen_since < rule.condition.grace) {
      continue;
    }
    rule.told_unseen = true;
    const std::set<std::string> known = known_names(rule.condition);
    tell_(NameNotSeen{id, {known.begin(), known.end()}});
  }
}

}  // namespace tracing
