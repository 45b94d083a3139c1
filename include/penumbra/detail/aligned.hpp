// Memory for large arrays, where vector instructions and caches like it best.
#pragma once

#include <cstddef>
#include <new>

namespace penumbra::detail {

/// For std::vector: starts at a cache line, and at a page from 64 KiB on. Arrays of one size then have the same
/// addresses modulo a page; where a store and a load close to it differ by little more than a page, processors wait.
template <class T>
struct AlignedAllocator {
    using value_type = T;

    AlignedAllocator() = default;
    template <class U>
    AlignedAllocator(const AlignedAllocator<U>&) {}

    T* allocate(std::size_t count) { return static_cast<T*>(::operator new(count * sizeof(T), alignment(count))); }
    void deallocate(T* memory, std::size_t count) { ::operator delete(memory, alignment(count)); }

    friend bool operator==(const AlignedAllocator&, const AlignedAllocator&) { return true; }
    friend bool operator!=(const AlignedAllocator&, const AlignedAllocator&) { return false; }

  private:
    static std::align_val_t alignment(std::size_t count) {
        return std::align_val_t(count * sizeof(T) < 65536 ? 64 : 4096);
    }
};

}  // namespace penumbra::detail
