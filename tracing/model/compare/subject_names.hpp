// SPDX-License-Identifier: Apache-2.0
// Names of what is compared that are the same in every run of a system: without process numbers and addresses.
#pragma once

#include <string>
#include <vector>

#include "tracing/model/analysis/trace_analysis.hpp"

namespace tracing::compare {

class SubjectNames {
 public:
  // The analysis must outlive the names.
  explicit SubjectNames(const TraceAnalysis& analysis);

  const std::string& callback(ObjectId callback) const { return callbacks_[callback]; }
  const std::string& subscription(ObjectId subscription) const { return subscriptions_[subscription]; }
  std::string call(ObjectId client, ObjectId service) const;
  // "/filter (/scan)": a callback as a step of a chain.
  std::string step(ObjectId callback) const;

 private:
  std::string node_of(ObjectId node) const;
  std::string source_of(const CallbackObject& callback) const;
  std::string owner_of(const CallbackObject& callback) const;

  const ObjectModel& objects_;
  const std::vector<ProcessObject>& processes_;
  std::vector<std::string> callbacks_;
  std::vector<std::string> subscriptions_;
};

}  // namespace tracing::compare
