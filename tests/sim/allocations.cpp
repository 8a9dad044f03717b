#include "tests/sim/allocations.h"

#include <atomic>
#include <cstdlib>
#include <new>

#ifdef FLANEUR_SANITIZED  // a sanitizer brings its own operator new, and tells of each allocation
static thread_local size_t s_count = 0;
extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*)(const volatile void*, size_t),
                                                         void (*)(const volatile void*));
static const int s_installed = __sanitizer_install_malloc_and_free_hooks(
    [](const volatile void*, size_t) { ++s_count; }, [](const volatile void*) {});
#else
static std::atomic<size_t> s_count = 0;
void* operator new(size_t size) {
    ++s_count;
    if (void* p = std::malloc(size)) return p;
    throw std::bad_alloc();
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, size_t) noexcept { std::free(p); }
#endif

namespace flaneur {

size_t allocations() { return s_count; }

}  // namespace flaneur
