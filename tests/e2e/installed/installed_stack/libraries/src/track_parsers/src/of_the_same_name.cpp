// SPDX-License-Identifier: Apache-2.0
int answer_of_the_package() {
  return 42;
}
