// SPDX-License-Identifier: MIT
// What the C library asks of an operating system: memory, up to the stack. Nothing else is needed or there.
#include <cerrno>
#include <cstddef>
#include <cstdint>

extern "C" {
extern char bss_end[], stack_top[];  // set by the linker script

[[gnu::visibility("hidden")]] void* __dso_handle = nullptr;  // this program never ends, and destroys nothing

void* _sbrk(std::ptrdiff_t bytes) {
  static char* end = bss_end;
  constexpr std::ptrdiff_t stack = 256 * 1024;  // bytes
  if (stack_top - end < stack + bytes) {
    errno = ENOMEM;
    return reinterpret_cast<void*>(-1);
  }
  char* const begin = end;
  end += bytes;
  return begin;
}

// Where the variables of the only thread begin, less the two words that the chip's rules put before them. Nothing but
// r0 may change.
[[gnu::naked]] void* __aeabi_read_tp() { asm volatile("ldr r0, =tls_begin - 8\n bx lr\n .ltorg"); }

[[noreturn]] void _exit(int) {
  for (;;) {}
}
int _kill(int, int) { return -1; }
int _getpid() { return 1; }
int _close(int) { return -1; }
int _read(int, void*, std::size_t) { return 0; }
int _write(int, const void*, std::size_t size) { return static_cast<int>(size); }
long _lseek(int, long, int) { return 0; }
int _fstat(int, void*) { return -1; }
int _isatty(int) { return 0; }
}
