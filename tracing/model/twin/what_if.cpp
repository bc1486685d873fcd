// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/twin/what_if.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <string_view>

#include "base/diagnostics/diagnostic.hpp"
#include "base/diagnostics/source.hpp"

namespace tracing::twin {

namespace {

bool matches(std::string_view pattern, std::string_view name) {
  if (pattern.empty()) {
    return name.empty();
  }
  if (pattern.front() == '*') {
    return matches(pattern.substr(1), name) || (!name.empty() && matches(pattern, name.substr(1)));
  }
  return !name.empty() && pattern.front() == name.front() && matches(pattern.substr(1), name.substr(1));
}

// A part of the text, with its place.
struct Word {
  std::string text;
  std::size_t begin = 0;
};

constexpr const char* kSubjects[] = {"executor", "groups", "cpus", "priority", "rate", "duration"};

class Changes {
 public:
  Changes(const std::string& text, System& system)
      : text_(text), source_(std::make_shared<launch::SourceFile>("--what-if", text)), system_(system) {}

  void apply() {
    do {
      apply_one();
    } while (take(','));
    if (at_ < text_.size()) {
      fail(rest(), "expected ',' or the end", "several changes are separated by commas");
    }
  }

 private:
  [[noreturn]] void fail(const Word& word, const std::string& message, const std::string& help) const {
    const auto begin = static_cast<std::uint32_t>(std::min(word.begin, text_.size()));
    const auto end = static_cast<std::uint32_t>(std::min(word.begin + word.text.size(), text_.size()));
    throw launch::LaunchError(message, {source_, begin, std::max(begin, end)}, help);
  }
  template <std::size_t N>
  [[noreturn]] void fail_word(const Word& word, const std::string& what, const char* const (&words)[N]) const {
    const std::vector<std::string> known(std::begin(words), std::end(words));
    std::string help = launch::did_you_mean(word.text, known);
    if (help.empty()) {
      for (const std::string& one : known) {
        help += (help.empty() ? "write one of " : ", ") + one;
      }
    }
    fail(word, word.text.empty() ? what + " is missing" : "'" + word.text + "' is no " + what, help);
  }

  Word rest() const { return {text_.substr(std::min(at_, text_.size())), at_}; }
  bool take(char sign) {
    if (at_ < text_.size() && text_[at_] == sign) {
      ++at_;
      return true;
    }
    return false;
  }
  void need(char sign, const std::string& example) {
    if (!take(sign)) {
      fail({rest().text.substr(0, 1), at_}, std::string("expected '") + sign + "'", "write " + example);
    }
  }
  // Up to one of the signs or the end.
  Word word(std::string_view signs) {
    while (take(' ')) {
    }
    Word word{{}, at_};
    while (at_ < text_.size() && signs.find(text_[at_]) == std::string_view::npos) {
      word.text += text_[at_++];
    }
    while (word.text.ends_with(' ')) {
      word.text.pop_back();
    }
    return word;
  }

  // A number, and the unit behind it if it is one of these.
  double number(const Word& word, const std::string& what, std::initializer_list<std::pair<const char*, double>> units,
                const std::string& example) const {
    double value = 0;
    const char* const end = word.text.data() + word.text.size();
    const auto [behind, error] = std::from_chars(word.text.data(), end, value);
    const std::string unit(behind, end);
    for (const auto& [name, factor] : units) {
      if (error == std::errc() && unit == name && value > 0 && std::isfinite(value)) {
        return value * factor;
      }
    }
    fail(word, word.text.empty() ? what + " is missing" : "'" + word.text + "' is no " + what, "write " + example);
  }

  std::vector<Index> nodes(const Word& word) const {
    std::vector<Index> found;
    std::vector<std::string> names;
    for (Index index = 0; index < system_.nodes.size(); ++index) {
      names.push_back(system_.nodes[index].name);
      if (matches(word.text, names.back())) {
        found.push_back(index);
      }
    }
    if (found.empty()) {
      std::string help = launch::did_you_mean(word.text, names);
      if (help.empty() && !word.text.starts_with('/')) {
        help = launch::did_you_mean("/" + word.text, names);
      }
      if (help.empty()) {
        for (const std::string& name : names) {
          help += (help.empty() ? "the twin has " : ", ") + name;
        }
      }
      fail(word, word.text.empty() ? "the name of a node is missing" : "the twin has no node '" + word.text + "'",
           help);
    }
    return found;
  }

  void for_callbacks(const std::vector<Index>& nodes, const std::function<void(Callback&)>& change) {
    for (Callback& callback : system_.callbacks) {
      if (std::find(nodes.begin(), nodes.end(), system_.groups[callback.group].node) != nodes.end()) {
        change(callback);
      }
    }
  }
  void for_executors(const std::vector<Index>& nodes, const std::function<void(Executor&)>& change) {
    for (const Group& group : system_.groups) {
      if (std::find(nodes.begin(), nodes.end(), group.node) != nodes.end()) {
        change(system_.executors[group.executor]);
      }
    }
  }

  void apply_one() {
    const Word subject = word("=(,");
    if (std::find(std::begin(kSubjects), std::end(kSubjects), subject.text) == std::end(kSubjects)) {
      fail_word(subject, "change", kSubjects);
    }
    if (subject.text == "executor") {
      change_executor();
    } else if (subject.text == "groups") {
      change_groups();
    } else if (subject.text == "cpus") {
      need('=', "cpus=4");
      system_.cpus = whole(word(","), "number of processors", 1, 1024, "a whole number, such as cpus=4");
    } else if (subject.text == "priority") {
      change_priority();
    } else if (subject.text == "rate") {
      change_rate();
    } else {
      change_duration();
    }
  }

