// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/twin/executors.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace tracing::twin {

namespace {

using ThreadKey = std::pair<timeline::Index, std::int64_t>;  // process, vtid

// As the trace tells it; kNone: it does not.
timeline::Index executor_of(const timeline::Timeline& timeline, timeline::Index callback) {
  const timeline::Index group = timeline.callbacks[callback].group;
  return group == timeline::kNone ? timeline::kNone : timeline.callback_groups[group].executor;
}

class Threads {
 public:
  explicit Threads(const Recording& recording) {
    for (const timeline::Instance& instance : recording.timeline.instances) {
      const timeline::Thread& thread = recording.timeline.threads[instance.thread];
      const std::size_t place = of({thread.process, thread.vtid});
      runs_[place] = true;
      thread_places_[instance.thread] = place;
    }
    for (const Recording::Look& look : recording.looks) {
      of({look.thread.process, look.thread.vtid});
    }
    mark_separate(recording);
    join(recording);
  }

  FoundExecutors executors(const Recording& recording) {
    FoundExecutors found;
    std::map<std::size_t, std::size_t> by_root;
    std::set<timeline::Index> with_runs;
    for (std::size_t place = 0; place < keys_.size(); ++place) {
      if (runs_[place]) {
        with_runs.insert(keys_[place].first);
      }
    }
    for (std::size_t place = 0; place < keys_.size(); ++place) {
      const std::size_t first = root(place);
      // A thread that only looks, such as one that asks a parameter client once, is no executor of its own.
      if (!runs_[first] && !any_runs(first)) {
        continue;
      }
      const auto [known, is_new] = by_root.try_emplace(first, found.executors.size());
      if (is_new) {
        found.executors.push_back({keys_[place].first, {}, false});
      }
      found.executors[known->second].threads.push_back(keys_[place].second);
      found.executors[known->second].waits = found.executors[known->second].waits || waits_[place];
    }
    found.executor_of.assign(recording.timeline.callbacks.size(), FoundExecutors::kNone);
    for (const timeline::Instance& instance : recording.timeline.instances) {
      if (found.executor_of[instance.callback] == FoundExecutors::kNone) {
        found.executor_of[instance.callback] = by_root.at(root(thread_places_.at(instance.thread)));
      }
    }
    return found;
  }

 private:
  std::size_t of(const ThreadKey& key) {
    const auto [known, is_new] = places_.try_emplace(key, keys_.size());
    if (is_new) {
      keys_.push_back(key);
      parent_.push_back(known->second);
      runs_.push_back(false);
      waits_.push_back(false);
    }
    return known->second;
  }

  std::size_t root(std::size_t place) {
    while (parent_[place] != place) {
      place = parent_[place] = parent_[parent_[place]];
    }
    return place;
  }

  bool any_runs(std::size_t first) {
    for (std::size_t place = 0; place < keys_.size(); ++place) {
      if (runs_[place] && root(place) == first) {
        return true;
      }
    }
    return false;
  }

  // Threads that waited at the same time.
  void mark_separate(const Recording& recording) {
    std::map<timeline::Index, std::vector<std::pair<std::int64_t, std::size_t>>> open;  // end of a wait, thread
    for (const Recording::Wait& wait : recording.waits) {
      const std::size_t place = of({wait.thread.process, wait.thread.vtid});
      waits_[place] = true;
      auto& others = open[wait.thread.process];
      std::erase_if(others, [&](const auto& other) { return other.first <= wait.begin_ns; });
      for (const auto& other : others) {
        if (other.second != place) {
          separate_.insert({std::min(place, other.second), std::max(place, other.second)});
        }
      }
      others.push_back({wait.end_ns, place});
    }
  }

  void unite(std::size_t left, std::size_t right) { parent_[root(right)] = root(left); }

  void join(const Recording& recording) {
    std::vector<std::size_t> first_of(recording.timeline.executors.size(), FoundExecutors::kNone);
    for (const timeline::Instance& instance : recording.timeline.instances) {
      if (const timeline::Index executor = executor_of(recording.timeline, instance.callback);
          executor != timeline::kNone) {
        std::size_t& first = first_of[executor];
        const std::size_t place = thread_places_.at(instance.thread);
        if (first == FoundExecutors::kNone) {
          first = place;
        } else {
          unite(first, place);
        }
      }
    }
    std::vector<std::size_t> runner(recording.timeline.callbacks.size(), FoundExecutors::kNone);
    for (const timeline::Instance& instance : recording.timeline.instances) {
      std::size_t& first = runner[instance.callback];
      const std::size_t place = thread_places_.at(instance.thread);
      if (first == FoundExecutors::kNone) {
        first = place;
      } else {
        unite(first, place);
      }
    }
    for (std::size_t left = 0; left < keys_.size(); ++left) {
      for (std::size_t right = left + 1; right < keys_.size(); ++right) {
        if (keys_[left].first == keys_[right].first && waits_[left] && waits_[right] && !are_separate(left, right)) {
          unite(left, right);
        }
      }
    }
  }

