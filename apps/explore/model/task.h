// SPDX-License-Identifier: Apache-2.0
// A task in the background. It runs in a detached thread, which may be abandoned. The caller polls for the result.
#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <optional>
#include <string>
#include <thread>

namespace mandelmarch::explore {

template <class Result>
class Task {
public:
    // Starts `work` in a thread. `work` must own everything that it uses. Must not be called while a task is running.
    void start(std::function<Result()> work)
    {
        std::packaged_task<Result()> task(std::move(work));
        result_ = task.get_future();
        std::thread(std::move(task)).detach();
    }

    bool running() const { return result_.valid(); }

    // Returns the result at the first call after the task has ended. Returns nullopt if the task is still running or if
    // there is no task. If the task has failed, returns nullopt and sets `failure` to the error's message.
    std::optional<Result> take(std::string& failure)
    {
        if (!running() || result_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return std::nullopt;
        try {
            return result_.get();
        } catch (const std::exception& error) {
            failure = error.what();
            return std::nullopt;
        }
    }

private:
    std::future<Result> result_;
};

}  // namespace mandelmarch::explore
