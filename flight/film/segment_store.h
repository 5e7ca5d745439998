// SPDX-License-Identifier: Apache-2.0
// The segment store: the folder with a film's finished segments. It lets a later run continue an interrupted one.
#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "core/os/descriptor.h"
#include "flight/film/stamp.h"

namespace mandelmarch {

inline constexpr std::size_t segment_frames = 60;

// Returns the path FILM.parts, where FILM is the file that `film` names or links to. If `film` is a pipe or device,
// returns a path in TMPDIR (or /tmp) that contains the user's number and `made_of`, the digest of the film's
// description. Throws InputError if TMPDIR is not a folder.
std::string parts_folder(const std::string& film, const std::string& made_of);

// Creates a folder that only this user can access. An existing folder is used if it belongs to this user and other
// users cannot write to it; otherwise throws Error.
void make_private_folder(const std::string& folder);

class SegmentStore {
public:
    // Uses the folder PARTS/DIGEST, where DIGEST is the digest of the description. Does not create this folder. `film`:
    // the film's name in messages. `frames`: number of frames of the film.
    SegmentStore(const std::string& film, const std::string& parts, const std::string& description, std::size_t frames);

    const std::string& folder() const { return folder_; }
    // Returns the digest of the description, which the stamps of the segments contain.
    const std::string& made_of() const { return digest_; }
    std::size_t frames() const { return frames_; }
    std::size_t segments() const;
    // Returns the first frame of a segment. last() returns the frame after the segment's last one.
    std::size_t first(std::size_t segment) const { return segment * segment_frames; }
    std::size_t last(std::size_t segment) const;

    // Creates the folder, locks PARTS, and writes the description to manifest.json in the folder. Several runs can open
    // the store at the same time if all of them set `shared`. A run that does not set `shared` removes the unfinished
    // files of killed runs. Throws Error if another run holds the lock, or if the folder cannot be created.
    void open(bool shared);

    std::string segment_file(std::size_t segment) const;  // the finished segment's name in the folder
    std::string part_file(std::size_t segment) const;     // the segment's name while this process writes it
    FileState state_of(const std::string& file) const;
    // Renames the complete file `part` to `file` and writes its stamp. Throws Error if that fails.
    void finish(const std::string& part, const std::string& file) const;

    // An unfinished film of the same name with another description.
    struct Other {
        std::string description;
        std::size_t segments = 0;
    };
    // Returns the unfinished films of the same name with other descriptions. The keys are their folders.
    std::map<std::string, Other> others() const;

    // Removes the segments. Called after the film is complete.
    void close();

private:
    std::string piece(const std::string& file) const;
    void lock(bool shared);

    std::string film_, parts_, description_, digest_, folder_;
    std::size_t frames_;
    Descriptor lock_;
};

}  // namespace mandelmarch
