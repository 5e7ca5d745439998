// The folder beside a film in which its segments gather: what is finished there is never done again.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace mandelmarch {

inline constexpr std::size_t segment_frames = 60;

// 32 hexadecimal digits that change when the text changes (two FNV-1a hashes of 64 bits).
std::string digest(const std::string& text);

class Workshop {
public:
    // The folder FILM.parts/DIGEST for all that decides what the film looks like. Nothing is written yet.
    Workshop(const std::string& film, const std::string& description, std::size_t frames);
    ~Workshop();
    Workshop(const Workshop&) = delete;
    Workshop& operator=(const Workshop&) = delete;

    const std::string& folder() const { return folder_; }
    std::size_t segments() const;
    // Frames [first, last) of a segment.
    std::size_t first(std::size_t segment) const { return segment * segment_frames; }
    std::size_t last(std::size_t segment) const;

    // Makes the folder, writes the description into it (manifest.json) and takes away what killed runs left half done.
    // Throws Error where that fails or, unless `shared`, another run is at work here.
    void open(bool shared);

    std::string segment_file(std::size_t segment) const;  // its name in the folder
    std::string part_file(std::size_t segment) const;     // the same while it is written by this process
    bool finished(std::size_t segment) const;
    // A whole part becomes the finished file. Throws Error.
    void finish(const std::string& part, const std::string& file) const;
    void discard(const std::string& part) const;

    // The film stands: its parts go, and a note of what it was made of stays. Throws Error.
    void close_with(const std::string& film);
    // True if such a note says that `film` is whole, with the size that it had then.
    bool complete(const std::string& film) const;

private:
    std::string note() const;

    std::string film_, folder_, description_, digest_;
    std::size_t frames_;
    int lock_ = -1;
};

}  // namespace mandelmarch
