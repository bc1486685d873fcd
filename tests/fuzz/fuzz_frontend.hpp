// SPDX-License-Identifier: Apache-2.0
// Every value of an entity tree is taken as what an action could take it for.
#pragma once

#include <cstdlib>

#include "launcher/frontend/entity_equivalence.hpp"
#include "launcher/frontend/frontend.hpp"
#include "launcher/frontend/input_text.hpp"
#include "launcher/frontend/simple_yaml.hpp"
#include "launcher/substitution/template_parser.hpp"
#include "tests/fuzz/fuzz_input.hpp"
#include "tests/support/yaml_tree/yaml_tree.hpp"

namespace fuzz {

// What the launcher reads without yaml-cpp must be what yaml-cpp reads.
inline void check_simple_yaml(const launch::LocatedText& text) {
  std::vector<launch::Diagnostic> errors;
  if (launch::is_plain_scalar(text.text())) {
    const launch::YamlNode node = launch::read_any_yaml(text, errors);
    if (node.kind != launch::YamlNode::Kind::kScalar || node.scalar.text.text() != text.text()) {
      std::abort();
    }
  }
  if (const auto simple = launch::read_simple_yaml(text)) {
    if (test_support::tree_text(*simple) != test_support::tree_text(launch::read_any_yaml(text, errors))) {
      std::abort();
    }
  }
  if (!errors.empty()) {
    std::abort();
  }
}

inline void walk(const launch::Entity& entity) {
  static_cast<void>(launch::to_string(entity.where));
  for (const launch::Attribute& attribute : entity.attributes) {
    static_cast<void>(launch::to_string(attribute.value.where));
    if (const launch::Scalar* const scalar = attribute.value.scalar()) {
      try_step([&] { launch::parse_template(scalar->text); });
      try_step([&] { launch::yaml11_value(scalar->text); });
      check_simple_yaml(scalar->text);
    }
  }
  for (const launch::Entity& child : entity.children) {
    walk(child);
  }
}

inline void run_frontend(launch::Entity (*parse)(const std::shared_ptr<const launch::SourceFile>&),
                         const std::uint8_t* data, std::size_t size) {
  const auto file = as_file(data, size);
  const launch::LocatedText whole(file->text(), {file, 0, static_cast<std::uint32_t>(size)});
  if (!launch::find_bad_character(whole)) {
    check_simple_yaml(whole);
  }
  try_step([&] {
    const launch::Entity root = parse(file);
    walk(root);
    if (!launch::equivalent(root, parse(file))) {
      std::abort();  // the same text means the same
    }
  });
}

}  // namespace fuzz
