// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/messages/chain_tracker.hpp"

#include <fnmatch.h>

#include <algorithm>
#include <optional>

#include "tracing/model/messages/hop_times.hpp"
#include "tracing/model/objects/object_names.hpp"

namespace tracing {

bool ChainTracker::is_in_path(PathId path, ObjectId callback) const {
  for (; path != kNoPath; path = paths_[path].parent) {
    if (paths_[path].callback == callback) {
      return true;
    }
  }
  return false;
}

PathId ChainTracker::find_path(PathId parent, ObjectId topic, ObjectId callback) {
  const auto [found, is_new] = index_.try_emplace({parent, topic, callback}, kNoPath);
  if (!is_new) {
    if (parent != kNoPath) {
      paths_[parent].last_topic = topic;
      paths_[parent].last_next = callback;
      paths_[parent].last_path = found->second;
    }
    return found->second;
  }
  if (paths_.size() >= kPaths) {
    is_full_ = true;
    return kNoPath;
  }
  ChainRecord record;
  record.parent = parent;
  record.topic = topic;
  record.callback = callback;
  if (parent != kNoPath) {
    record.length = paths_[parent].length + 1;
    record.is_cut = is_in_path(parent, callback);
    paths_[parent].goes_on = true;
  }
  found->second = static_cast<PathId>(paths_.size());
  paths_.push_back(std::move(record));
  return found->second;
}

std::uint32_t ChainTracker::hop_of(std::uint32_t before, const ThreadId& thread, std::int64_t begin_ns) {
  if (!keeps_passages_) {
    return ChainHop::kNone;
  }
  kept_.hops.push_back({before, thread.process, thread.vtid, begin_ns});
  return static_cast<std::uint32_t>(kept_.hops.size() - 1);
}

void ChainTracker::begin_chain(const ThreadId& thread, Trails& trails, ObjectId callback, std::int64_t begin_ns) {
  if (callback >= first_.size()) {
    first_.resize(callback + 1, kNoPath);
  }
  PathId& path = first_[callback];
  if (path == kNoPath) {
    path = find_path(kNoPath, kNoObject, callback);
  }
  if (path != kNoPath) {
    trails.push_back({path, hop_of(ChainHop::kNone, thread, begin_ns), begin_ns, begin_ns});
  }
}

std::string ChainTracker::node_of(ObjectId callback) const {
  return node_name(*model_, model_->callbacks()[callback]);
}

bool ChainTracker::begins_named_chain(ObjectId callback) {
  if (definitions_.empty()) {
    return false;
  }
  if (callback >= begins_.size()) {
    begins_.resize(callback + 1, Begins::kUnknown);
  }
  if (begins_[callback] == Begins::kUnknown) {
    const std::string node = node_of(callback);
    if (node.empty()) {
      return false;  // it may become known
    }
    const bool begins = std::any_of(definitions_.begin(), definitions_.end(), [&node](const ChainDefinition& chain) {
      return fnmatch(chain.nodes.front().c_str(), node.c_str(), 0) == 0;
    });
    begins_[callback] = begins ? Begins::kYes : Begins::kNo;
  }
  return begins_[callback] == Begins::kYes;
}

void ChainTracker::compare_with_definitions(PathId path) {
  paths_[path].is_compared = true;
  if (definitions_.empty() || paths_[path].parent == kNoPath) {
    return;
  }
  std::vector<std::string> nodes;
  for (PathId step = path; step != kNoPath; step = paths_[step].parent) {
    nodes.push_back(node_of(paths_[step].callback));
  }
  std::reverse(nodes.begin(), nodes.end());
  for (std::size_t id = 0; id < definitions_.size(); ++id) {
    const std::vector<std::string>& patterns = definitions_[id].nodes;
    const auto fits = [](const std::string& pattern, const std::string& node) {
      return fnmatch(pattern.c_str(), node.c_str(), 0) == 0;
    };
    if (!fits(patterns.front(), nodes.front()) || !fits(patterns.back(), nodes.back())) {
      continue;
    }
    // Those between, in their order, before the last node.
    std::size_t passed = 1;
    for (std::size_t i = 1; i + 1 < nodes.size() && passed + 1 < patterns.size(); ++i) {
      if (fits(patterns[passed], nodes[i])) {
        ++passed;
      }
    }
    if (passed + 1 == patterns.size()) {
      paths_[path].named.push_back({id, 0});
    }
  }
}

void ChainTracker::on_callback_begin(const CallbackInstance& instance) {
  // As long as no message is known that caused it, the callback begins a chain.
  active_[instance.thread].emplace_back(instance.callback, instance.begin_ns);
}

void ChainTracker::on_message(const MessageFlow& message) {
  if (message.callback == kNoObject) {
    return;
  }
  std::vector<Active>* const running = active_.find(message.taking_thread);
  if (running == nullptr || running->empty()) {
    return;
  }
  Active& active = running->back();
  if (active.callback != message.callback) {
    return;
  }
  if (begins_named_chain(active.callback)) {
    begin_chain(message.taking_thread, active.trails, active.callback, active.begin_ns);
  }
  const bool is_named_begin = !active.trails.empty();
  if (message.publication.number != 0 && !sent_.empty()) {
    const Sent& sent = sent_[message.publication.number % kRemembered];
    if (sent.number == message.publication.number) {
      const std::optional<std::int64_t> waited_ns = hop_times(message).executor_ns;
      for (const Trail& cause : sent.trails) {
        const PathId path = path_of(cause.path, message.publication.topic, message.callback);
        if (path == kNoPath) {
          continue;
        }
        paths_[path].until_publish.add(sent.published_ns - cause.callback_ns);
        paths_[path].transfer.add(active.begin_ns - sent.published_ns);
        paths_[path].transport.add(message.taken_ns - sent.published_ns - waited_ns.value_or(0));
        paths_[path].take.add(active.begin_ns - message.taken_ns);
        if (waited_ns) {
          paths_[path].executor.add(*waited_ns);
        }
        active.trails.push_back(
            {path, hop_of(cause.hop, message.taking_thread, active.begin_ns), cause.input_ns, active.begin_ns});
      }
    }
  }
  if (is_named_begin && active.trails.size() == 1) {
    paths_[active.trails.begin()->path].is_natural = true;
  }
  if (const auto latest = latest_.find(message.subscription); latest != latest_.end()) {
    latest->second = active.trails;
    if (latest->second.empty()) {
      begin_chain(message.taking_thread, latest->second, active.callback, active.begin_ns);
      for (const Trail& trail : latest->second) {
        paths_[trail.path].is_natural = true;
      }
    }
  }
}

void ChainTracker::on_publication(const Publication& publication) {
  Trails& trails = causes_;
  trails.clear();
  const auto add = [&](const Trail& trail) {
    if (!paths_[trail.path].is_cut) {
      trails.push_back(trail);
    }
  };
  if (std::vector<Active>* const running = active_.find(publication.thread); running != nullptr && !running->empty()) {
    Active& active = running->back();
    if (active.trails.empty()) {
      begin_chain(publication.thread, active.trails, active.callback, active.begin_ns);
      for (const Trail& trail : active.trails) {
        paths_[trail.path].is_natural = true;
      }
    }
    for (const Trail& trail : active.trails) {
      add(trail);
    }
  }
  if (const auto link = links_.find(publication.publisher); link != links_.end()) {
    for (const ObjectId subscription : link->second) {
      for (const Trail& cause : latest_[subscription]) {
        const bool is_known =
            std::any_of(trails.begin(), trails.end(), [&](const Trail& trail) { return trail.path == cause.path; });
        if (!is_known) {
          add(cause);
        }
      }
    }
  }
  if (trails.empty()) {
    return;
  }
  if (sent_.empty()) {
    sent_.resize(kRemembered);
  }
  Sent& sent = sent_[publication.number % kRemembered];
  sent.number = publication.number;
  sent.published_ns = publication.published_ns;
  sent.trails = trails;
  // The next one has been in no cache for long.
  __builtin_prefetch(&sent_[(publication.number + 1) % kRemembered], 1);
}

void ChainTracker::on_message_link(const MessageLink& link) {
  for (const ObjectId publisher : link.publishers) {
    std::vector<ObjectId>& causes = links_[publisher];
    for (const ObjectId subscription : link.subscriptions) {
      if (std::find(causes.begin(), causes.end(), subscription) == causes.end()) {
        causes.push_back(subscription);
      }
      latest_.try_emplace(subscription);
    }
  }
}

void ChainTracker::end(const Trail& trail, std::int64_t end_ns) {
  if (!paths_[trail.path].is_compared) {
    compare_with_definitions(trail.path);
  }
  ChainRecord& chain = paths_[trail.path];
  if (chain.last_input_ns != 0 && trail.input_ns < chain.last_input_ns) {
    return;  // overtaken by a newer input
  }
  // Where a chain goes on, no chain of the results ends, unless it has a name.
  if (keeps_passages_ && chain.parent != kNoPath && (!chain.goes_on || !chain.named.empty())) {
    kept_.passages.push_back({trail.path, trail.hop, trail.input_ns, end_ns, trail.input_ns != chain.last_input_ns});
  }
  if (trail.input_ns != chain.last_input_ns) {
    const std::int64_t response = end_ns - trail.input_ns;
    chain.response.add(response);
    on_response(trail.path, trail.input_ns, end_ns);
    for (NamedPath& named : chain.named) {
      const std::optional<std::int64_t>& budget = definitions_[named.definition].budget_ns;
      if (budget && response > *budget) {
        ++named.over_budget;
      }
    }
    chain.last_callback.add(end_ns - trail.callback_ns);
    if (chain.response.count() == 1 || response > chain.longest_end_ns - chain.longest_begin_ns) {
      chain.longest_begin_ns = trail.input_ns;
      chain.longest_end_ns = end_ns;
    }
    if (chain.last_input_ns != 0) {
      chain.reaction.add(end_ns - chain.last_input_ns);
      chain.age.add(chain.last_output_ns - chain.last_input_ns);
    }
    chain.last_input_ns = trail.input_ns;
  }
  chain.last_output_ns = end_ns;
}

void ChainTracker::on_callback(const CallbackInstance& instance) {
  std::vector<Active>& running = active_[instance.thread];
  const auto innermost = std::find_if(running.rbegin(), running.rend(),
                                      [&](const Active& active) { return active.callback == instance.callback; });
  if (innermost == running.rend()) {
    return;
  }
  if (instance.finished) {
    for (const Trail& trail : innermost->trails) {
      end(trail, instance.end_ns);
    }
  }
  running.erase(std::next(innermost).base());
}

void ChainTracker::finish() {
  for (ChainRecord& chain : paths_) {
    if (chain.last_input_ns != 0) {
      chain.age.add(chain.last_output_ns - chain.last_input_ns);
    }
    chain.last_input_ns = 0;
  }
}

}  // namespace tracing
