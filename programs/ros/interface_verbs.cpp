// SPDX-License-Identifier: Apache-2.0
// launch interface: what is installed. These commands use no middleware.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <set>

#include "base/diagnostics/read_source_file.hpp"
#include "launcher/message_types/print_value.hpp"
#include "programs/ros/verb.hpp"

namespace launch {

namespace {

struct Kinds {
  bool messages = false, services = false, actions = false;

  void declare(CLI::App& app) {
    app.add_flag("-m,--only-msgs", messages, "only messages");
    app.add_flag("-s,--only-srvs", services, "only services");
    app.add_flag("-a,--only-actions", actions, "only actions");
  }
  bool wants(const std::string& kind) const {
    const bool all = !messages && !services && !actions;
    return all || (kind == "msg" && messages) || (kind == "srv" && services) || (kind == "action" && actions);
  }
};

constexpr const char* kKinds[] = {"msg", "srv", "action"};

std::vector<std::string> all_interfaces() {
  std::vector<std::string> all;
  for (const std::string kind : kKinds) {
    const std::vector<std::string> names = installed_interfaces().names(kind);
    all.insert(all.end(), names.begin(), names.end());
  }
  return all;
}

class InterfaceList final : public Verb {
 public:
  void declare(CLI::App& app) override { kinds_.declare(app); }

  int run() override {
    const char* const titles[] = {"Messages:", "Services:", "Actions:"};
    for (std::size_t i = 0; i < 3; ++i) {
      if (kinds_.wants(kKinds[i])) {
        put(fmt::format("{}\n", titles[i]));
        for (const std::string& name : installed_interfaces().names(kKinds[i])) {
          put("    " + name + "\n");
        }
      }
    }
    return 0;
  }

 private:
  Kinds kinds_;
};

class InterfacePackage final : public Verb {
 public:
  void declare(CLI::App& app) override {
    app.add_option("package", package_, "name of the package")->required();
    kinds_.declare(app);
  }

  int run() override {
    std::vector<std::string> found;
    for (const std::string kind : kKinds) {
      const std::vector<std::string> names = installed_interfaces().names_of_package(package_, kind);
      if (kinds_.wants(kind)) {
        found.insert(found.end(), names.begin(), names.end());
      }
    }
    if (found.empty()) {
      (void)installed_interfaces().file_of(package_ + "/msg/Any");  // throws if there is no such package
    }
    for (const std::string& name : found) {
      put(name + "\n");
    }
    return 0;
  }

 private:
  std::string package_;
  Kinds kinds_;
};

class InterfacePackages final : public Verb {
 public:
  void declare(CLI::App& app) override { kinds_.declare(app); }

  int run() override {
    std::set<std::string> packages;
    for (const std::string kind : kKinds) {
      if (kinds_.wants(kind)) {
        for (const std::string& name : installed_interfaces().names(kind)) {
          packages.insert(name.substr(0, name.find('/')));
        }
      }
    }
    for (const std::string& package : packages) {
      put(package + "\n");
    }
    return 0;
  }

 private:
  Kinds kinds_;
};

class InterfaceShow final : public Verb {
 public:
  void declare(CLI::App& app) override {
    app.add_option("type", type_, "name of the interface, such as std_msgs/msg/String")->required();
    app.add_flag("--all-comments", all_comments_, "also print the comments of the interfaces within");
    app.add_flag("--no-comments", no_comments_, "print no comments and empty lines");
  }

  int run() override {
    print(type_, 0);
    return 0;
  }

  std::vector<std::string> complete(const std::vector<std::string>& words) override {
    return words.empty() ? all_interfaces() : std::vector<std::string>();
  }

 private:
  void print(const std::string& type, std::size_t depth) {
    const std::string full =
        std::count(type.begin(), type.end(), '/') == 1 ? std::string(type).insert(type.find('/'), "/msg") : type;
    const auto file = read_source_file(installed_interfaces().file_of(full));
    const std::string package = full.substr(0, full.find('/'));
    const bool comments = !no_comments_ && (depth == 0 || all_comments_);
    std::string_view text = file->text();
    if (file->path().ends_with(".idl")) {
      put(file->text());
      return;
    }
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      print_line(std::string(text.substr(0, end)), package, depth, comments);
      text.remove_prefix(std::min(end + 1, text.size()));
    }
  }

  void print_line(std::string line, const std::string& package, std::size_t depth, bool comments) {
    const std::string bare = line.substr(0, line.find('#'));
    const bool has_code = bare.find_first_not_of(" \t\r") != std::string::npos;
    if (!comments) {
      line = has_code ? bare.substr(0, bare.find_last_not_of(" \t\r") + 1) : "";
      if (line.empty()) {
        return;
      }
    }
    put(std::string(depth, '\t') + line + "\n");
    std::string word = bare.substr(0, bare.find_first_of(" \t"));
    word = word.substr(0, word.find_first_of("[<"));
    if (!has_code || word.empty() || word == "---" || primitive_kind(word)) {
      return;
    }
    print(word.find('/') == std::string::npos ? fmt::format("{}/msg/{}", package, word) : word, depth + 1);
  }

  std::string type_;
  bool all_comments_ = false;
  bool no_comments_ = false;
};

class InterfaceProto final : public Verb {
 public:
  void declare(CLI::App& app) override {
    app.add_option("type", type_, "name of the interface")->required();
    app.add_flag("--no-quotes", no_quotes_, "without the quotes for the shell around it");
  }

  int run() override {
    std::string name = type_;
    if (name.find("/srv/") != std::string::npos && name.find('_', name.rfind('/')) == std::string::npos) {
      name += "_Request";
    } else if (name.find("/action/") != std::string::npos && name.find('_', name.rfind('/')) == std::string::npos) {
      name += "_Goal";
    }
    const auto message = installed_interfaces().message(name);
    const char* const quote = no_quotes_ ? "" : "\"";
    put(fmt::format("{}{}{}\n", quote, to_yaml({FieldKind::kMessage, message}, default_value(*message)), quote));
    return 0;
  }

  std::vector<std::string> complete(const std::vector<std::string>& words) override {
    return words.empty() ? all_interfaces() : std::vector<std::string>();
  }

 private:
  std::string type_;
  bool no_quotes_ = false;
};

}  // namespace

std::vector<VerbInfo> interface_verbs() {
  return {{"interface", "list", "lists the installed interfaces", make_verb<InterfaceList>},
          {"interface", "package", "lists the interfaces of a package", make_verb<InterfacePackage>},
          {"interface", "packages", "lists the packages that have interfaces", make_verb<InterfacePackages>},
          {"interface", "proto", "prints a message with its defaults, to be edited", make_verb<InterfaceProto>},
          {"interface", "show", "prints the definition of an interface", make_verb<InterfaceShow>}};
}

}  // namespace launch