  std::size_t whole(const Word& word, const std::string& what, std::size_t least, std::size_t most,
                    const std::string& example) const {
    const double value = number(word, what, {{"", 1}}, example);
    if (value != std::floor(value) || value < static_cast<double>(least) || value > static_cast<double>(most)) {
      fail(word, "'" + word.text + "' is no " + what,
           "write a whole number from " + std::to_string(least) + " to " + std::to_string(most));
    }
    return static_cast<std::size_t>(value);
  }

  void change_executor() {
    const std::string example = "executor=/node:multi:4";
    need('=', example);
    const std::vector<Index> changed = nodes(word(":,"));
    need(':', example);
    const Word kind_word = word(":,");
    const auto* const kind = std::find_if(std::begin(kExecutorKinds), std::end(kExecutorKinds),
                                          [&](const char* known) { return kind_word.text == known; });
    if (kind == std::end(kExecutorKinds)) {
      fail_word(kind_word, "kind of executor", kExecutorKinds);
    }
    const auto chosen = static_cast<Executor::Kind>(kind - std::begin(kExecutorKinds));
    std::size_t threads = chosen == Executor::Kind::kMulti ? std::max<std::size_t>(2, system_.cpus) : 1;
    const std::size_t colon = at_;
    if (take(':')) {
      const Word count = word(",");
      if (chosen != Executor::Kind::kMulti) {
        fail({":" + count.text, colon}, "an executor of the kind '" + kind_word.text + "' has one thread",
             "leave the number out");
      }
      threads = whole(count, "number of threads", 1, 1024, "a whole number, such as " + example);
    }
    for_executors(changed, [&](Executor& executor) {
      executor.kind = chosen;
      executor.threads = threads;
    });
  }

  void change_groups() {
    constexpr const char* kWays[] = {"one", "separate", "reentrant"};
    need('=', "groups=/node:separate");
    const std::vector<Index> changed = nodes(word(":,"));
    need(':', "groups=/node:separate");
    const Word way = word(",");
    if (std::find(std::begin(kWays), std::end(kWays), way.text) == std::end(kWays)) {
      fail_word(way, "way to group callbacks", kWays);
    }
    for (const Index node : changed) {
      Index first = kNone;
      for (Callback& callback : system_.callbacks) {
        if (system_.groups[callback.group].node != node) {
          continue;
        }
        Group group = system_.groups[callback.group];
        group.reentrant = way.text == "reentrant";
        if (first == kNone || way.text == "separate") {
          first = system_.groups.size();
          system_.groups.push_back(group);
        }
        callback.group = first;
      }
    }
  }

  void change_priority() {
    const std::string example = "priority=/node:50";
    need('=', example);
    const std::vector<Index> changed = nodes(word(":,"));
    need(':', example);
    const Word value = word(",");
    const int priority =
        value.text == "other" ? 0 : static_cast<int>(whole(value, "priority", 1, 99, "1 to 99, or other: " + example));
    for_executors(changed, [&](Executor& executor) { executor.priority = priority; });
  }

  // "(/node)*2" or "=/node:VALUE": the nodes, and a factor or a value.
  struct Amount {
    std::vector<Index> nodes;
    std::optional<double> factor;
    double value = 0;
  };
  Amount amount(const std::string& what, std::initializer_list<std::pair<const char*, double>> units,
                const std::string& value_example) {
    Amount amount;
    if (take('(')) {
      amount.nodes = nodes(word("),"));
      need(')', what + "(/node)*0.5");
      need('*', what + "(/node)*0.5");
      amount.factor = number(word(","), "factor", {{"", 1}}, "a number above 0, such as " + what + "(/node)*0.5");
      return amount;
    }
    need('=', what + "(/node)*0.5 or " + value_example);
    amount.nodes = nodes(word(":,"));
    need(':', value_example);
    amount.value = number(word(","), what, units, value_example);
    return amount;
  }

  void change_rate() {
    const Amount rate = amount("rate", {{"Hz", 1}, {"hz", 1}, {"", 1}, {"kHz", 1000}}, "rate=/node:20Hz");
    bool has_timer = false;
    for_callbacks(rate.nodes, [&](Callback& callback) {
      if (callback.kind == Callback::Kind::kTimer) {
        has_timer = true;
        const double period = rate.factor ? static_cast<double>(callback.period_ns) / *rate.factor : 1e9 / rate.value;
        callback.period_ns = std::max<std::int64_t>(1, std::llround(period));
      }
    });
    if (!has_timer) {
      fail({text_.substr(0, at_), 0}, "the node has no timer, so it has no rate of its own",
           "change the rate of the node that sends to it");
    }
  }

  void change_duration() {
    const Amount duration = amount("duration", {{"ms", 1e6}, {"us", 1e3}, {"ns", 1}, {"s", 1e9}}, "duration=/node:5ms");
    for_callbacks(duration.nodes, [&](Callback& callback) {
      for (Distribution* times : {&callback.run_times, &callback.silent_run_times}) {
        for (std::int64_t& time : times->values) {
          time = duration.factor ? std::llround(static_cast<double>(time) * *duration.factor)
                                 : std::llround(duration.value);
        }
      }
    });
  }

  const std::string& text_;
  std::shared_ptr<const launch::SourceFile> source_;
  System& system_;
  std::size_t at_ = 0;
};

}  // namespace

void apply_what_if(const std::string& text, System& system) {
  Changes(text, system).apply();
}

}  // namespace tracing::twin
