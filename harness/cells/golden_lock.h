// The lock file of the golden references: which references there are, what their images hash to and how they were made.
#pragma once

#include "groundtruth/store/golden.h"
#include "harness/cells/truths.h"

#include <filesystem>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace shadowbench {

/// Names one reference of a run.
struct GoldenName {
    std::string scene; // id
    Truth truth = Truth::Hard;
    int frame = 0;
    friend bool operator==(const GoldenName&, const GoldenName&) = default;
    friend auto operator<=>(const GoldenName& a, const GoldenName& b) {
        return std::tie(a.scene, a.truth, a.frame) <=> std::tie(b.scene, b.truth, b.frame);
    }
};

struct GoldenEntry {
    GoldenName name;
    glm::ivec2 size{0, 0};
    groundtruth::Provenance provenance; // without seconds: the lock says the same wherever it is made
    groundtruth::ContentHashes hashes;
    std::string file; // of the images, beside the lock; "" where the hashes are all that is kept
};

struct GoldenLock {
    Profile profile = Profile::Gate;
    std::vector<GoldenEntry> entries; // by name

    [[nodiscard]] const GoldenEntry* find(const GoldenName& name) const;
};

/// <folder>/lock.json.
std::filesystem::path lockFile(const std::filesystem::path& folder);

/// Throws BadInput, naming the file, when it cannot be read or is no lock file.
GoldenLock readLock(const std::filesystem::path& folder);

/// The same of a lock file's text; `file` is what errors name.
GoldenLock parseLock(const std::string& text, const std::filesystem::path& file);

/// Entries are written by name. Throws InternalError when the file cannot be written.
void writeLock(const GoldenLock& lock, const std::filesystem::path& folder);

} // namespace shadowbench
