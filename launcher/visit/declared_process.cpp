// SPDX-License-Identifier: Apache-2.0
#include "launcher/visit/declared_process.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <concepts>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <string_view>
#include <type_traits>
#include <unordered_map>

#include "launcher/visit/dependency.hpp"

namespace launch {
namespace {

// FNV-1a of everything that is put into it, with the length of each text.
class Sum {
 public:
  Sum& add(std::string_view text) {
    add(text.size());
    for (const char byte : text) {
      mix(static_cast<unsigned char>(byte));
    }
    return *this;
  }
  template <typename Number>
    requires std::is_integral_v<Number> || std::is_enum_v<Number>
  Sum& add(Number number) {
    const auto value = static_cast<std::uint64_t>(number);
    for (unsigned shift = 0; shift < 64; shift += 8) {
      mix((value >> shift) & 0xff);
    }
    return *this;
  }
  Sum& add(Duration duration) { return add(duration.count()); }
  Sum& add(double number) { return add(std::string_view(fmt::format("{}", number))); }
  template <typename Item>
  Sum& add(const std::vector<Item>& items) {
    add(items.size());
    for (const Item& item : items) {
      add(item);
    }
    return *this;
  }
  template <typename Value>
  Sum& add(const std::optional<Value>& value) {
    return value ? add(true).add(*value) : add(false);
  }

  std::uint64_t value() const { return value_; }

 private:
  static constexpr std::uint64_t kBasis = 0xcbf29ce484222325;
  static constexpr std::uint64_t kPrime = 0x100000001b3;

  void mix(std::uint64_t byte) { value_ = (value_ ^ byte) * kPrime; }

  std::uint64_t value_ = kBasis;
};

// The contents of the parameter files that the command line names; a file is read once.
class FileContents {
 public:
  std::uint64_t of(const std::string& path) {
    const auto [known, is_new] = sums_.try_emplace(path, 0);
    if (is_new) {
      std::ifstream file(path, std::ios::binary);
      std::ostringstream content;
      content << file.rdbuf();
      known->second = Sum().add(std::string_view(content.view())).value();
    }
    return known->second;
  }

