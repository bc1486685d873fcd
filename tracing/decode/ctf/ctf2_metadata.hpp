// SPDX-License-Identifier: Apache-2.0
// The metadata of CTF 2, which LTTng from 2.14 on and babeltrace2 from 2.1 on can write: a sequence of JSON texts. What
// they declare is told in the language of CTF 1.8, for what reads that. Fields that CTF 2 tells by their roles get the
// names that CTF 1.8 gives them.
#pragma once

#include <string>
#include <string_view>

namespace tracing::ctf {

// Whether the metadata are those of CTF 2.
bool is_ctf2_metadata(std::string_view bytes);

struct Ctf2Metadata {
  std::string text;     // in the language of CTF 1.8
  bool is_cut = false;  // the last JSON text is not complete; it is left out
};

// Throws UnsupportedTrace for what CTF 1.8 has no type for: optional fields, integers of variable length.
Ctf2Metadata translate_ctf2(std::string_view bytes);

}  // namespace tracing::ctf
