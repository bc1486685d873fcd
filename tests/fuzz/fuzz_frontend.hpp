// SPDX-License-Identifier: Apache-2.0
// Reads every value of an entity tree in every way in which an action could read it.
#pragma once

#include <cstdlib>

#include "launcher/frontend/frontend.hpp"
#include "launcher/substitution/template_parser.hpp"
#include "tests/fuzz/fuzz_input.hpp"
#include "tests/unit/frontend/entity_equivalence.hpp"

namespace fuzz {

inline void walk(const launch::Entity& entity) {
  static_cast<void>(launch::to_string(entity.where));
  for (const launch::Attribute& attribute : entity.attributes) {
    static_cast<void>(launch::to_string(attribute.value.where));
    if (const launch::Scalar* const scalar = attribute.value.scalar()) {
      try_step([&] { launch::parse_template(scalar->text); });
      try_step([&] { launch::yaml11_value(scalar->text); });
    }
  }
  for (const launch::Entity& child : entity.children) {
    walk(child);
  }
}

inline void run_frontend(launch::Entity (*parse)(const std::shared_ptr<const launch::SourceFile>&),
                         const std::uint8_t* data, std::size_t size) {
  const auto file = as_file(data, size);
  try_step([&] {
    const launch::Entity root = parse(file);
    walk(root);
    if (!launch::equivalent(root, parse(file))) {
      std::abort();  // the same text must mean the same
    }
  });
}

}  // namespace fuzz
