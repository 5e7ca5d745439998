// SPDX-License-Identifier: Apache-2.0
// The segment store: the folder of a film's segments, by which an interrupted run is continued.
#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "core/base/descriptor.h"
#include "flight/film/stamp.h"

namespace mandelmarch {

inline constexpr std::size_t segment_frames = 60;

class SegmentStore {
public:
    // Uses the folder PARTS/DIGEST, where DIGEST is that of the description. `film`: its name in messages. `frames`: in
    // the film. Writes nothing.
    SegmentStore(const std::string& film, const std::string& parts, const std::string& description, std::size_t frames);

    const std::string& folder() const { return folder_; }
    // The description's digest, which stamps contain.
    const std::string& made_of() const { return digest_; }
    std::size_t frames() const { return frames_; }
    std::size_t segments() const;
    // The frames [first, last) of a segment.
    std::size_t first(std::size_t segment) const { return segment * segment_frames; }
    std::size_t last(std::size_t segment) const;

    // Creates and locks the folder, writes the description into it (manifest.json) and, unless `shared`, removes
    // unfinished files of killed runs. Throws Error if that fails, or if another run makes a film of this name and not
    // both are `shared`.
    void open(bool shared);

    std::string segment_file(std::size_t segment) const;  // its name in the folder
    std::string part_file(std::size_t segment) const;     // its name while this process writes it
    FileState state_of(const std::string& file) const;
    // Renames a complete part to the finished file and writes its stamp. Throws Error.
    void finish(const std::string& part, const std::string& file) const;

    // Returns unfinished films of the same name with other descriptions, by folder.
    struct Other {
        std::string description;
        std::size_t segments = 0;
    };
    std::map<std::string, Other> others() const;

    // Removes the segments, after the film is complete.
    void close();

private:
    std::string piece(const std::string& file) const;
    void lock(bool shared);

    std::string film_, parts_, description_, digest_, folder_;
    std::size_t frames_;
    Descriptor lock_;
};

}  // namespace mandelmarch