  // Whether any thread of the one's executor has waited beside one of the other's.
  bool are_separate(std::size_t left, std::size_t right) {
    return std::any_of(separate_.begin(), separate_.end(), [&](const auto& pair) {
      const std::size_t first = root(pair.first);
      const std::size_t second = root(pair.second);
      return (first == root(left) && second == root(right)) || (first == root(right) && second == root(left));
    });
  }

  std::map<ThreadKey, std::size_t> places_;
  std::vector<ThreadKey> keys_;
  std::vector<std::size_t> parent_;
  std::vector<bool> runs_;
  std::vector<bool> waits_;
  std::map<timeline::Index, std::size_t> thread_places_;  // of a thread of the timeline
  std::set<std::pair<std::size_t, std::size_t>> separate_;
};

// Pairs of callbacks of one node that ran at the same time; (c, c): twice.
std::set<std::pair<timeline::Index, timeline::Index>> overlaps_of(const Recording& recording) {
  std::set<std::pair<timeline::Index, timeline::Index>> overlaps;
  std::map<timeline::Index, std::vector<const timeline::Instance*>> running;  // by node
  for (const timeline::Instance& instance : recording.timeline.instances) {
    const timeline::Index node = recording.timeline.callbacks[instance.callback].node;
    if (node == timeline::kNone) {
      continue;
    }
    std::vector<const timeline::Instance*>& others = running[node];
    std::erase_if(others, [&](const timeline::Instance* other) { return other->end_ns <= instance.start_ns; });
    for (const timeline::Instance* other : others) {
      if (other->thread != instance.thread) {
        overlaps.insert(std::minmax(other->callback, instance.callback));
      }
    }
    others.push_back(&instance);
  }
  return overlaps;
}

}  // namespace

FoundExecutors find_executors(const Recording& recording) {
  FoundExecutors found = Threads(recording).executors(recording);
  const timeline::Timeline& timeline = recording.timeline;
  for (timeline::Index callback = 0; callback < timeline.callbacks.size(); ++callback) {
    const timeline::Index recorded = executor_of(timeline, callback);
    if (recorded != timeline::kNone && found.executor_of[callback] != FoundExecutors::kNone) {
      found.executors[found.executor_of[callback]].recorded_kind = timeline.executors[recorded].kind;
    }
  }
  std::map<std::pair<timeline::Index, timeline::Index>, std::size_t> recorded_groups;  // by node and group
  const auto overlaps = overlaps_of(recording);
  found.group_of.assign(recording.timeline.callbacks.size(), FoundExecutors::kNone);
  std::vector<std::vector<timeline::Index>> members;
  for (timeline::Index callback = 0; callback < recording.timeline.callbacks.size(); ++callback) {
    const timeline::Index node = recording.timeline.callbacks[callback].node;
    const std::size_t executor = found.executor_of[callback];
    if (executor == FoundExecutors::kNone || node == timeline::kNone) {
      continue;
    }
    if (const timeline::Index recorded = timeline.callbacks[callback].group; recorded != timeline::kNone) {
      const auto [known, is_new] = recorded_groups.try_emplace({node, recorded}, members.size());
      if (is_new) {
        members.emplace_back();
        found.groups.push_back({node, executor, timeline.callback_groups[recorded].kind == "reentrant"});
      }
      found.group_of[callback] = known->second;
      members[known->second].push_back(callback);
      continue;
    }
    const bool reentrant = overlaps.contains({callback, callback});
    for (std::size_t group = 0; group < members.size(); ++group) {
      const FoundGroup& known = found.groups[group];
      if (known.node == node && known.executor == executor && known.reentrant == reentrant &&
          (reentrant || std::none_of(members[group].begin(), members[group].end(), [&](timeline::Index member) {
             return overlaps.contains(std::minmax(member, callback));
           }))) {
        found.group_of[callback] = group;
        break;
      }
    }
    if (found.group_of[callback] == FoundExecutors::kNone) {
      found.group_of[callback] = members.size();
      members.emplace_back();
      found.groups.push_back({node, executor, reentrant});
    }
    members[found.group_of[callback]].push_back(callback);
  }
  return found;
}

}  // namespace tracing::twin
