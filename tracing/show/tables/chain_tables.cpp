// SPDX-License-Identifier: Apache-2.0
// Chains of callbacks: what they consist of, and each time that something went through one.
#include <algorithm>
#include <map>

#include "tracing/show/tables/table_rows.hpp"

namespace tracing {

namespace {

using timeline::ChainHop;
using timeline::ChainPassage;
using timeline::Details;
using timeline::Index;
using timeline::kNone;

using Use = std::function<void(std::int64_t chain, const ChainPassage&)>;

// Calls use() for each passage of a chain that is in the results.
void for_each_passage(const TracedSystem& system, const Use& use) {
  std::multimap<std::uint32_t, std::int64_t> chains;  // by path
  for (std::size_t id = 0; id < system.results.ros2.chains.size(); ++id) {
    chains.emplace(system.results.ros2.chains[id].path, static_cast<std::int64_t>(id));
  }
  for (const ChainPassage& passage : system.timeline.details.passages) {
    const auto [first, last] = chains.equal_range(passage.path);
    for (auto chain = first; chain != last; ++chain) {
      use(chain->second, passage);
    }
  }
}

Table step_table(const TracedSystem& system) {
  Table table{"chain_steps",
              "the callbacks of each chain, with the times of the way to each",
              {{"chain", kInteger, "in `chains`"},
               {"step", kInteger, "counts from 0"},
               {"callback_id", kInteger, "in `callbacks`"}},
              nullptr};
  for (Column& column : ResultColumns<ChainResult::Step>::columns()) {
    table.columns.push_back(std::move(column));
  }
  table.for_each_row = [&system](const Emit& emit) {
    const ProcessPlaces places(system.timeline);
    std::deque<std::string> texts;
    for (std::size_t chain = 0; chain < system.results.ros2.chains.size(); ++chain) {
      const std::vector<ChainResult::Step>& steps = system.results.ros2.chains[chain].steps;
      for (std::size_t step = 0; step < steps.size(); ++step) {
        Row row{number(chain), number(step), number(steps[step].callback_id)};
        texts.clear();
        ResultColumns<ChainResult::Step>::add_cells(steps[step], places, row, texts);
        emit(row);
      }
    }
  };
  return table;
}

Table passage_table(const TracedSystem& system) {
  return {
      "chain_instances",
      "each time that something went through a chain: from an input, a begin of the first callback, to an output, "
      "an end of the last one; by output",
      {{"id"},
       {"chain", kInteger, "in `chains`"},
       {"begin_ns", kInteger, "the input"},
       {"end_ns", kInteger, "the output"},
       {"first", kInteger, "1: the first output of this input; `end_ns - begin_ns` is its response. 0: a further one"}},
      [&system](const Emit& emit) {
        std::int64_t id = 0;
        for_each_passage(system, [&](std::int64_t chain, const ChainPassage& passage) {
          emit({id++, chain, passage.input_ns, passage.output_ns, number(passage.is_first)});
        });
      }};
}

// The hops of a passage from the first one on.
void collect_hops(const Details& details, const ChainPassage& passage, std::vector<Index>& instances) {
  instances.clear();
  for (std::uint32_t hop = passage.last_hop; hop != kNone; hop = details.hops[hop].before) {
    instances.push_back(details.hops[hop].instance);
  }
  std::reverse(instances.begin(), instances.end());
}

Row hop_row(const timeline::Timeline& timeline, Index before, Index instance) {
  Row row(10);
  if (instance == kNone) {
    return row;
  }
  const timeline::Instance& run = timeline.instances[instance];
  row[2] = reference(instance);
  row[4] = run.start_ns;
  row[5] = run.finished ? Cell{run.end_ns - run.start_ns} : Cell{};
  if (before == kNone || run.message == kNone) {
    return row;
  }
  const timeline::Message& message = timeline.messages[run.message];
  row[3] = reference(run.message);
  row[6] = message.published_ns - timeline.instances[before].start_ns;
  row[7] = run.start_ns - message.published_ns;
  if (run.message < timeline.details.messages.size()) {
    const std::int64_t waited_ns = timeline.details.messages[run.message].waited_ns;
    row[8] = waited_ns < 0 ? Cell{} : Cell{message.taken_ns - message.published_ns - waited_ns};
  }
  row[9] = run.start_ns - message.taken_ns;
  return row;
}

Table hop_table(const TracedSystem& system) {
  return {"chain_hops",
          "the callbacks of each of these, with the times of the way to each",
          {{"chain_instance", kInteger, "in `chain_instances`"},
           {"step", kInteger, "counts from 0"},
           {"callback_instance", kInteger, "in `callback_instances`"},
           {"message", kInteger, "in `messages`: that led here; this and the last four in all steps but the first"},
           {"begin_ns", kInteger, "of the callback"},
           {"duration_ns", kInteger, "of the callback"},
           {"until_publish_ns", kInteger, "from the begin of the callback before to its publication"},
           {"transfer_ns", kInteger, "from there to the begin of this callback; its parts follow"},
           {"executor_ns", kInteger, "the wait for the executor"},
           {"take_ns", kInteger, "from `rmw_take` on"}},
          [&system](const Emit& emit) {
            std::int64_t id = 0;
            std::vector<Index> instances;
            for_each_passage(system, [&](std::int64_t, const ChainPassage& passage) {
              collect_hops(system.timeline.details, passage, instances);
              for (std::size_t step = 0; step < instances.size(); ++step) {
                Row row = hop_row(system.timeline, step == 0 ? kNone : instances[step - 1], instances[step]);
                row[0] = id;
                row[1] = number(step);
                emit(row);
              }
              ++id;
            });
          }};
}

}  // namespace

void add_chain_tables(const TracedSystem& system, std::vector<Table>& tables) {
  tables.push_back(result_table("chains",
                                "callbacks that follow from one another: those with names first, then from the slowest",
                                system, system.results.ros2.chains));
  tables.push_back(step_table(system));
  tables.push_back(passage_table(system));
  tables.push_back(hop_table(system));
}

}  // namespace tracing