 private:
  std::unordered_map<std::string, std::uint64_t> sums_;
};

std::uint64_t policy_of(const ProcessSpec& spec) {
  Sum sum;
  sum.add(spec.respawn.enabled).add(spec.respawn.delay).add(spec.respawn.max_retries);
  sum.add(spec.respawn.backoff).add(spec.respawn.max_delay);
  sum.add(spec.start_limit.starts).add(spec.start_limit.within).add(spec.start_limit.cool_down);
  sum.add(spec.start_limit.shuts_down).add(spec.shutdown_on_exit).add(spec.required);
  sum.add(spec.allowed_exits.any).add(spec.allowed_exits.codes);
  return sum.add(spec.sigterm_timeout).add(spec.sigkill_timeout).value();
}

std::uint64_t limits_of(const ResourceLimits& limits) {
  Sum sum;
  sum.add(limits.niceness).add(limits.policy).add(limits.priority).add(limits.cpus);
  return sum.add(limits.memory).add(limits.open_files).value();
}

std::uint64_t watches_of(const ProcessSpec& spec) {
  Sum sum;
  for (const HealthWatch& watch : spec.watches) {
    sum.add(std::string_view(describe(watch))).add(watch.interval).add(watch.failures).add(watch.start_period);
    sum.add(watch.reaction).add(watch.signal);
  }
  return sum.value();
}

std::uint64_t streams_of(const ProcessSpec& spec) {
  Sum sum;
  for (const OutputTargets& targets : {spec.output.out, spec.output.err}) {
    sum.add(targets.screen).add(targets.log).add(targets.own_log);
  }
  return sum.add(spec.emulate_tty).add(spec.terminal_input).add(spec.tty).value();
}

std::uint64_t environment_of(const ProcessSpec& spec) {
  Sum sum;
  for (const auto& [name, value] : spec.environment) {
    sum.add(std::string_view(name)).add(std::string_view(value));
  }
  return sum.value();
}

// The command line without parameters that the launch file gives by name, and the files that it names.
void add_command(const ProcessSpec& spec, const NodeDescription* node, FileContents& files, DeclaredProcess& declared) {
  std::set<std::string> known;  // names
  for (const NamedParameter& parameter : declared.parameters) {
    known.insert(parameter.name);
  }
  std::set<std::size_t> of_values;  // words: --params-file and the file of values behind it
  if (node != nullptr) {
    for (const std::size_t file : node->value_files) {
      of_values.insert({spec.files.at(file).argument - 1, spec.files.at(file).argument});
    }
  }
  Sum words;
  Sum others;
  Sum contents;
  words.add(spec.shell);
  others.add(spec.shell);
  for (std::size_t i = 0; i < spec.argv.size(); ++i) {
    const std::string& word = spec.argv[i];
    words.add(std::string_view(word));
    if (i > 0 && spec.argv[i - 1] == "--params-file" && !word.empty()) {
      contents.add(files.of(word));
    }
    const auto gives_known = [&](std::size_t at) {
      return at < spec.argv.size() && known.contains(spec.argv[at].substr(0, spec.argv[at].find(":=")));
    };
    const bool is_parameter =
        (word == "-p" && gives_known(i + 1)) || (i > 0 && spec.argv[i - 1] == "-p" && gives_known(i));
    if (!is_parameter && !of_values.contains(i)) {
      others.add(std::string_view(word));
    }
  }
  for (std::size_t i = 0; i < spec.files.size(); ++i) {
    words.add(std::string_view(spec.files[i].content));
    const bool is_known =
        node != nullptr && std::find(node->value_files.begin(), node->value_files.end(), i) != node->value_files.end();
    if (!is_known) {
      contents.add(std::string_view(spec.files[i].content));
    }
  }
  declared.command_words = words.value();
  declared.groups[DeclaredProcess::kCommandLine] = others.value();
  declared.groups[DeclaredProcess::kParameterFiles] = contents.value();
}

// The last value of each name.
std::map<std::string, const ParameterValue*> values_of(const DeclaredProcess& process) {
  std::map<std::string, const ParameterValue*> values;
  for (const NamedParameter& parameter : process.parameters) {
    values.insert_or_assign(parameter.name, &parameter.value);
  }
  return values;
}

std::string line_of(const SourceRange& where) {
  return where ? fmt::format("{}:{}", where.file->path(), where.file->position(where.begin).line) : std::string();
}

}  // namespace

bool DeclaredProcess::starts_as(const DeclaredProcess& other) const {
  return command_words == other.command_words && groups == other.groups;
}

const char* name_of(DeclaredProcess::Group group) {
  static constexpr std::array<const char*, DeclaredProcess::kGroups> kNames = {
      "command line", "parameter file", "environment",     "working directory",   "standard input and output",
      "limits",       "watches",        "crash directory", "whether it is traced"};
  return kNames.at(group);
}

std::vector<DeclaredProcess> declared_processes(const Requests& requests) {
  std::vector<const NodeDescription*> nodes(requests.processes.size(), nullptr);
  for (const NodeDescription& node : requests.nodes) {
    nodes.at(node.process) = &node;
  }
  std::vector<Sum> dependencies(requests.processes.size());
  for (const Dependency& dependency : requests.dependencies) {
    dependencies.at(dependency.process)
        .add(std::string_view(describe(dependency)))
        .add(dependency.timeout)
        .add(dependency.on_failure);
  }
  FileContents files;
  std::vector<DeclaredProcess> all;
  all.reserve(requests.processes.size());
  for (std::size_t i = 0; i < requests.processes.size(); ++i) {
    const ProcessSpec& spec = requests.processes[i];
    DeclaredProcess& declared = all.emplace_back();
    for (const std::string& name : spec.other_names) {
      if (name.starts_with('/') && name != spec.python_action) {
        declared.node = name;
      }
    }
    declared.name = declared.node.empty() ? spec.name : spec.name + " " + declared.node;
    if (!spec.machine.empty()) {
      declared.name += " on " + spec.machine;  // a process does not move: on another machine it is another one
    }
    if (nodes[i] != nullptr) {
      declared.parameters = nodes[i]->parameters;
    }
    add_command(spec, nodes[i], files, declared);
    declared.groups[DeclaredProcess::kEnvironment] = environment_of(spec);
    declared.groups[DeclaredProcess::kDirectory] = Sum().add(std::string_view(spec.working_directory)).value();
    declared.groups[DeclaredProcess::kInputAndOutput] = streams_of(spec);
    declared.groups[DeclaredProcess::kLimits] = limits_of(spec.limits);
    declared.groups[DeclaredProcess::kWatches] = watches_of(spec);
    declared.groups[DeclaredProcess::kCrashDirectory] = Sum().add(std::string_view(spec.crash_directory)).value();
    declared.groups[DeclaredProcess::kTrace] = Sum().add(spec.traced).value();
    declared.policy = policy_of(spec);
    declared.dependencies = dependencies[i].value();
    declared.where = spec.origin;
  }
  return all;
}

std::vector<std::optional<std::size_t>> find_same(const std::vector<DeclaredProcess>& before,
                                                  const std::vector<DeclaredProcess>& now) {
  std::unordered_map<std::string_view, std::vector<std::size_t>> left;
  for (std::size_t i = 0; i < before.size(); ++i) {
    left[before[i].name].push_back(i);
  }
  std::vector<std::optional<std::size_t>> same(now.size());
  const auto pair = [&](const auto& belong_together) {
    for (std::size_t i = 0; i < now.size(); ++i) {
      if (same[i]) {
        continue;
      }
      std::vector<std::size_t>& candidates = left[now[i].name];
      const auto found = std::find_if(candidates.begin(), candidates.end(), [&](std::size_t candidate) {
        return belong_together(before[candidate], now[i]);
      });
      if (found != candidates.end()) {
        same[i] = *found;
        candidates.erase(found);
      }
    }
  };
  pair([](const DeclaredProcess& old, const DeclaredProcess& fresh) { return old.starts_as(fresh); });
  pair([](const DeclaredProcess& old, const DeclaredProcess& fresh) {
    return line_of(old.where) == line_of(fresh.where);
  });
  pair([](const DeclaredProcess&, const DeclaredProcess&) { return true; });
  return same;
}

std::optional<std::vector<NamedParameter>> changed_parameters(const DeclaredProcess& before,
                                                              const DeclaredProcess& now) {
  const auto old = values_of(before);
  const auto fresh = values_of(now);
  const bool forgets =
      std::any_of(old.begin(), old.end(), [&](const auto& entry) { return !fresh.contains(entry.first); });
  if (forgets) {
    return std::nullopt;
  }
  std::vector<NamedParameter> changed;
  for (const auto& [name, value] : fresh) {
    const auto known = old.find(name);
    if (known == old.end() || *known->second != *value) {
      changed.push_back({name, *value});
    }
  }
  return changed;
}

std::vector<std::string> parameter_changes(const DeclaredProcess& before, const DeclaredProcess& now) {
  const auto old = values_of(before);
  const auto fresh = values_of(now);
  std::vector<std::string> changes;
  for (const auto& [name, value] : old) {
    const auto found = fresh.find(name);
    if (found == fresh.end()) {
      changes.push_back(fmt::format("parameter {}: gone", name));
    } else if (*value != *found->second) {
      changes.push_back(
          fmt::format("parameter {}: {} -> {}", name, to_python_text(*value), to_python_text(*found->second)));
    }
  }
  for (const auto& [name, value] : fresh) {
    if (!old.contains(name)) {
      changes.push_back(fmt::format("parameter {}: new, {}", name, to_python_text(*value)));
    }
  }
  return changes;
}

}  // namespace launch
