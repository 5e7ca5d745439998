// SPDX-License-Identifier: Apache-2.0
// Memory and tile queue of the threads.
#pragma once

#include <atomic>
#include <cstddef>
#include <new>
#include <utility>

#include "backends/openmp/variant.h"
#include "core/image/tile.h"
#include "core/render/backend.h"
#include "core/render/schedule.h"

namespace mandelmarch::openmp {

// Memory of one thread. It is reused between pictures, because new memory pages cost time.
class ThreadMemory {
public:
    ThreadMemory() = default;
    ~ThreadMemory() { ::operator delete(at_, alignment); }
    ThreadMemory(const ThreadMemory&) = delete;
    ThreadMemory& operator=(const ThreadMemory&) = delete;

    void* of_size(std::size_t bytes)
    {
        if (bytes > size_) {
            ::operator delete(std::exchange(at_, nullptr), alignment);
            size_ = 0;
            at_ = ::operator new(bytes, alignment);
            size_ = bytes;
        }
        return at_;
    }

private:
    static constexpr std::align_val_t alignment{64};
    void* at_ = nullptr;
    std::size_t size_ = 0;
};

// The tiles of a band. They are assigned to threads row by row from the bottom left, `chunk` at a time. After a
// cancellation no more tiles are assigned.
class TileQueue {
public:
    TileQueue(int width, const Band& band, int chunk, const Progress* progress = nullptr)
        : columns_((width + tile_side - 1) / tile_side),
          count_(columns_ * ((band.rows + tile_side - 1) / tile_side)),
          first_row_(band.first_row),
          chunk_(chunk),
          progress_(progress)
    {
    }

    // The tiles that one thread has taken from the queue.
    struct Share {
        TileQueue& queue;
        int at = 0, end = 0;  // index of the next tile, and of the one after the last tile taken

        Tiles tiles() { return {next, this}; }
    };

private:
    static bool next(void* source, int& left, int& bottom)
    {
        auto& [queue, at, end] = *static_cast<Share*>(source);
        if (at == end) {
            at = queue.taken_.fetch_add(queue.chunk_, std::memory_order_relaxed);
            end = at + queue.chunk_;
        }
        const int index = at++;
        if (index >= queue.count_ || (queue.progress_ != nullptr && queue.progress_->cancelled())) {
            at = end = queue.count_;
            return false;
        }
        left = index % queue.columns_ * tile_side;
        bottom = queue.first_row_ + index / queue.columns_ * tile_side;
        return true;
    }

    int columns_;
    int count_;
    int first_row_;
    int chunk_;
    const Progress* progress_;  // nullptr: cannot be cancelled
    std::atomic<int> taken_ = 0;
};

}  // namespace mandelmarch::openmp
