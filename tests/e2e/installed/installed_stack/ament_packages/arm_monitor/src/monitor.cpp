// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "arm_driver/arm_model.hpp"

int main() {
  std::printf("%g\n", arm_driver::hold(5.0).torques[0]);
}
