// SPDX-License-Identifier: Apache-2.0
// The folder in which a film's segments gather: what is finished there is not done again.
#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "flight/film/note.h"

namespace mandelmarch {

inline constexpr std::size_t segment_frames = 60;

class Workshop {
public:
    // The folder PARTS/DIGEST, where the digest is of the description: all that decides what the film looks like.
    // `film` is what messages call it, `frames` are its frames. Nothing is written yet.
    Workshop(const std::string& film, const std::string& parts, const std::string& description, std::size_t frames);
    ~Workshop();
    Workshop(const Workshop&) = delete;
    Workshop& operator=(const Workshop&) = delete;

    const std::string& folder() const { return folder_; }
    // The description's digest, which notes record.
    const std::string& made_of() const { return digest_; }
    std::size_t frames() const { return frames_; }
    std::size_t segments() const;
    // Frames [first, last) of a segment.
    std::size_t first(std::size_t segment) const { return segment * segment_frames; }
    std::size_t last(std::size_t segment) const;

    // Makes the folder, writes the description into it (manifest.json) and takes away what killed runs left half done.
    // Throws Error where that fails, or where another run makes a film of this name: runs that share the work
    // (`shared`) stand each other, no others.
    void open(bool shared);

    std::string segment_file(std::size_t segment) const;  // its name in the folder
    std::string part_file(std::size_t segment) const;     // the same while it is written by this process
    Standing standing(const std::string& file) const;
    // A whole part becomes the finished file, with its note. Throws Error.
    void finish(const std::string& part, const std::string& file) const;

    // Unfinished films of the same name that stand beside this one, by folder.
    struct Other {
        std::string description;
        std::size_t segments = 0;
    };
    std::map<std::string, Other> others() const;

    // The film stands: its parts go.
    void close();

private:
    std::string piece(const std::string& file) const;
    void lock(bool shared);

    std::string film_, parts_, description_, digest_, folder_;
    std::size_t frames_;
    int lock_ = -1;
};

}  // namespace mandelmarch
