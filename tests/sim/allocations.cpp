#include "tests/sim/allocations.h"

#include <atomic>
#include <cstdlib>
#include <new>

static std::atomic<size_t> s_count = 0;

void* operator new(size_t size) {
    ++s_count;
    if (void* p = std::malloc(size)) return p;
    throw std::bad_alloc();
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, size_t) noexcept { std::free(p); }

namespace flaneur {

size_t allocations() { return s_count; }

}  // namespace flaneur
