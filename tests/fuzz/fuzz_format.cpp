// SPDX-License-Identifier: Apache-2.0
// `launch format`: a file that it writes anew says the same, and a second time gives the same text. What it converts
// can be read.
#include <cstdlib>

#include "launcher/frontend/frontend.hpp"
#include "programs/launch/rewrite/convert.hpp"
#include "programs/launch/rewrite/formatted.hpp"
#include "tests/fuzz/fuzz_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const launch::Registry registry;
  const auto file = fuzz::as_file(data, size);
  fuzz::try_step([&] {
    // formatted() itself reads the result again and compares the trees.
    const std::string once = formatted(file, registry);
    if (formatted(std::make_shared<launch::SourceFile>(file->path(), once), registry) != once) {
      std::abort();
    }
  });
  fuzz::try_step([&] {
    const launch::Entity root = load_entity_tree(file);
    const launch::Converted yaml = convert_to_yaml(root, launch::Comments(file), registry);
    static_cast<void>(convert_to_xml(root, launch::Comments(file), registry));
    static_cast<void>(convert_to_python(root, launch::Comments(file), registry));
    static_cast<void>(yaml);
  });
  return 0;
}
