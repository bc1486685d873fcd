// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <iterator>
#include <utility>

#include "tracing/model/analysis/summary/summary.hpp"
#include "tracing/model/objects/object_names.hpp"

namespace tracing {

namespace {

// By topic, whether the publications of messages were estimated.
using EstimatedTopics = std::vector<bool>;

ChainResult chain_result(const Subjects& subjects, const ChainTracker& chains, const ChainRecord& last,
                         const EstimatedTopics& estimated) {
  const ObjectModel& model = subjects.model();
  ChainResult result;
  for (const ChainRecord* step = &last; step != nullptr;
       step = step->parent == kNoPath ? nullptr : &chains.paths()[step->parent]) {
    const CallbackObject& callback = model.callbacks()[step->callback];
    ChainResult::Step shown;
    shown.process = subjects.place_of(callback.process);
    shown.node = node_name(model, callback);
    shown.callback = callback_source(model, callback);
    shown.callback_id = step->callback;
    if (step->topic != kNoObject) {
      shown.topic = model.topics()[step->topic].name;
      result.estimated = result.estimated || (step->topic < estimated.size() && estimated[step->topic]);
    }
    shown.until_publish = step->until_publish.summary();
    shown.transfer = step->transfer.summary();
    shown.transport = step->transport.summary();
    shown.executor = step->executor.summary();
    shown.take = step->take.summary();
    if (subjects.is_doubtful(shown.process)) {
      result.doubtful = true;
    }
    result.steps.insert(result.steps.begin(), std::move(shown));
  }
  result.last_callback = last.last_callback.summary();
  result.response = last.response.summary();
  result.reaction = last.reaction.summary();
  result.age = last.age.summary();
  result.longest_begin_ns = last.longest_begin_ns;
  result.longest_end_ns = last.longest_end_ns;
  result.is_loop = last.is_cut;
  result.path = static_cast<std::uint32_t>(&last - chains.paths().data());
  return result;
}

// Whether the chain began at least once without a known cause.
bool is_natural(const ChainTracker& chains, const ChainRecord& last) {
  const ChainRecord* first = &last;
  while (first->parent != kNoPath) {
    first = &chains.paths()[first->parent];
  }
  return first->is_natural;
}

}  // namespace

void add_chain_results(const Subjects& subjects, const ChainTracker& chains, const MessageMatcher& messages,
                       Ros2Results& results) {
  EstimatedTopics estimated;
  for (const TopicRecord& record : messages.records()) {
    estimated.push_back(record.estimated > 0);
  }
  std::vector<std::pair<std::size_t, ChainResult>> named;  // by definition
  for (const ChainRecord& last : chains.paths()) {
    if (last.length < 2 || last.response.count() == 0) {
      continue;
    }
    for (const NamedPath& path : last.named) {
      const ChainDefinition& definition = chains.definitions()[path.definition];
      ChainResult result = chain_result(subjects, chains, last, estimated);
      result.name = definition.name;
      result.budget_ns = definition.budget_ns;
      result.over_budget = path.over_budget;
      named.emplace_back(path.definition, std::move(result));
    }
    if (last.named.empty() && !last.goes_on && is_natural(chains, last)) {
      results.chains.push_back(chain_result(subjects, chains, last, estimated));
    }
  }
  // A chain that hardly ever was gone through says little.
  const auto is_frequent = [](const ChainResult& chain) { return chain.response.count >= 5; };
  const auto comes_before = [&](const ChainResult& a, const ChainResult& b) {
    return std::pair(is_frequent(a), a.response.p99_ns) > std::pair(is_frequent(b), b.response.p99_ns);
  };
  std::stable_sort(results.chains.begin(), results.chains.end(), comes_before);
  std::stable_sort(named.begin(), named.end(), [&](const auto& a, const auto& b) {
    return a.first != b.first ? a.first < b.first : comes_before(a.second, b.second);
  });
  std::vector<ChainResult> first;
  for (auto& [definition, chain] : named) {
    first.push_back(std::move(chain));
  }
  results.chains.insert(results.chains.begin(), std::make_move_iterator(first.begin()),
                        std::make_move_iterator(first.end()));
  for (const ChainDefinition& definition : chains.definitions()) {
    const bool is_seen = std::any_of(results.chains.begin(), results.chains.end(),
                                     [&](const ChainResult& chain) { return chain.name == definition.name; });
    if (!is_seen) {
      results.unseen_chains.push_back(definition.name);
    }
  }
  results.has_all_chains = !chains.is_full();
}

}  // namespace tracing
