// Counts what a process allocates: a library that is loaded before all others (LD_PRELOAD).
//
// allocations.py builds it, runs a deck twice and takes the difference. At the end of the process
// the file that ALLOCATIONS_FILE names gets one line: all allocations, their bytes, those of
// ALLOCATIONS_LARGE bytes or more (131072, from where glibc asks the system), their bytes.
// realloc counts where it asks for more than there was room for. Of glibc alone.
#include <malloc.h>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstdlib>

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
}

namespace {

std::atomic<unsigned long> all{0}, all_bytes{0}, large{0}, large_bytes{0};
std::atomic<std::size_t> large_from{131072};

void count(std::size_t size) {
  all.fetch_add(1, std::memory_order_relaxed);
  all_bytes.fetch_add(size, std::memory_order_relaxed);
  if (size < large_from.load(std::memory_order_relaxed)) return;
  large.fetch_add(1, std::memory_order_relaxed);
  large_bytes.fetch_add(size, std::memory_order_relaxed);
}

struct Counting {
  Counting() {
    if (const char* text = std::getenv("ALLOCATIONS_LARGE")) large_from = std::atol(text);
  }
  ~Counting() {
    const char* name = std::getenv("ALLOCATIONS_FILE");
    std::FILE* file = name != nullptr ? std::fopen(name, "w") : nullptr;
    if (file == nullptr) return;
    std::fprintf(file, "%lu %lu %lu %lu\n", all.load(), all_bytes.load(), large.load(),
                 large_bytes.load());
    std::fclose(file);
  }
} counting;

}  // namespace

extern "C" {

void* malloc(std::size_t size) {
  count(size);
  return __libc_malloc(size);
}
void* calloc(std::size_t number, std::size_t size) {
  count(number * size);
  return __libc_calloc(number, size);
}
void* realloc(void* old, std::size_t size) {
  if (old == nullptr || size > malloc_usable_size(old)) count(size);
  return __libc_realloc(old, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
  count(size);
  return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  return memalign(alignment, size);
}
int posix_memalign(void** to, std::size_t alignment, std::size_t size) {
  *to = memalign(alignment, size);
  return *to != nullptr ? 0 : ENOMEM;
}

}  // extern "C"
