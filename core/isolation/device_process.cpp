// SPDX-License-Identifier: Apache-2.0
#include "core/isolation/device_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <mutex>
#include <new>
#include <set>

#include "core/os/stopwatch.h"
#include "core/text/console.h"
#include "core/text/environment.h"
#include "core/text/error.h"
#include "core/text/text.h"

namespace mandelmarch::isolation {
namespace {

// Longest time to wait for a message. It exceeds device_timeout(), because the device process applies that limit
// itself, and sends a more precise message when the limit is exceeded.
std::chrono::duration<double> limit() { return std::chrono::duration<double>(1.1 * device_timeout() + 1); }

constexpr std::size_t most_output = 1 << 16;  // max bytes of the process's output that are kept until they are printed
constexpr std::size_t last_words = 300;       // max bytes of this output that an error message quotes

constexpr VariableName log_variable = "MANDELMARCH_DRIVER_LOG";

// Opens the file that the environment variable names. Returns an empty Descriptor if it is not set.
Descriptor opened_log()
{
    const std::string path = environment_variable(log_variable);
    if (path.empty()) return {};
    // A pipe that nobody reads is an error, and does not make the program wait.
    Descriptor log(open(path.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_NONBLOCK | O_CLOEXEC, 0666));
    if (log.number() < 0) throw InputError(fmt::format("{}: {}: {}", log_variable.text, path, std::strerror(errno)));
    fcntl(log.number(), F_SETFL, O_APPEND);
    return log;
}

}  // namespace

DeviceProcess::DeviceProcess(std::shared_ptr<const ForkServer> fork_server, std::string name)
    : fork_server_(std::move(fork_server)),
      name_(std::move(name)),
      log_(opened_log()),
      child_(fork_server_->start()),
      life_(static_cast<int>(syscall(SYS_pidfd_open, child_.id, 0)))
{
}

DeviceProcess::~DeviceProcess()
{
    try {
        if (!ended_) end();
    } catch (const std::exception& error) {
        say("{}: {}\n", name_, error.what());
    }
}

std::optional<Packet> DeviceProcess::receive(const char* doing)
{
    const auto deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(limit());
    for (;;) {
        std::array<pollfd, 3> from{pollfd{child_.channel.number(), POLLIN, 0},
                                   pollfd{child_.output.number(), POLLIN, 0}, pollfd{life_.number(), POLLIN, 0}};
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
        if (left <= 0) break;
        poll(from.data(), from.size(), static_cast<int>(std::min<long long>(left, 60'000)));
        // Reads the output at once, because the process would block if the pipe were full. Output is not a response.
        if (from[1].revents != 0) read_output();
        if (from[0].revents != 0) return child_.channel.receive();
        // The channel remains open if a process that the driver has started holds it.
        if (from[2].revents != 0) return std::nullopt;
    }
    end(true);
    print_output();
    throw DeviceHung(
        fmt::format("{}: no answer within {} s while {} (MANDELMARCH_DEVICE_TIMEOUT)", name_, device_timeout(), doing));
}

void DeviceProcess::read_output()
{
    std::array<char, 4096> buffer{};
    for (;;) {
        const ssize_t size = read(child_.output.number(), buffer.data(), buffer.size());
        if (size == 0) child_.output = Descriptor();  // the process has closed its end
        if (size <= 0) return;
        log({buffer.data(), static_cast<std::size_t>(size)});
        output_.append(buffer.data(), static_cast<std::size_t>(size));
        if (output_.size() > most_output) output_.erase(0, output_.size() - most_output);
    }
}

void DeviceProcess::log(std::string_view text)
{
    while (log_.number() >= 0 && !text.empty()) {
        const ssize_t size = write(log_.number(), text.data(), text.size());
        if (size < 0) {
            say("{}: {}\n", log_variable.text, std::strerror(errno));
            log_ = Descriptor();
            return;
        }
        text.remove_prefix(static_cast<std::size_t>(size));
    }
}

void DeviceProcess::print_output()
{
    // Every process of a driver prints the same lines, so a line is printed for the user only once.
    static std::set<std::string, std::less<>> repeated;
    static std::mutex one;
    const std::scoped_lock lock(one);
    for (std::size_t begin = 0; begin < output_.size();) {
        const std::size_t end = std::min(output_.find('\n', begin), output_.size() - 1) + 1;
        const auto [line, is_new] = repeated.insert(output_.substr(begin, end - begin));
        if (is_new) say(*line);
        begin = end;
    }
    output_.clear();
}

std::string DeviceProcess::end(bool now)
{
    child_.channel = Channel(Descriptor());
    std::string how = fork_server_->end(child_.id, now);
    read_output();
    ended_ = true;
    return how;
}

void DeviceProcess::send(const Serializer& message)
{
    const std::scoped_lock lock(mutex_);
    if (!ended_) child_.channel.send(message.bytes());
}

Deserializer DeviceProcess::request(const Serializer& message, const char* doing, int descriptor,
                                    const Progress& progress)
{
    const std::scoped_lock lock(mutex_);
    const auto ended = [&]() -> Error {
        const std::string how = end();
        while (!output_.empty() && output_.back() == '\n') output_.pop_back();
        std::string words = output_.substr(output_.rfind('\n') + 1);
        output_.clear();
        if (!words.empty()) words = fmt::format("; its last words: {}", printable(words, last_words));
        return Error(fmt::format("{}: the driver ended the device's process while {}: {}{}", name_, doing, how, words));
    };
    bool cancelled = false;
    if (ended_ || !child_.channel.send(message.bytes(), descriptor)) throw ended();
    for (;;) {
        auto packet = receive(doing);
        if (!packet) throw ended();
        // A message that is too short is nonsense.
        packet->bytes.resize(std::max(packet->bytes.size(), sizeof(Response)), '\xff');
        Deserializer response(std::move(packet->bytes));
        const auto kind = response.take<Response>();
        if (kind == Response::progress) {
            if (!cancelled) cancelled = !continues(progress, response.take<double>());
            continue;
        }
        read_output();
        print_output();
        if (cancelled && (kind == Response::done || kind == Response::cancelled)) throw Cancelled();
        if (kind == Response::done) return response;
        fail(kind, response, doing);
    }
}

bool DeviceProcess::continues(const Progress& progress, double share)
{
    try {
        if (progress) progress(share);
        return true;
    } catch (const Cancelled&) {
        child_.channel.send(Serializer(Request::cancel).bytes());
        return false;
    }
}

void DeviceProcess::fail(Response kind, Deserializer& response, const char* doing)
{
    const auto why = [&response] { return response.take<std::string>(); };
    switch (kind) {
        case Response::no_memory: throw std::bad_alloc();
        case Response::input_error: throw InputError(why());
        case Response::unavailable: throw Unavailable(why());
        case Response::hung: end(true); throw DeviceHung(why());
        case Response::error: throw Error(why());
        default:
            end(true);
            throw Error(fmt::format("{}: the device's process answers nonsense while {}", name_, doing));
    }
}

}  // namespace mandelmarch::isolation
