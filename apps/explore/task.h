// SPDX-License-Identifier: Apache-2.0
// Work beside the window, in a thread that may be left behind: its result is asked for, never waited for.
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
    // Only while nothing runs. `work` owns all that it uses.
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

    // The result, once; nullopt while it runs, and where it failed: then `failure` says why.
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
