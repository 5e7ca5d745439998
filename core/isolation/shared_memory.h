// SPDX-License-Identifier: Apache-2.0
// Memory shared by two processes: an image's layers, rendered by a device process and read by the program.
#pragma once

#include <cstddef>
#include <memory_resource>

#include "core/image/image.h"
#include "core/base/descriptor.h"

namespace mandelmarch::isolation {

class SharedMemory {
public:
    explicit SharedMemory(std::size_t size);       // new, zeroed; throws std::bad_alloc
    explicit SharedMemory(Descriptor descriptor);  // memory created by the other process; throws Error
    SharedMemory(const SharedMemory&) = delete;
    SharedMemory& operator=(const SharedMemory&) = delete;
    ~SharedMemory();

    int descriptor() const { return descriptor_.number(); }
    std::size_t size() const { return size_; }
    std::byte* data() const { return data_; }

private:
    void map();

    Descriptor descriptor_;
    std::size_t size_ = 0;
    std::byte* data_ = nullptr;
};

// Returns the bytes of an image in shared memory.
std::size_t shared_size(std::size_t pixels, Image::Layers layers);

// An image in shared memory, which must outlive it. Images of the same size and layers have the same layout.
class SharedImage {
public:
    SharedImage(const SharedMemory& memory, int width, int height, Image::Layers layers, int first_row = 0)
        : resource_(memory.data(), memory.size(), std::pmr::null_memory_resource()),
          image(width, height, layers, &resource_, first_row)
    {
    }

private:
    std::pmr::monotonic_buffer_resource resource_;

public:
    Image image;
};

// Copies an image that another process has rendered into a SharedImage of the same size and layers.
void copy_shared(const SharedMemory& memory, Image& image);

}  // namespace mandelmarch::isolation
