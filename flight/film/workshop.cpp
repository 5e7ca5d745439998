#include "flight/film/workshop.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/base/error.h"
#include "core/base/output_file.h"

namespace mandelmarch {
namespace {

namespace fs = std::filesystem;

constexpr const char* part_prefix = ".part-";

std::uint64_t fnv1a(const std::string& text, std::uint64_t hash)
{
    for (const char c : text) {
        hash ^= static_cast<unsigned char>(c);
        hash *= 0x100000001b3;
    }
    return hash;
}

}  // namespace

std::string digest(const std::string& text)
{
    return fmt::format("{:016x}{:016x}", fnv1a(text, 0xcbf29ce484222325), fnv1a(text, 0x84222325cbf29ce4));
}

Workshop::Workshop(const std::string& film, const std::string& description, std::size_t frames)
    : film_(film),
      folder_(fmt::format("{}.parts/{}", film, digest(description))),
      description_(description),
      digest_(digest(description)),
      frames_(frames)
{
}

Workshop::~Workshop()
{
    if (lock_ >= 0) ::close(lock_);
}

std::size_t Workshop::segments() const { return (frames_ + segment_frames - 1) / segment_frames; }

std::size_t Workshop::last(std::size_t segment) const { return std::min(frames_, (segment + 1) * segment_frames); }

void Workshop::open(bool shared)
{
    std::error_code error;
    fs::create_directories(folder_, error);
    if (error) throw Error(fmt::format("{}: cannot make the folder: {}", folder_, error.message()));
    lock_ = ::open((folder_ + "/lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (lock_ < 0) throw Error(fmt::format("{}/lock: {}", folder_, std::strerror(errno)));
    if (flock(lock_, (shared ? LOCK_SH : LOCK_EX) | LOCK_NB) != 0) {
        throw Error(fmt::format("{}: another run makes this film at the moment", film_));
    }
    if (!shared) {
        for (const auto& entry : fs::directory_iterator(folder_)) {
            const std::string name = entry.path().filename().string();
            if (name.starts_with(part_prefix) || name.starts_with(".mandelmarch-")) fs::remove(entry.path(), error);
        }
    }
    if (fs::exists(folder_ + "/manifest.json")) return;
    OutputFile manifest(folder_ + "/manifest.json");
    manifest.write(description_.data(), description_.size());
    manifest.commit();
}

std::string Workshop::segment_file(std::size_t segment) const { return fmt::format("segment-{:06}.mp4", segment); }

std::string Workshop::part_file(std::size_t segment) const
{
    char host[65] = "host";
    gethostname(host, sizeof host - 1);
    return fmt::format("{}{:06}-{}-{}.mp4", part_prefix, segment, host, getpid());
}

bool Workshop::finished(std::size_t segment) const
{
    std::error_code ignored;
    return fs::exists(folder_ + "/" + segment_file(segment), ignored);
}

void Workshop::finish(const std::string& part, const std::string& file) const
{
    const std::string path = folder_ + "/" + part;
    // On the disk before it has its name: after a power cut a finished name means finished data.
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    const bool synced = descriptor >= 0 && fsync(descriptor) == 0;
    const int why = errno;
    if (descriptor >= 0) ::close(descriptor);
    if (!synced) throw Error(fmt::format("{}: cannot be written: {}", path, std::strerror(why)));
    std::error_code error;
    fs::rename(path, folder_ + "/" + file, error);
    if (error) throw Error(fmt::format("{}: cannot be renamed: {}", path, error.message()));
}

void Workshop::discard(const std::string& part) const
{
    std::error_code ignored;
    fs::remove(folder_ + "/" + part, ignored);
}

std::string Workshop::note() const { return film_ + ".made"; }

void Workshop::close_with(const std::string& film)
{
    const std::string text = fmt::format("{} {}\n", digest_, fs::file_size(film));
    OutputFile file(note());
    file.write(text.data(), text.size());
    file.commit();
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
    fs::remove(film_ + ".parts", ignored);  // stays where another film's parts are in it
}

bool Workshop::complete(const std::string& film) const
{
    std::ifstream stream(note());
    std::string of;
    std::uintmax_t size = 0;
    std::error_code error;
    return (stream >> of >> size) && of == digest_ && fs::file_size(film, error) == size && !error;
}

}  // namespace mandelmarch
