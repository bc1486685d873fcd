// SPDX-License-Identifier: Apache-2.0
// What an editor can do about a finding: take what was meant, take out what is useless, write what is missing, or leave
// the finding out with a comment.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <string>
#include <vector>

#include "programs/launch/lsp/features.hpp"

namespace launch::lsp {

namespace {

constexpr int kWarningOfProtocol = 2;

// The texts in the quotes of a message: "attribute 'exec' not found …".
std::vector<std::string> all_quoted(const std::string& message) {
  std::vector<std::string> found;
  for (std::size_t begin = message.find('\''); begin != std::string::npos;) {
    if (begin > 0 && std::isalpha(static_cast<unsigned char>(message[begin - 1])) != 0) {  // "can't"
      begin = message.find('\'', begin + 1);
      continue;
    }
    const std::size_t end = message.find('\'', begin + 1);
    if (end == std::string::npos) {
      break;
    }
    found.push_back(message.substr(begin + 1, end - begin - 1));
    begin = message.find('\'', end + 1);
  }
  return found;
}

std::string quoted(const std::string& message) {
  const std::vector<std::string> all = all_quoted(message);
  return all.empty() ? std::string() : all.front();
}

// Where the word stands in the text: as a whole word, not as the name of a substitution, and once. npos otherwise.
std::size_t only_place(const std::string& text, const std::string& word) {
  const auto is_of_word = [](char byte) {
    return std::isalnum(static_cast<unsigned char>(byte)) != 0 || byte == '_' || byte == '-' || byte == ':';
  };
  std::size_t place = std::string::npos;
  for (std::size_t at = text.find(word); at != std::string::npos && !word.empty(); at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    const bool is_whole = (at == 0 || !is_of_word(text[at - 1])) && (end == text.size() || !is_of_word(text[end]));
    if (!is_whole || (at >= 2 && text.compare(at - 2, 2, "$(") == 0)) {
      continue;
    }
    if (place != std::string::npos) {
      return std::string::npos;
    }
    place = at;
  }
  return place;
}

class QuickFixes {
 public:
  QuickFixes(const Reading& reading, const Json& diagnostic)
      : reading_(reading),
        diagnostic_(diagnostic),
        text_(reading.document.text()),
        place_(reading.document.offset(diagnostic.at("range").at("start"))),
        end_(reading.document.offset(diagnostic.at("range").at("end"))) {}

  Json all() {
    const Json code = diagnostic_.value("code", Json());
    const std::string id = code.is_string() ? code.get<std::string>() : std::string();
    const std::string message = diagnostic_.value("message", "");
    changes(message.substr(0, message.find('\n')));  // without the help, which has the right names
    if (is_xml()) {
      if (id == "LF0103" && message.find("' not found in entity '") != std::string::npos) {
        add_attribute(quoted(message));
      } else if (id == "LF0101" && message.find("attribute") != std::string::npos && actions_.empty()) {
        remove_attribute();
      } else if (id == "LF0201" && message.starts_with("launch configuration '")) {
        declare(quoted(message));
      } else if (id == "LF0501" || id == "LF0502") {
        remove_element("arg");
      } else if (id == "LF0503") {
        give_default();
      } else if (id == "LF0109" && message.starts_with("there is no ")) {
        remove_line("Remove the comment");
      }
    }
    if (diagnostic_.value("severity", 0) == kWarningOfProtocol && id.starts_with("LF") && id != "LF0109") {
      ignore(id);
    }
    return std::move(actions_);
  }

 private:
  bool is_xml() const { return !reading_.outline.yaml && !reading_.outline.elements.empty(); }

  void add(const std::string& title, std::size_t begin, std::size_t end, const std::string& text, bool preferred) {
    actions_.push_back({{"title", title},
                        {"kind", "quickfix"},
                        {"diagnostics", Json::array({diagnostic_})},
                        {"isPreferred", preferred},
                        {"edit",
                         {{"changes",
                           {{uri_of(reading_.path),
                             Json::array({{{"range", reading_.document.range(begin, end)}, {"newText", text}}})}}}}}});
  }

  // What was meant, for the word that the message calls wrong. A path of the message may be a file name in the text.
  void changes(const std::string& message) {
    const Json names = diagnostic_.value("data", Json::array());
    const std::string written = text_.substr(place_, end_ - place_);
    for (const Json& name : names.is_array() ? names : Json::array()) {
      const auto& right = name.get_ref<const std::string&>();
      std::string wrong;
      std::string text;
      for (const std::string& one : all_quoted(message)) {
        const std::size_t path = one.rfind('/') + 1;
        const std::size_t right_path = right.rfind('/') + 1;
        const bool is_path = path > 0 && (right_path == 0 || right.substr(0, right_path) == one.substr(0, path));
        if (one.size() > wrong.size() && only_place(written, one) != std::string::npos) {
          wrong = one;
          text = right;
        } else if (wrong.empty() && is_path && written.ends_with(one.substr(path))) {
          wrong = one.substr(path);
          text = right.substr(right_path);
        }
      }
      if (const std::size_t at = only_place(written, wrong); at != std::string::npos) {
        add(fmt::format("Change to '{}'", text), place_ + at, place_ + at + wrong.size(), text, names.size() == 1);
      }
    }
  }

