// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/reload/known_components.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace launch {
namespace {

bool is_same(const TransitionRequest& one, const TransitionRequest& other) {
  return one.node == other.node && one.transitions == other.transitions && one.autostart == other.autostart;
}

bool has(const std::vector<TransitionRequest>& all, const TransitionRequest& one) {
  return std::any_of(all.begin(), all.end(), [&](const TransitionRequest& each) { return is_same(each, one); });
}

// The one of the same identity, or the end.
template <typename Components, typename Component>
auto find(Components& all, const Component& one) {
  return std::find_if(all.begin(), all.end(), [&](const auto& each) {
    return each.container == one.container && each.identity == one.identity;
  });
}

template <typename Component>
ReloadReport::Line line_of(const Component& component, const SourceRange& where) {
  const std::string& name = component.node.name.empty() ? component.node.plugin : component.node.name;
  return {fmt::format("{} in {}", name, component.container), {}, where};
}

}  // namespace

std::vector<KnownComponents::Component> KnownComponents::components_of(const Requests& requests) {
  std::vector<Component> all;
  for (const LoadRequest& load : requests.loads) {
    for (const ComposableNode& node : load.nodes) {
      const std::string container = load.target.starts_with('/') ? load.target : "/" + load.target;
      all.push_back({container, identity_of(node), text_of(node), node, load.environment, load.origin});
    }
  }
  return all;
}

void KnownComponents::note(const Requests& requests) {
  std::vector<Component> more = components_of(requests);
  std::move(more.begin(), more.end(), std::back_inserter(components_));
  transitions_.insert(transitions_.end(), requests.transitions.begin(), requests.transitions.end());
}

void KnownComponents::compare(const Requests& requests, ReloadReport& report) const {
  const std::vector<Component> now = components_of(requests);
  for (const Component& component : now) {
    const auto known = find(components_, component);
    if (known == components_.end()) {
      report.starts.push_back(line_of(component, component.node.origin));
    } else if (known->text != component.text) {
      ReloadReport::Line line = line_of(component, component.node.origin);
      line.changes = {"the component is loaded again"};
      report.restarts.push_back(std::move(line));
    }
  }
  for (const Component& component : components_) {
    if (find(now, component) == now.end()) {
      report.ends.push_back(line_of(component, {}));
    }
  }
  for (const TransitionRequest& transition : requests.transitions) {
    if (!has(transitions_, transition)) {
      report.notes.push_back(
          fmt::format("'{}' gets the transitions: {}", transition.node, fmt::join(transition.transitions, ", ")));
    }
  }
}

void KnownComponents::take_over(Requests& requests,
                                const std::function<bool(const std::string& container)>& loads_anew) {
  const std::vector<Component> now = components_of(requests);
  for (const Component& component : components_) {
    if (find(now, component) == now.end()) {
      tasks_.forget(component.container, component.node, component.environment, !loads_anew(component.container),
                    [] {});
    }
  }
  for (const Component& component : now) {
    const auto known = find(components_, component);
    const auto load =
        [this, request = LoadRequest{component.container, {component.node}, component.environment, component.origin}] {
          tasks_.start(std::vector<LoadRequest>{request}, std::vector<TransitionRequest>{});
        };
    if (known == components_.end()) {
      load();
    } else if (known->text != component.text) {
      tasks_.forget(component.container, known->node, known->environment, !loads_anew(component.container), load);
    }
  }
  for (const TransitionRequest& transition : transitions_) {
    if (!has(requests.transitions, transition)) {
      tasks_.forget(transition);
    }
  }
  for (const TransitionRequest& transition : requests.transitions) {
    if (!has(transitions_, transition)) {
      tasks_.start(std::vector<LoadRequest>{}, std::vector<TransitionRequest>{transition});
    }
  }
  components_ = now;
  transitions_ = std::exchange(requests.transitions, {});
  requests.loads.clear();
}

}  // namespace launch
