// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <string_view>

#include "base/text/quoted_text.hpp"
#include "launcher/frontend/frontend.hpp"
#include "programs/launch/rewrite/convert.hpp"
#include "programs/launch/rewrite/declared_element.hpp"
#include "programs/launch/rewrite/formatted.hpp"
#include "programs/launch/rewrite/yaml_text.hpp"

namespace launch {

namespace {

// Line ends and tabs of an attribute would be read as blanks.
std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : as_xml_text(text)) {
    if (c == '\n' || c == '\t' || c == '\r') {
      result += fmt::format("&#{};", static_cast<int>(c));
    } else {
      result += c;
    }
  }
  return result;
}

// A word of a command line as a shell reads it; what a $(…) gives is not split.
std::string shell_word(const std::string& word) {
  if (!word.empty() && word.find_first_of(" \t\n'\"\\") == std::string::npos) {
    return word;
  }
  std::string result = "'";
  for (const char c : word) {
    result += c == '\'' ? "'\"'\"'" : std::string(1, c);
  }
  return result + "'";
}

class XmlConverter {
 public:
  XmlConverter(Comments comments, const Registry& registry) : comments_(std::move(comments)), registry_(registry) {}

  Converted convert(const Entity& root) {
    comment(comments_.take_before(root.where.begin));
    element(root, declared_root());
    comment(comments_.take_rest());
    if (result_.errors.empty()) {
      result_.text = formatted_xml(result_.text, registry_);
    }
    return std::move(result_);
  }

 private:
  void comment(const std::vector<std::string>& lines) {
    for (std::size_t i = 0; i < lines.size();) {
      if (lines[i].empty()) {
        result_.text += "\n";
        ++i;
        continue;
      }
      std::string text;
      for (; i < lines.size() && !lines[i].empty(); ++i) {
        text += (text.empty() ? "" : "\n     ") + lines[i];
      }
      for (std::size_t at = text.find("--"); at != std::string::npos; at = text.find("--", at)) {
        text.replace(at, 2, "- -");
      }
      result_.text += fmt::format("<!-- {} -->\n", text);
    }
  }

  void element(const Entity& entity, const DeclaredElement& declared) {
    const std::string name = name_in_xml(entity.type_name, entity.where);
    result_.text += "<" + name;
    for (const Attribute& attribute : entity.attributes) {
      const std::string text = text_of(attribute, declared, entity.type_name);
      result_.text += fmt::format(" {}=\"{}\"", name_in_xml(attribute.name, attribute.value.where), escaped(text));
    }
    if (entity.children.empty()) {
      result_.text += "/>\n";
      return;
    }
    result_.text += ">\n";
    for (const Entity& child : entity.children) {
      comment(comments_.take_before(child.where.begin));
      element(child, declared_in(declared, child.type_name, registry_));
    }
    result_.text += fmt::format("</{}>\n", name);
  }

  // A key of YAML is any text.
  std::string name_in_xml(const std::string& name, const SourceRange& where) {
    constexpr std::string_view kBegin = "_:abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
    const auto fits = [kBegin](char c, bool is_first) {
      return static_cast<unsigned char>(c) >= 0x80 || kBegin.find(c) != std::string_view::npos ||
             (!is_first && std::string_view("-.0123456789").find(c) != std::string_view::npos);
    };
    bool is_name = !name.empty();
    for (std::size_t i = 0; i < name.size(); ++i) {
      is_name = is_name && fits(name[i], i == 0);
    }
    if (!is_name) {
      result_.errors.push_back({Severity::kError, fmt::format("'{}' is no name of XML", name), where,
                                "write it with letters, digits, '-', '_' and '.'"});
      return "unnamed";
    }
    return name;
  }

  std::string text_of(const Attribute& attribute, const DeclaredElement& declared, std::string_view tag) {
    const AttributeSpec* const spec = declared.attribute(attribute.name);
    const AttributeType type = spec != nullptr ? spec->type : AttributeType::kText;
    const Value& value = attribute.value;
    // What <set_parameter> gives is a text that the node reads by the rules of YAML, in both languages.
    if (type == AttributeType::kParameter && (tag != "set_parameter" || value.scalar() == nullptr)) {
      return parameter(value);
    }
    if (const Scalar* const scalar = value.scalar()) {
      if (scalar->type == Scalar::Type::kNull) {
        refuse(value, "an attribute without a value");
      }
      return scalar->text.text();
    }
    if (type != AttributeType::kWords) {
      refuse(value, "a list");
      return {};
    }
    std::string text;
    for (const Value& item : *value.list()) {
      if (const Scalar* const scalar = item.scalar()) {
        text += (text.empty() ? "" : " ") + shell_word(scalar->text.text());
      } else {
        refuse(item, "a list of lists");
      }
    }
    return text;
  }

  // In XML the rules of YAML find the type of a text, so a text that looks like a number is quoted within the quotes.
  std::string parameter(const Value& value) {
    const Scalar* const scalar = value.scalar();
    if (scalar == nullptr) {
      return yaml_value(value, AttributeType::kParameter, true);
    }
    const std::string& text = scalar->text.text();
    if (scalar->type != Scalar::Type::kString || text.find("$(") != std::string::npos) {
      return text;
    }
    try {
      const Value read = yaml11_value(LocatedText(text));
      const bool same = read.scalar() != nullptr && read.scalar()->type == Scalar::Type::kString &&
                        read.scalar()->text.text() == text;
      return same ? text : yaml_string(text, true);
    } catch (const LaunchError&) {
      return text;
    }
  }

  void refuse(const Value& value, std::string_view what) {
    result_.errors.push_back(
        {Severity::kError, fmt::format("XML has no form for {} here", what), value.where, "write it as one text"});
  }

  Comments comments_;
  const Registry& registry_;
  Converted result_;
};

}  // namespace

Converted convert_to_xml(const Entity& root, Comments comments, const Registry& registry) {
  return XmlConverter(std::move(comments), registry).convert(root);
}

}  // namespace launch
