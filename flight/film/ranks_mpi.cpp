// SPDX-License-Identifier: Apache-2.0
// The ranks of an MPI program. Rank 0 holds the next number to be distributed, and one of its threads answers the
// requests of the other ranks. That thread polls and sleeps in between, because a thread that waits inside MPI occupies
// a core. One-sided operations on the counter are not an alternative: they could wait until rank 0 calls MPI again.
#include <mpi.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>

#include "core/text/error.h"
#include "flight/film/ranks.h"

namespace mandelmarch {
namespace {

constexpr int ask_tag = 1;     // a request for work: the number that the rank has just finished, or -1 at first
constexpr int answer_tag = 2;  // the answer: the next number, or -1 if none are left
constexpr auto nap = std::chrono::milliseconds(2);

void wait_for(MPI_Request& request)
{
    for (int done = 0; done == 0;) {
        MPI_Test(&request, &done, MPI_STATUS_IGNORE);
        if (done == 0) std::this_thread::sleep_for(nap);
    }
}

class MpiRanks : public Ranks {
public:
    MpiRanks()
    {
        int provided = 0;
        MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
        MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
        MPI_Comm_size(MPI_COMM_WORLD, &size_);
        MPI_Comm here = MPI_COMM_NULL;
        MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &here);
        MPI_Comm_rank(here, &local_rank_);
        MPI_Comm_size(here, &local_size_);
        MPI_Comm_free(&here);
        if (provided < MPI_THREAD_SERIALIZED)
            throw Unavailable("this MPI does not support threads (MPI_THREAD_SERIALIZED), expected another one");
    }
    ~MpiRanks() override { MPI_Finalize(); }

    int rank() const override { return rank_; }
    int size() const override { return size_; }
    int local_rank() const override { return local_rank_; }
    int local_size() const override { return local_size_; }

    std::string share(const std::string& text) override
    {
        std::uint64_t length = text.size();
        MPI_Bcast(&length, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
        std::string copy = rank_ == 0 ? text : std::string(length, '\0');
        // The text is sent in pieces whose length fits into an int.
        constexpr std::uint64_t piece = 1U << 30;
        for (std::uint64_t at = 0; at < length; at += piece) {
            MPI_Bcast(copy.data() + at, static_cast<int>(std::min(piece, length - at)), MPI_CHAR, 0, MPI_COMM_WORLD);
        }
        return copy;
    }

    void each(std::size_t count, const std::function<void(std::size_t)>& body,
              const std::function<void(std::size_t)>& done) override
    {
        if (rank_ == 0) {
            std::atomic<long long> next = 0;
            std::mutex guard;  // this thread and the server both call `done`
            const auto report = [&](std::size_t number) {
                const std::scoped_lock lock(guard);
                done(number);
            };
            const auto take = [&] {
                const long long number = next++;
                return number < static_cast<long long>(count) ? number : -1;
            };
            std::jthread server([&] { serve(take, report); });
            for (long long mine = take(); mine >= 0; mine = take()) {
                body(static_cast<std::size_t>(mine));
                report(static_cast<std::size_t>(mine));
            }
        } else {
            long long done_before = -1;
            for (;;) {
                long long answer = -1;
                MPI_Request request = MPI_REQUEST_NULL;
                MPI_Send(&done_before, 1, MPI_LONG_LONG, 0, ask_tag, MPI_COMM_WORLD);
                MPI_Irecv(&answer, 1, MPI_LONG_LONG, 0, answer_tag, MPI_COMM_WORLD, &request);
                wait_for(request);
                if (answer < 0) break;
                // clang-analyzer does not detect that wait_for() completes the request, here and after the loop.
                body(static_cast<std::size_t>(answer));  // NOLINT(clang-analyzer-optin.mpi.MPI-Checker)
                done_before = answer;
            }
        }
        MPI_Request request = MPI_REQUEST_NULL;  // NOLINT(clang-analyzer-optin.mpi.MPI-Checker)
        MPI_Ibarrier(MPI_COMM_WORLD, &request);
        wait_for(request);
    }

    void abort(int code) override { MPI_Abort(MPI_COMM_WORLD, code); }

private:
    // Answers requests until every other rank has got the answer that no work is left.
    template <class Take, class Report>
    void serve(const Take& take, const Report& report) const
    {
        for (int working = size_ - 1; working > 0;) {
            int waiting = 0;
            MPI_Status status;
            MPI_Iprobe(MPI_ANY_SOURCE, ask_tag, MPI_COMM_WORLD, &waiting, &status);
            if (waiting == 0) {
                std::this_thread::sleep_for(nap);
                continue;
            }
            long long finished = -1;
            MPI_Recv(&finished, 1, MPI_LONG_LONG, status.MPI_SOURCE, ask_tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
            if (finished >= 0) report(static_cast<std::size_t>(finished));
            const long long answer = take();
            MPI_Send(&answer, 1, MPI_LONG_LONG, status.MPI_SOURCE, answer_tag, MPI_COMM_WORLD);
            if (answer < 0) --working;
        }
    }

    int rank_ = 0, size_ = 1, local_rank_ = 0, local_size_ = 1;
};

}  // namespace

std::unique_ptr<Ranks> make_ranks()
{
    if (!started_by_mpi()) return std::make_unique<Ranks>();
    return std::make_unique<MpiRanks>();
}

}  // namespace mandelmarch
