# CMake toolchain file for 64-bit Arm processors, with Debian's cross compiler and arm64 packages, for
# scripts/cross-arm. Programs run under qemu if the build or a test needs them.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64-static)
set(ENV{PKG_CONFIG_LIBDIR} /usr/lib/aarch64-linux-gnu/pkgconfig:/usr/share/pkgconfig)
# No manual pages, because help2man would run the programs without qemu.
set(HELP2MAN "" CACHE FILEPATH "left out when cross-compiling")
