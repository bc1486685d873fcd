// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace launch {

// The value as YAML, with each text in quotes, so that "no" and "1.10" stay texts.
std::string as_yaml(const nlohmann::ordered_json& value);

}  // namespace launch
