// SPDX-License-Identifier: Apache-2.0
// A task in the background. It runs in a detached thread, which may be abandoned; its result is polled.
#pragma once

#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

namespace mandelmarch::explore {

template <class Result>
class Task {
public:
    // Starts `work` in a thread. `work` must own everything that it uses. Must not be called while a task is running.
    void start(std::function<Result()> work)
    {
        auto shared = std::make_shared<Shared>();
        shared_ = shared;
        std::thread([shared, work = std::move(work)] {
            std::optional<Result> result;
            std::string failure;
            try {
                result = work();
            } catch (const std::exception& error) {
                failure = error.what();
            }
            const std::scoped_lock lock(shared->mutex);
            shared->result = std::move(result);
            shared->failure = std::move(failure);
            shared->ended = true;
        }).detach();
    }

    bool running() const { return shared_ != nullptr; }

    // Returns the result once after the task has ended. Returns nullopt while the task is running or if there is none;
    // also if it has failed, and then sets `failure` to the error's message.
    std::optional<Result> take(std::string& failure)
    {
        if (shared_ == nullptr) return std::nullopt;
        const auto shared = shared_;
        const std::scoped_lock lock(shared->mutex);
        if (!shared->ended) return std::nullopt;
        shared_.reset();
        failure = shared->failure;
        return std::move(shared->result);
    }

private:
    struct Shared {
        std::mutex mutex;
        std::optional<Result> result;
        std::string failure;
        bool ended = false;
    };
    std::shared_ptr<Shared> shared_;
};

}  // namespace mandelmarch::explore
