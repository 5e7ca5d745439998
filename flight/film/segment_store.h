// SPDX-License-Identifier: Apache-2.0
// Finished files, and the folder with a film's finished segments, which lets a later run continue an interrupted one.
//
// The stamp FILE.made contains the digest of the file's inputs and the digest of its bytes. With them, a finished file
// can be distinguished from one that is damaged or was made from other inputs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

#include "core/os/descriptor.h"
#include "core/text/hash.h"

namespace mandelmarch {

// A hash of 32 hexadecimal digits. It consists of two 64-bit FNV-1a hashes with different initial values.
class Digest {
public:
    void add(const void* data, std::size_t size);
    std::string text() const;

private:
    std::uint64_t first_ = fnv1a_start, second_ = 0x84222325cbf29ce4;
};

std::string digest(const std::string& text);
// Throws Error if the file cannot be read.
std::string digest_of_file(const std::string& file);

// Returns the path of a file's stamp.
std::string stamp_path(const std::string& file);

enum class FileState { missing, damaged, whole };

// Returns `missing` if the file does not exist, `whole` if its stamp matches its bytes and `made_of`, else `damaged`.
// `made_of`: one line that identifies the file's inputs, such as the digest of their description.
FileState state_of(const std::string& file, const std::string& made_of);

// Writes the stamp of `file`; the file itself need not exist yet. `bytes`: the digest of the file's content. Throws
// Error if the stamp cannot be written.
void write_note(const std::string& file, const std::string& made_of, const std::string& bytes);

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
