// SPDX-License-Identifier: Apache-2.0
// Tests the numbers of cores and bytes of memory that are available under control groups, affinity masks and OpenMP's
// variables. Temporary folders replace the system's /proc and /sys.
#include "core/os/cores.h"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sched.h>
#include <sys/resource.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stop_token>
#include <string>
#include <thread>

#include "core/os/control_group.h"
#include "core/os/files.h"
#include "core/os/memory.h"
#include "core/text/error.h"

namespace mandelmarch {
namespace {

constexpr std::uint64_t mebibyte = 1ULL << 20;

// A temporary folder that is used as the root folder, /.
class Tree {
public:
    explicit Tree(const std::string& groups) { write("/proc/self/cgroup", groups); }

    Tree& write(const std::string& file, const std::string& text)
    {
        const std::filesystem::path path = root_ + file;
        std::filesystem::create_directories(path.parent_path());
        std::ofstream(path) << text;
        return *this;
    }
    const std::string& root() const { return root_; }

private:
    const TemporaryFolder made_;
    const std::string root_ = made_.path().string();
};

class CoreCount : public testing::Test {
protected:
    static void set(const char* name, const char* value) { setenv(name, value, 1); }
    void TearDown() override
    {
        for (const char* name :
             {"OMP_NUM_THREADS", "OMP_THREAD_LIMIT", "OMP_PLACES", "OMP_PROC_BIND", "GOMP_CPU_AFFINITY"}) {
            unsetenv(name);
        }
    }
};

TEST(MemoryLeft, CountsNoPageCacheOfVersion2)
{
    Tree tree("0::/job/step\n");
    tree.write("/sys/fs/cgroup/job/memory.max", "734003200\n")
        .write("/sys/fs/cgroup/job/memory.current", "733000000\n")
        .write("/sys/fs/cgroup/job/memory.stat",
               "anon 1000000\nfile 731000000\ninactive_file 500000000\nactive_file "
               "230000000\nslab_reclaimable 1000000\n")
        .write("/sys/fs/cgroup/job/step/memory.max", "max\n")
        .write("/sys/fs/cgroup/job/step/memory.current", "1000\n");
    EXPECT_EQ(memory_left_in_groups(tree.root()), 734003200 - 2000000);
    // Negative control: memory that is not page cache counts as used.
    tree.write("/sys/fs/cgroup/job/memory.stat", "anon 733000000\ninactive_file 0\n");
    EXPECT_EQ(memory_left_in_groups(tree.root()), 734003200 - 733000000);
    // memory.high is a limit, too. The page cache does not count as used. Even if the cache is larger than all used
    // memory, no more than the limit is available.
    tree.write("/sys/fs/cgroup/job/memory.high", "104857600\n")
        .write("/sys/fs/cgroup/job/memory.stat", "inactive_file 900000000\n");
    EXPECT_EQ(memory_left_in_groups(tree.root()), 100 * mebibyte);
}

TEST(MemoryLeft, CountsNoPageCacheOfVersion1)
{
    Tree tree("9:name=systemd:/\n4:memory:/docker/abc\n");
    // In a container, the folder of its group is /sys/fs/cgroup/memory itself, without the path of /proc/self/cgroup.
    tree.write("/sys/fs/cgroup/memory/memory.limit_in_bytes", "734003200\n")
        .write("/sys/fs/cgroup/memory/memory.usage_in_bytes", "734000000\n")
        .write("/sys/fs/cgroup/memory/memory.stat",
               "inactive_file 1\ntotal_inactive_file 700000000\ntotal_active_file 30000000\n");
    EXPECT_EQ(memory_left_in_groups(tree.root()), 734003200 - 4000000);
    tree.write("/proc/meminfo", "MemTotal: 9000000 kB\nMemAvailable:   100000 kB\n");
    EXPECT_EQ(available_memory(tree.root()), 100000 * 1024);
}

TEST(MemoryLeft, HasNoLimitWithoutGroups)
{
    EXPECT_EQ(memory_left_in_groups(Tree("").root()), no_limit);
    EXPECT_EQ(memory_left_in_groups("/nowhere"), no_limit);
    EXPECT_GT(available_memory(), mebibyte);
    EXPECT_LT(available_memory(), 1ULL << 50) << "the memory of this machine is a limit";
}

TEST(Shortage, OfFilesIsNamed)
{
    EXPECT_NO_THROW(refuse_shortage("opening drivers"));
    rlimit files{};
    getrlimit(RLIMIT_NOFILE, &files);
    const rlimit few{.rlim_cur = 8, .rlim_max = files.rlim_max};
    setrlimit(RLIMIT_NOFILE, &few);
    try {
        refuse_shortage("opening drivers");
        ADD_FAILURE() << "eight files are enough";
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "opening drivers: Too many open files");
    }
    setrlimit(RLIMIT_NOFILE, &files);
}

TEST(Quota, IsTheLeastOfAllGroupsAbove)
{
    Tree two("0::/a/b\n");
    EXPECT_FALSE(processor_quota(two.root()));
    two.write("/sys/fs/cgroup/a/b/cpu.max", "max 100000\n");
    EXPECT_FALSE(processor_quota(two.root()));
    two.write("/sys/fs/cgroup/a/cpu.max", "150000 100000\n");
    EXPECT_EQ(processor_quota(two.root()), 1.5);
    two.write("/sys/fs/cgroup/a/b/cpu.max", "20000 100000\n");
    EXPECT_EQ(processor_quota(two.root()), 0.2);
    Tree one("3:cpu,cpuacct:/job\n0::/\n");
    one.write("/sys/fs/cgroup/cpu,cpuacct/job/cpu.cfs_quota_us", "-1\n")
        .write("/sys/fs/cgroup/cpu,cpuacct/job/cpu.cfs_period_us", "100000\n");
    EXPECT_FALSE(processor_quota(one.root()));
    one.write("/sys/fs/cgroup/cpu,cpuacct/cpu.cfs_quota_us", "50000\n")
        .write("/sys/fs/cgroup/cpu,cpuacct/cpu.cfs_period_us", "100000\n");
    EXPECT_EQ(processor_quota(one.root()), 0.5);
}

TEST(Quota, ThrottledPeriodsAreCounted)
{
    Tree tree("0::/job\n");
    EXPECT_EQ(throttling(tree.root()).throttled, 0);
    tree.write("/sys/fs/cgroup/job/cpu.stat", "usage_usec 5\nnr_periods 103\nnr_throttled 102\nthrottled_usec 9\n");
    EXPECT_EQ(throttling(tree.root()).throttled, 102);
    EXPECT_EQ(throttling(tree.root()).periods, 103);
}

TEST_F(CoreCount, FollowsAffinityQuotaAndOpenmp)
{
    EXPECT_EQ((Cores{.machine = 8, .given = 8}.threads()), 8);
    EXPECT_EQ((Cores{.machine = 8, .given = 3}.threads()), 3);
    EXPECT_EQ((Cores{.machine = 8, .given = 8, .quota = 1.5}.threads()), 2);
    EXPECT_EQ((Cores{.machine = 8, .given = 8, .quota = 0.2}.threads()), 1);
    EXPECT_EQ((Cores{.machine = 8, .given = 2, .quota = 6}.threads()), 2);
    EXPECT_EQ((Cores{.machine = 8, .given = 8, .quota = 2, .asked = 5}.threads()), 5);
    EXPECT_EQ((Cores{.machine = 8, .given = 8, .asked = 5, .limit = 3}.threads()), 3);
    EXPECT_EQ((Cores{.machine = 8, .given = 8, .limit = 16}.threads()), 8);
}

TEST_F(CoreCount, ReadsOpenmpsVariables)
{
    // GNU's library ignores these values, too, and says so.
    for (const char* nonsense : {"", "x", "0", "-2", "1e3", "3.7", "3x", "3,", "2,x", "99999999999999999999"}) {
        set("OMP_NUM_THREADS", nonsense);
        EXPECT_FALSE(cores().asked) << nonsense;
    }
    set("OMP_THREAD_LIMIT", "4294967295");
    for (const char* many : {"1025", "200000", "2147483648,1"}) {
        set("OMP_NUM_THREADS", many);
        EXPECT_THROW(cores(), InputError) << many;
    }
    set("OMP_NUM_THREADS", "1024 ");
    EXPECT_EQ(usable_threads(), 1024);
}

TEST_F(CoreCount, NamesWhatBindsOpenmpsThreads)
{
    set("OMP_PLACES", "");
    set("GOMP_CPU_AFFINITY", "");
    for (const char* binds : {"close", "TRUE", " True ", "Spread,close", "primary"}) {
        set("OMP_PROC_BIND", binds);
        EXPECT_EQ(binding(), std::string("OMP_PROC_BIND=") + binds);
    }
    set("GOMP_CPU_AFFINITY", "0");
    for (const char* loose : {"false", "False", " FALSE"}) {
        set("OMP_PROC_BIND", loose);
        EXPECT_EQ(binding(), "") << loose;
    }
    for (const char* ignored : {"", "yes", "true,close"}) {
        set("OMP_PROC_BIND", ignored);
        EXPECT_EQ(binding(), "GOMP_CPU_AFFINITY=0") << ignored;
    }
}

// The available cores are the cores that the process had at its start. If a thread changes its own affinity mask, they
// stay the same, and restore_affinity() gives them back to the thread.
TEST(Affinity, IsThatOfTheProcessesStartAndCanBeRestored)
{
    const int given = cores().given;
    std::jthread([given] {
        cpu_set_t set;
        sched_getaffinity(0, sizeof set, &set);
        const int before = CPU_COUNT(&set);
        std::size_t first = 0;
        while (!CPU_ISSET(first, &set)) ++first;
        CPU_ZERO(&set);
        CPU_SET(first, &set);
        ASSERT_EQ(sched_setaffinity(0, sizeof set, &set), 0);
        EXPECT_EQ(cores().given, given);
        restore_affinity();
        sched_getaffinity(0, sizeof set, &set);
        EXPECT_EQ(CPU_COUNT(&set), given);
        EXPECT_GE(given, before);
    });
}

// Two devices of a driver have threads of the same names.
TEST(Cores, ThreadsOfSeveralDevicesAreCountedOnce)
{
    const auto named = [](const char* name) {
        return std::jthread([name](const std::stop_token& stop) {
            pthread_setname_np(pthread_self(), name);
            while (!stop.stop_requested()) std::this_thread::yield();
        });
    };
    const auto wait_for = [](int count) {
        while (threads_named("counted-") != count) std::this_thread::yield();
        return threads_named("counted-");
    };
    const std::jthread first = named("counted-0");
    EXPECT_EQ(wait_for(1), 1);
    const std::jthread again = named("counted-0");
    const std::jthread second = named("counted-1");
    EXPECT_EQ(wait_for(2), 2);
    EXPECT_EQ(threads_named("nobody-"), 0);
}

}  // namespace
}  // namespace mandelmarch
