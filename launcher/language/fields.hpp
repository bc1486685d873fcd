// SPDX-License-Identifier: Apache-2.0
// The fields of an action, read from the file by its declaration: attributes by name, parsed by their declared type.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "launcher/frontend/entity.hpp"
#include "launcher/language/action.hpp"
#include "launcher/language/registry.hpp"

namespace launch {

// A boolean attribute: a literal that is checked at load, or a template whose text must be a boolean.
class BooleanField {
 public:
  explicit BooleanField(bool fallback) : fallback_(fallback) {}
  // Throws LaunchError when a literal isn't a boolean.
  explicit BooleanField(Template source);
  bool perform(Scope& scope) const;

 private:
  std::optional<Template> source_;
  bool fallback_ = false;
};

// A number attribute: a literal that is checked at load, or a template whose text must be a number.
class NumberField {
 public:
  NumberField(Template source, bool whole);
  double perform(Scope& scope) const;
  // Throws LaunchError now when the value is literal and below zero; later values are checked when performed.
  void require_not_negative();

 private:
  double convert(const std::string& text) const;

  Template source_;
  bool whole_ = false;
  bool not_negative_ = false;
};

class Fields {
 public:
  using Parsed = std::variant<Template, std::string, std::vector<Template>, BooleanField, NumberField, Value>;

  explicit Fields(SourceRange where);

  const SourceRange& where() const { return where_; }
  // The place of an attribute's value, or of the tag when the attribute isn't given.
  const SourceRange& where(std::string_view attribute) const;
  bool has(std::string_view attribute) const { return find(attribute) != nullptr; }

  // Attributes by the type of their declaration. A getter without fallback must be used for given attributes only. A
  // getter that returns an optional gives nullopt for others.
  const Template& text(std::string_view attribute) const;
  std::optional<Template> optional_text(std::string_view attribute) const;
  std::string literal(std::string_view attribute, std::string fallback = {}) const;
  std::vector<Template> words(std::string_view attribute) const;
  std::optional<std::vector<Template>> optional_words(std::string_view attribute) const;
  BooleanField boolean(std::string_view attribute, bool fallback) const;
  std::optional<NumberField> number(std::string_view attribute) const;
  const Value& value(std::string_view attribute) const;

  // Structured items of one tag, in document order.
  std::vector<const Fields*> items(std::string_view tag) const;
  const std::vector<ActionPtr>& actions() const { return actions_; }
  const Condition& condition() const { return condition_; }

 private:
  friend class ActionParser;
  // The names belong to the declarations, which outlive the fields.
  struct Entry {
    std::string_view name;
    Parsed parsed;
    SourceRange where;
  };
  struct Item;

  const Entry* find(std::string_view attribute) const;
  template <typename Type>
  const Type& get(std::string_view attribute) const {
    return std::get<Type>(find(attribute)->parsed);
  }

  SourceRange where_;
  std::vector<Entry> attributes_;  // a few
  std::vector<Item> items_;
  std::vector<ActionPtr> actions_;
  Condition condition_;
};

struct Fields::Item {
  std::string_view tag;
  Fields fields;
};

}  // namespace launch
