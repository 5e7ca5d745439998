// SPDX-License-Identifier: Apache-2.0
#include "core/isolation/shared_memory.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <new>

#include "core/text/error.h"

namespace mandelmarch::isolation {
namespace {

// Returns the position of an image's values in shared memory, in bytes. They are aligned and follow the image's
// bytes, as SharedImage's memory resource allocates them.
std::size_t values_at(std::size_t pixels)
{
    constexpr std::size_t alignment = alignof(PixelValue);
    return (3 * pixels + alignment - 1) / alignment * alignment;
}

// Throws the failure of a system call.
[[noreturn]] void refused(const char* call)
{
    if (errno == ENOMEM) throw std::bad_alloc();
    throw Error(fmt::format("no memory to share with a device's process: {}: {}", call, std::strerror(errno)));
}

}  // namespace

SharedMemory::SharedMemory(std::size_t size) : descriptor_(memfd_create("mandelmarch image", MFD_CLOEXEC)), size_(size)
{
    if (descriptor() < 0) refused("memfd_create");
    if (ftruncate(descriptor(), static_cast<off_t>(size)) != 0) refused("ftruncate");
    map();
}

SharedMemory::SharedMemory(Descriptor descriptor) : descriptor_(std::move(descriptor))
{
    struct stat status {};
    if (fstat(descriptor_.number(), &status) != 0)
        throw Error("a device's process was given no memory for its picture");
    size_ = static_cast<std::size_t>(status.st_size);
    map();
}

SharedMemory::~SharedMemory() { munmap(data_, size_); }

void SharedMemory::map()
{
    void* mapped = mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor(), 0);
    if (mapped == MAP_FAILED) refused("mmap");
    data_ = static_cast<std::byte*>(mapped);
}

std::size_t shared_size(std::size_t pixels, Image::Layers layers)
{
    return values_at(pixels) + (layers == Image::Layers::all ? pixels * sizeof(PixelValue) : 0);
}

void copy_shared(const SharedMemory& memory, Image& image)
{
    std::memcpy(image.bytes().data(), memory.data(), image.bytes().size());
    if (!image.has_values()) return;
    std::memcpy(image.values().data(), memory.data() + values_at(image.pixels()),
                image.values().size() * sizeof(PixelValue));
}

}  // namespace mandelmarch::isolation
