// SPDX-License-Identifier: Apache-2.0
// Tests control characters in printed text, messages and results on the console, and numbers in environment variables.
#include "core/base/text.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <functional>

#include "core/base/console.h"
#include "core/base/error.h"

namespace mandelmarch {
namespace {

TEST(Printable, IsOneLineWithoutControlCharacters)
{
    EXPECT_EQ(printable("a\nb\tc\rd"), "a\\nb\\tc\\rd");
    EXPECT_EQ(printable("\x1b[31m\x07\x7f"), "\\x1b[31m\\x07\\x7f");
    EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a\\x00b");
}

TEST(Printable, KeepsUtf8AndEscapesOtherBytes)
{
    EXPECT_EQ(printable("H\u00fclle \u2260 \U0001f600"), "H\u00fclle \u2260 \U0001f600");
    EXPECT_EQ(printable("\xff\xc3"), "\\xff\\xc3");
    EXPECT_EQ(printable("\xc2\x9b!"), "\\xc2\\x9b!") << "a control character of eight bits";
}

TEST(Printable, IsCut)
{
    EXPECT_EQ(printable("abcdef", 3), "abc...");
    EXPECT_EQ(printable("abc", 3), "abc");
    EXPECT_LT(printable(std::string(5'000'000, '\n')).size(), longest_message + 10);
}

std::string nested(std::size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); }

TEST(JsonDepth, IsLimited)
{
    EXPECT_NO_THROW(check_json_depth(nested(deepest_json), "x"));
    EXPECT_THROW(check_json_depth(nested(deepest_json + 1), "x"), InputError);
    EXPECT_THROW(check_json_depth(std::string(300'000, '{'), "x"), InputError);
}

TEST(JsonDepth, DoesNotCountSiblingsOrTexts)
{
    std::string siblings;
    for (int i = 0; i < 1000; ++i) siblings += "[{}],";
    EXPECT_NO_THROW(check_json_depth(siblings, "x"));
    EXPECT_NO_THROW(check_json_depth('"' + std::string(1000, '[') + '"', "x"));
    EXPECT_NO_THROW(check_json_depth("\"\\\"" + std::string(1000, '[') + '"', "x"));
    EXPECT_THROW(check_json_depth("\"\\\\\"" + std::string(1000, '['), "x"), InputError);
}

// Forks a process that calls prepare(), which changes the process's descriptors, and then runs `body` as a program.
// Returns the process's exit code.
int code_of(int (*body)(int, char**), const std::function<void()>& prepare)
{
    const pid_t child = fork();
    if (child == 0) {
        prepare();
        std::_Exit(run_program("test", body, 0, nullptr));
    }
    int status = 0;
    EXPECT_EQ(waitpid(child, &status, 0), child);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

void redirect(int descriptor, const char* path)
{
    const int file = open(path, O_WRONLY);
    dup2(file, descriptor);
    close(file);
}

int says(int, char**)
{
    say("a note that is {}\n", "lost");
    return exit_success;
}

int prints(int, char**)
{
    print("a result of {}\n", 7);
    return exit_success;
}

TEST(Console, NotesThatCannotBeWrittenEndNothing)
{
    EXPECT_EQ(code_of(says, [] { redirect(STDERR_FILENO, "/dev/full"); }), exit_success);
    EXPECT_EQ(code_of(says, [] { close(STDERR_FILENO); }), exit_success);
}

TEST(Console, ResultsThatCannotBeWrittenAreFailures)
{
    EXPECT_EQ(code_of(prints, [] { redirect(STDOUT_FILENO, "/dev/null"); }), exit_success);
    EXPECT_EQ(code_of(prints, [] { redirect(STDOUT_FILENO, "/dev/full"); }), exit_failure);
    EXPECT_EQ(code_of(prints, [] { close(STDOUT_FILENO); }), exit_failure);
}

TEST(Console, NoFileGetsAStandardDescriptor)
{
    const auto body = [](int, char**) { return open("/dev/null", O_RDONLY) > STDERR_FILENO ? 0 : 5; };
    const auto close_all = [] {
        for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) close(descriptor);
    };
    EXPECT_EQ(code_of(body, close_all), exit_success);
}

TEST(DeviceTimeout, IsASaneNumberOfSeconds)
{
    const auto timeout = [](const char* text) {
        setenv("MANDELMARCH_DEVICE_TIMEOUT", text, 1);
        return device_timeout();
    };
    EXPECT_EQ(timeout("0.3"), 0.3);
    EXPECT_EQ(timeout("1e6"), 1e6);
    EXPECT_EQ(timeout(""), 300);
    for (const char* text : {"1e19", "1e300", "1e999", "nan", "inf", "-1", "0", "junk", "5 s"}) {
        EXPECT_THROW(timeout(text), InputError) << text;
    }
    unsetenv("MANDELMARCH_DEVICE_TIMEOUT");
    EXPECT_EQ(device_timeout(), 300);
}

}  // namespace
}  // namespace mandelmarch
