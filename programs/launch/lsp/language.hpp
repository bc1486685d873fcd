// SPDX-License-Identifier: Apache-2.0
// What may stand where in a launch file, by the declarations of the registry: for completion and hover.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "launcher/language/registry.hpp"
#include "programs/launch/outline/outline.hpp"

namespace launch::lsp {

// The declaration of an element: of an action, or of an item of one. Both null for an unknown tag and for the root.
struct Declared {
  const ActionType* action = nullptr;
  const ItemSpec* item = nullptr;
  bool is_root = false;

  std::vector<AttributeSpec> attributes() const;
  std::vector<ItemSpec> items() const;
  bool holds_actions() const;
  std::string help() const;
};

// `number` is that of an element of the outline; -1 is the place outside all elements.
Declared declared(const Outline& outline, int number, const Registry& registry);

const AttributeSpec* find_attribute(const std::vector<AttributeSpec>& attributes, std::string_view name);

// A "$(…" that is open at the end of the text: its name, and the argument that is being written.
struct OpenSubstitution {
  std::string name;
  bool in_name = false;                // the name itself is being written
  std::vector<std::string> arguments;  // the last one may be ""
  std::size_t begin = 0;               // of the word that is being written, in the text
};
std::optional<OpenSubstitution> open_substitution(std::string_view text);

}  // namespace launch::lsp
