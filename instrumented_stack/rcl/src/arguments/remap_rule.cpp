// SPDX-License-Identifier: Apache-2.0
#include <cctype>
#include <stdexcept>

#include "arguments/arguments_impl.hpp"
#include "names/names.hpp"

namespace rcl {
namespace {

constexpr std::string_view kArrow = ":=";
constexpr std::string_view kTopicScheme = "rostopic://";
constexpr std::string_view kServiceScheme = "rosservice://";

bool is_token(std::string_view text) {
  if (text.empty() || std::isdigit(static_cast<unsigned char>(text.front())) != 0) {
    return false;
  }
  for (const char c : text) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_') {
      return false;
    }
  }
  return true;
}

// A name is a list of tokens separated by single slashes, optionally after `/` or `~/`.
void check_name(std::string_view side, std::string_view name) {
  const std::string quoted = "'" + std::string(name) + "'";
  if (name.empty()) {
    wrong("nothing stands " + std::string(side) + " ':='");
  }
  if (name.find('*') != std::string_view::npos) {
    wrong("wildcards are not supported, but " + quoted + " has one");
  }
  if (name.find('\\') != std::string_view::npos) {
    wrong("back references are not supported, but " + quoted + " has one");
  }
  std::string_view rest = name;
  if (rest.starts_with("~/")) {
    rest.remove_prefix(2);
  } else if (rest.starts_with('/')) {
    rest.remove_prefix(1);
  } else if (rest == "~") {
    return;
  }
  while (true) {
    const size_t slash = rest.find('/');
    if (!is_token(rest.substr(0, slash))) {
      wrong(quoted + " is no valid name");
    }
    if (slash == std::string_view::npos) {
      return;
    }
    rest.remove_prefix(slash + 1);
  }
}

bool remove_prefix(std::string_view& text, std::string_view prefix) {
  if (!text.starts_with(prefix)) {
    return false;
  }
  text.remove_prefix(prefix.size());
  return true;
}

bool applies_to(const RemapRule& rule, std::string_view node_name) {
  return rule.node.empty() || rule.node == node_name;
}

}  // namespace

RemapRule parse_remap_rule(std::string_view text) {
  const size_t arrow = text.find(kArrow);
  if (arrow == std::string_view::npos) {
    wrong("expected FROM:=TO");
  }
  std::string_view from = text.substr(0, arrow);
  const std::string_view to = text.substr(arrow + kArrow.size());

  RemapRule rule{RemapRule::Kind::kName, {}, {}, std::string(to)};
  const auto scheme = [&] {
    if (remove_prefix(from, kTopicScheme)) {
      rule.kind = RemapRule::Kind::kTopic;
    } else if (remove_prefix(from, kServiceScheme)) {
      rule.kind = RemapRule::Kind::kService;
    }
  };
  scheme();
  if (const size_t colon = from.find(':'); rule.kind == RemapRule::Kind::kName && colon != std::string_view::npos) {
    if (!is_token(from.substr(0, colon))) {
      wrong("'" + std::string(from.substr(0, colon)) + "' is no valid node name");
    }
    rule.node = from.substr(0, colon);
    from.remove_prefix(colon + 1);
    scheme();
  }
  if (from == "__node" || from == "__name") {
    rule.kind = RemapRule::Kind::kNodeName;
    if (!is_token(to)) {
      wrong("'" + std::string(to) + "' is no valid node name");
    }
    return rule;
  }
  if (from == "__ns") {
    rule.kind = RemapRule::Kind::kNamespace;
    if (!to.starts_with('/')) {
      wrong("namespace '" + std::string(to) + "' must begin with a '/'");
    }
    if (to != "/") {
      check_name("after", to);
    }
    return rule;
  }
  rule.from = from;
  check_name("before", from);
  std::string_view target = to;
  if (rule.kind == RemapRule::Kind::kTopic) {
    remove_prefix(target, kTopicScheme);
  } else if (rule.kind == RemapRule::Kind::kService) {
    remove_prefix(target, kServiceScheme);
  }
  rule.to = target;
  check_name("after", target);
  return rule;
}

std::optional<std::string> remapped_name(const std::vector<RemapRule>& rules, RemapRule::Kind kind,
                                         std::string_view name, std::string_view node_name,
                                         std::string_view node_namespace) {
  for (const RemapRule& rule : rules) {
    if ((rule.kind == kind || rule.kind == RemapRule::Kind::kName) && applies_to(rule, node_name) &&
        expand_topic_name(rule.from, node_name, node_namespace) == name) {
      return expand_topic_name(rule.to, node_name, node_namespace);
    }
  }
  return std::nullopt;
}

std::optional<std::string> remapped_node(const std::vector<RemapRule>& rules, RemapRule::Kind kind,
                                         std::string_view node_name) {
  for (const RemapRule& rule : rules) {
    if (rule.kind == kind && applies_to(rule, node_name)) {
      return rule.to;
    }
  }
  return std::nullopt;
}

}  // namespace rcl
