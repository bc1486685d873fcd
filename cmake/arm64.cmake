# SPDX-License-Identifier: Apache-2.0
# Toolchain file: builds for arm64 on another processor, with the cross compiler and the libraries that Debian has for it
# (packages such as libfmt-dev:arm64, which lie beside those of the machine). What is built runs where the machine starts
# programs for arm64 through QEMU; `./dev on debian:13/cross-arm64` makes such a place.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
# pkg-config would find the libraries of the machine's own processor.
set(ENV{PKG_CONFIG_LIBDIR} /usr/lib/aarch64-linux-gnu/pkgconfig:/usr/share/pkgconfig)
