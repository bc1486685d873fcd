// SPDX-License-Identifier: Apache-2.0
// Templates of attributes: $(name arg …), escapes, command lines. They are parsed, not performed.
#include "launcher/substitution/template_parser.hpp"
#include "tests/fuzz/fuzz_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto file = fuzz::as_file(data, size);
  const launch::SourceRange whole{file, 0, static_cast<std::uint32_t>(size)};
  fuzz::try_step([&] {
    const launch::Template parsed = launch::parse_template(launch::LocatedText(file->text(), whole));
    static_cast<void>(parsed.describe());
    if (parsed.is_literal()) {
      launch::Scope nothing;
      static_cast<void>(parsed.perform(nothing));
    }
    for (const launch::Template& word : launch::split_command_line(parsed)) {
      static_cast<void>(word.describe());
    }
  });
  fuzz::try_step([&] { launch::split_shell_words(file->text(), whole); });
  static_cast<void>(launch::unescape(file->text()));
  return 0;
}
