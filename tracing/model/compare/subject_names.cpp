// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/compare/subject_names.hpp"

#include <fmt/format.h>

#include <map>

#include "tracing/model/objects/callback_symbol.hpp"
#include "tracing/model/objects/object_names.hpp"

namespace tracing::compare {

namespace {

// Objects with equal names are told apart by the order of their creation.
std::string numbered(const std::string& name, std::map<std::string, int>& seen) {
  const int number = ++seen[name];
  return number == 1 ? name : fmt::format("{} #{}", name, number);
}

}  // namespace

SubjectNames::SubjectNames(const TraceAnalysis& analysis)
    : objects_(analysis.objects()), processes_(analysis.processes()) {
  std::map<std::string, int> seen;
  for (const CallbackObject& callback : objects_.callbacks()) {
    callbacks_.push_back(numbered(owner_of(callback) + ", " + source_of(callback), seen));
  }
  seen.clear();
  for (const EndpointObject& subscription : objects_.subscriptions()) {
    const std::string& topic = objects_.topics()[subscription.topic].name;
    subscriptions_.push_back(numbered(topic + " to " + node_of(subscription.node), seen));
  }
}

std::string SubjectNames::node_of(ObjectId node) const {
  return node == kNoObject ? "an unknown node" : objects_.nodes()[node].name;
}

// The node, or the program if the trace does not tell the node.
std::string SubjectNames::owner_of(const CallbackObject& callback) const {
  const std::string node = node_name(objects_, callback);
  if (!node.empty()) {
    return node;
  }
  const std::string program = callback.process < processes_.size() ? processes_[callback.process].name : "";
  return program.empty() ? "an unknown node" : program;
}

std::string SubjectNames::source_of(const CallbackObject& callback) const {
  using Owner = CallbackObject::Owner;
  if (objects_.subscription_of(callback) != kNoObject) {
    return callback_source(objects_, callback);
  }
  const bool has_owner =
      callback.owner_id != kNoObject &&
      (callback.owner == Owner::kTimer || callback.owner == Owner::kService || callback.owner == Owner::kClient);
  if (has_owner) {
    return callback_source(objects_, callback);
  }
  const std::string symbol = readable_symbol(callback.symbol);
  return symbol.empty() ? "a callback without a name" : symbol;
}

std::string SubjectNames::step(ObjectId id) const {
  const CallbackObject& callback = objects_.callbacks()[id];
  const ObjectId subscription = objects_.subscription_of(callback);
  const std::string source = subscription == kNoObject
                                 ? source_of(callback)
                                 : objects_.topics()[objects_.subscriptions()[subscription].topic].name;
  return fmt::format("{} ({})", owner_of(callback), source);
}

std::string SubjectNames::call(ObjectId client, ObjectId service) const {
  const ClientObject& asking = objects_.clients()[client];
  const std::string name = service == kNoObject ? asking.name : objects_.services()[service].name;
  return fmt::format("{}, asked by {}", name, node_of(asking.node));
}

}  // namespace tracing::compare