  // The innermost element whose head holds the finding, or nullptr.
  const OutlineElement* element() const {
    const OutlineElement* found = nullptr;
    for (const OutlineElement& one : reading_.outline.elements) {
      if (one.head.holds(place_) || (place_ + 1 == one.tag_span.begin && text_[place_] == '<')) {
        found = &one;
      }
    }
    return found;
  }

  void add_attribute(const std::string& name) {
    if (const OutlineElement* const at = element(); at != nullptr && !name.empty()) {
      add(fmt::format("Add {}=\"\"", name), at->tag_span.end, at->tag_span.end, fmt::format(" {}=\"\"", name), true);
    }
  }

  void remove_attribute() {
    const OutlineElement* const at = element();
    if (at == nullptr) {
      return;
    }
    for (const OutlineAttribute& attribute : at->attributes) {
      if (attribute.name_span.holds(place_)) {
        const std::size_t end = attribute.value ? attribute.value->end + 1 : attribute.name_span.end;
        const std::size_t before = text_.find_last_not_of(" \t\r\n", attribute.name_span.begin - 1) + 1;
        add(fmt::format("Remove {}", attribute.name), before, end, "", false);
      }
    }
  }

  // `<arg name="x"/>` at the beginning of the file.
  void declare(const std::string& name) {
    const OutlineElement& root = reading_.outline.elements.front();
    const std::size_t inside = std::min(root.head.end + 1, text_.size());
    if (!name.empty() && root.tag == "launch" && text_[root.head.end - 1] != '/') {
      add(fmt::format("Declare the argument '{}'", name), inside, inside, fmt::format("\n  <arg name=\"{}\"/>", name),
          false);
    }
  }

  void give_default() {
    const OutlineElement* const at = element();
    if (at != nullptr && at->tag == "arg" && at->find("default") == nullptr) {
      const OutlineAttribute* const name = at->find("name");
      const std::size_t behind = name != nullptr && name->value ? name->value->end + 1 : at->tag_span.end;
      add("Add default=\"\"", behind, behind, " default=\"\"", false);
    }
  }

  void remove_element(const std::string& tag) {
    const OutlineElement* const at = element();
    if (at == nullptr || at->tag != tag) {
      return;
    }
    std::size_t begin = std::min(at->whole.begin, at->tag_span.begin - 1);
    std::size_t end = at->whole.end;
    // With its line, if it has one for itself.
    const std::size_t line = text_.rfind('\n', begin) + 1;
    const std::size_t next = std::min(text_.find('\n', end), text_.size());
    const auto is_blank = [&](std::size_t from, std::size_t to) {
      return text_.substr(from, to - from).find_first_not_of(" \t\r") == std::string::npos;
    };
    if (is_blank(line, begin) && is_blank(end, next)) {
      begin = line;
      end = std::min(next + 1, text_.size());
    }
    add(fmt::format("Remove <{}>", tag), begin, end, "", true);
  }

  void remove_line(const std::string& title) {
    const std::size_t line = place_ == 0 ? 0 : text_.rfind('\n', place_ - 1) + 1;
    const std::size_t next = std::min(text_.find('\n', place_), text_.size());
    const std::string whole = text_.substr(line, next - line);
    const std::size_t first = std::min(whole.find_first_not_of(" \t"), whole.size());
    if (whole.compare(first, 4, "<!--") == 0 && whole.find("-->") + 3 >= whole.find_last_not_of(" \t\r") + 1) {
      add(title, line, std::min(next + 1, text_.size()), "", true);
    }
  }

  // A comment for the next line. The reason is for the user to write.
  void ignore(const std::string& id) {
    const std::size_t line = place_ == 0 ? 0 : text_.rfind('\n', place_ - 1) + 1;
    if (is_xml() && inside_of_tag(line)) {
      return;  // no comment can stand there
    }
    const std::string indent = text_.substr(line, std::min(text_.find_first_not_of(" \t", line), text_.size()) - line);
    const std::string comment = fmt::format("launch: ignore {}: reason", id);
    add(fmt::format("Ignore {} here", id), line, line,
        indent + (is_xml() ? "<!-- " + comment + " -->" : "# " + comment) + "\n", false);
  }

  bool inside_of_tag(std::size_t place) const {
    return std::any_of(reading_.outline.elements.begin(), reading_.outline.elements.end(),
                       [&](const OutlineElement& one) { return one.head.begin < place && place <= one.head.end; });
  }

  const Reading& reading_;
  const Json& diagnostic_;
  const std::string& text_;
  std::size_t place_;
  std::size_t end_;
  Json actions_ = Json::array();
};

}  // namespace

std::vector<std::string> suggested_names(const std::string& help) {
  std::vector<std::string> names;
  std::size_t at = help.find("did you mean '");
  const std::size_t stop = at == std::string::npos ? at : help.find('?', at);
  while (at < stop) {
    const std::size_t begin = help.find('\'', at) + 1;
    const std::size_t end = help.find('\'', begin);
    if (begin == 0 || begin > stop || end == std::string::npos) {
      break;
    }
    names.push_back(help.substr(begin, end - begin));
    at = end + 1;
  }
  return names;
}

Json code_actions(const Reading& reading, const Json& diagnostics) {
  Json actions = Json::array();
  for (const Json& diagnostic : diagnostics) {
    const Json found = QuickFixes(reading, diagnostic).all();
    actions.insert(actions.end(), found.begin(), found.end());
  }
  return actions;
}

}  // namespace launch::lsp
