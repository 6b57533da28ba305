# CMake's toolchain file for Arm processors of 64 bits with Debian's cross compiler and arm64 packages;
# scripts/cross-arm uses it. What is built runs under qemu where the build or a test needs it.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64-static)
set(ENV{PKG_CONFIG_LIBDIR} /usr/lib/aarch64-linux-gnu/pkgconfig:/usr/share/pkgconfig)
# help2man runs programs itself, without qemu: no manual pages.
set(HELP2MAN "" CACHE FILEPATH "left out when cross-compiling")
