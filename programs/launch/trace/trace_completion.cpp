// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <set>
#include <sstream>

#include "programs/launch/trace/trace_command.hpp"
#include "programs/launch/trace/trace_options.hpp"
#include "tracing/record/checks/kernel_checks.hpp"
#include "tracing/record/lttng/lttng_ctl.hpp"
#include "tracing/record/plan/context_fields.hpp"
#include "tracing/record/plan/trace_config.hpp"
#include "tracing/record/plan/trace_error.hpp"
#include "tracing/record/session/session_details.hpp"
#include "tracing/record/session/session_listing.hpp"
#include "tracing/record/session/traceable_events.hpp"

namespace tracing {
namespace {

using Words = std::vector<std::string>;

std::string help_of(const Words& arguments) {
  const auto parsed = parse_trace_options(arguments);
  const auto* const message = std::get_if<ParserMessage>(&parsed);
  return message != nullptr && message->exit_code == 0 ? message->text : "";
}

// The first words of the lines below a heading of a help text: "-p,--path DIR   …" gives "-p,--path".
Words entries(const std::string& help, const std::string& heading) {
  Words found;
  bool inside = false;
  std::istringstream lines(help);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(' ')) {
      inside = line == heading;
    } else if (inside && line.size() > 2 && line[2] != ' ') {
      found.push_back(line.substr(2, line.find(' ', 2) - 2));
    }
  }
  return found;
}

Words verbs() {
  return entries(help_of({"--help"}), "Subcommands:");
}

Words options(const Words& verb) {
  Words arguments = verb;
  arguments.emplace_back("--help");
  Words names;
  for (const std::string& entry : entries(help_of(arguments), "Options:")) {
    std::istringstream parts(entry);
    for (std::string name; std::getline(parts, name, ',');) {
      if (name.starts_with("--")) {
        names.push_back(name);
      }
    }
  }
  return names;
}

bool daemon_answers() {
  return lttng_session_daemon_alive() == 1;
}

Words userspace_events() {
  Words names = default_ros_events();
  if (!daemon_answers()) {
    return names;
  }
  for (const TraceableEvent& event : list_traceable_events().userspace) {
    names.push_back(event.name);
  }
  return names;
}

Words context_fields() {
  Words names = context_field_names(LTTNG_DOMAIN_UST);
  for (std::string& name : context_field_names(LTTNG_DOMAIN_KERNEL)) {
    names.push_back(std::move(name));
  }
  return names;
}

// Of an option that takes names, any number of them.
Words names_for(const std::string& option) {
  if (option == "-u" || option == "--ust") {
    return userspace_events();
  }
  if (option == "-c" || option == "--context") {
    return context_fields();
  }
  if (option == "-k" || option == "--kernel") {
    return daemon_answers() ? kernel_event_names() : Words{};
  }
  if (option == "--syscall") {
    return daemon_answers() ? syscall_names() : Words{};
  }
  return {};
}

Words session_names() {
  Words names;
  for (const SessionSummary& session : list_sessions()) {
    names.push_back(session.name);
  }
  return names;
}

Words candidates(const Words& words) {
  const Words all = verbs();
  const bool has_verb = words.size() > 1 && std::find(all.begin(), all.end(), words.front()) != all.end();
  const Words verb = has_verb ? Words{words.front()} : Words{};
  if (words.back().starts_with('-')) {
    return options(verb);
  }
  const auto option =
      std::find_if(words.rbegin() + 1, words.rend(), [](const std::string& word) { return word.starts_with('-'); });
  if (option != words.rend()) {
    if (Words names = names_for(*option); !names.empty()) {
      return names;
    }
  }
  if (words.size() == 1) {
    return all;
  }
  return has_verb && acts_on_session(words.front()) ? session_names() : Words{};
}

}  // namespace

std::vector<std::string> trace_completions(const std::vector<std::string>& words) {
  if (words.empty()) {
    return {};
  }
  try {
    const Words found = candidates(words);
    const std::set<std::string> unique(found.begin(), found.end());
    return {unique.begin(), unique.end()};
  } catch (const TraceError&) {
    return {};  // there is nothing of the kind, as without a kernel tracer
  }
}

}  // namespace tracing
