// SPDX-License-Identifier: Apache-2.0
// Memory shared by two processes. It contains an image, which a device process renders and the program reads.
#pragma once

#include <cstddef>
#include <memory_resource>

#include "core/image/image.h"
#include "core/os/descriptor.h"

namespace mandelmarch::isolation {

class SharedMemory {
public:
    explicit SharedMemory(std::size_t size);       // creates zeroed memory; throws std::bad_alloc, Error
    explicit SharedMemory(Descriptor descriptor);  // maps memory that the other process created; throws Error
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

// Returns the number of bytes that an image needs in shared memory.
std::size_t shared_size(std::size_t pixels, Image::Layers layers);

// An image in shared memory. The memory must outlive the image. Images with the same size and layers have the same
// layout.
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

// Copies an image from shared memory, where another process has rendered it as a SharedImage of the same size and
// layers.
void copy_shared(const SharedMemory& memory, Image& image);

}  // namespace mandelmarch::isolation
