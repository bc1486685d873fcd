// SPDX-License-Identifier: Apache-2.0
// launch topic, service and action: list, type, find
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "programs/ros/graph_names.hpp"
#include "programs/ros/topic_graph.hpp"

namespace launch {

namespace {

void declare_count(CLI::App& app, const NamesOfGraph& names, bool& count) {
  app.add_flag(fmt::format("-c,--count-{}s", names.kind), count, "print only how many there are");
}

void declare_hidden(CLI::App& app, const NamesOfGraph& names, bool& hidden) {
  app.add_flag(fmt::format("--include-hidden-{}s", names.kind), hidden,
               fmt::format("also {}s whose name begins with '_'", names.kind));
}

class NameList final : public Verb {
 public:
  explicit NameList(const NamesOfGraph& names) : names_(names), hidden_(&names == &kActions) {}

  void declare(CLI::App& app) override {
    look_.declare(app);
    app.add_flag("-t,--show-types", show_types_, "also print the types");
    declare_count(app, names_, count_);
    if (&names_ != &kActions) {
      declare_hidden(app, names_, hidden_);
    }
    if (&names_ == &kTopics) {
      app.add_flag("-v,--verbose", verbose_, "print publishers and subscribers of each topic");
    }
  }

  int run() override {
    GraphSession session;
    session.discover(look_.time());
    NamesAndTypes names = names_.look(session);
    std::erase_if(names, [this](const auto& name) { return !hidden_ && is_hidden(name.first); });
    if (!count_ && verbose_ && !names.empty()) {
      put(section(session, names, true) + "\n" + section(session, names, false) + "\n");
      return 0;
    }
    put_names(names, show_types_, count_);
    return 0;
  }

 private:
  static std::string section(GraphSession& session, const NamesAndTypes& topics, bool publishers) {
    std::string text = publishers ? "Published topics:\n" : "Subscribed topics:\n";
    for (const auto& [name, types] : topics) {
      const std::size_t count =
          publishers ? session.node().count_publishers(name) : session.node().count_subscribers(name);
      if (count != 0) {
        text += fmt::format(" * {} [{}] {} {}{}\n", name, fmt::join(types, ", "), count,
                            publishers ? "publisher" : "subscriber", count > 1 ? "s" : "");
      }
    }
    return text;
  }

  const NamesOfGraph& names_;
  LookOptions look_;
  bool show_types_ = false;
  bool count_ = false;
  bool hidden_;
  bool verbose_ = false;
};

class TypeOfName final : public Verb {
 public:
  explicit TypeOfName(const NamesOfGraph& names) : names_(names) {}

  void declare(CLI::App& app) override {
    app.add_option(names_.kind, name_, fmt::format("name of the {}", names_.kind))->required();
    look_.declare(app);
  }

  int run() override {
    const std::string name = full_name(name_);
    GraphSession session;
    session.discover(look_.time());
    put(fmt::format("{}\n", fmt::join(types_of(session, names_, name), "\n")));
    return 0;
  }

  std::vector<std::string> complete(const std::vector<std::string>& words) override {
    return words.empty() ? all_names(names_) : std::vector<std::string>();
  }

 private:
  const NamesOfGraph& names_;
  std::string name_;
  LookOptions look_;
};

class NamesOfType final : public Verb {
 public:
  explicit NamesOfType(const NamesOfGraph& names) : names_(names), hidden_(&names == &kActions) {}

  void declare(CLI::App& app) override {
    app.add_option("type", type_, fmt::format("type of the {}s, such as {}", names_.kind, names_.example))->required();
    look_.declare(app);
    declare_count(app, names_, count_);
    if (&names_ != &kActions) {
      declare_hidden(app, names_, hidden_);
    }
  }

  int run() override {
    if (std::count(type_.begin(), type_.end(), '/') == 1) {
      type_.insert(type_.find('/'), fmt::format("/{}", names_.folder));
    }
    GraphSession session;
    session.discover(look_.time());
    NamesAndTypes found = names_.look(session);
    std::erase_if(found, [this](const auto& name) {
      return (!hidden_ && is_hidden(name.first)) ||
             std::find(name.second.begin(), name.second.end(), type_) == name.second.end();
    });
    put_names(found, false, count_);
    return 0;
  }

  std::vector<std::string> complete(const std::vector<std::string>& words) override {
    return words.empty() ? installed_interfaces().names(names_.folder) : std::vector<std::string>();
  }

 private:
  const NamesOfGraph& names_;
  std::string type_;
  LookOptions look_;
  bool count_ = false;
  bool hidden_;
};

}  // namespace

std::vector<VerbInfo> graph_name_verbs() {
  return {{"topic", "find", "lists the topics of a type", [] { return make_verb<NamesOfType>(kTopics); }},
          {"topic", "list", "lists the topics", [] { return make_verb<NameList>(kTopics); }},
          {"topic", "type", "prints the type of a topic", [] { return make_verb<TypeOfName>(kTopics); }},
          {"service", "find", "lists the services of a type", [] { return make_verb<NamesOfType>(kServices); }},
          {"service", "list", "lists the services", [] { return make_verb<NameList>(kServices); }},
          {"service", "type", "prints the type of a service", [] { return make_verb<TypeOfName>(kServices); }},
          {"action", "find", "lists the actions of a type", [] { return make_verb<NamesOfType>(kActions); }},
          {"action", "list", "lists the actions", [] { return make_verb<NameList>(kActions); }},
          {"action", "type", "prints the type of an action", [] { return make_verb<TypeOfName>(kActions); }}};
}

}  // namespace launch
