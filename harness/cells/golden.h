// Golden references: recomputed, compared with what is committed, and replaced on purpose only.
#pragma once

#include "harness/cells/golden_lock.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench {

/// Which references; by default all that a run of the gate asks for.
struct GoldenOptions {
    std::filesystem::path folder = "results/reference"; // of lock.json and the images
    Profile profile = Profile::Gate;
    std::vector<std::string> scenes; // ids or files; empty: the standard scenes and those that are judged beside them
    std::vector<std::string> judged; // the latter
    std::optional<Truth> truth;
    std::optional<int> frame;
    bool quiet = false;
};

enum class GoldenStatus {
    Identical,  // the images hash to what the lock says
    Changed,    // they do not, or the committed images do not
    New,        // the lock has no such reference
    Gone,       // the lock has one that no run asks for any more
    Unverified, // a tool is missing or failed
};
std::string_view name(GoldenStatus status); // "identical", "changed", "new", "gone", "unverified"

struct GoldenResult {
    GoldenName name;
    GoldenStatus status = GoldenStatus::Identical;
    std::string what; // what changed, or why it is unverified
    std::string note; // how tools and measurements differ from those in the lock; no change of the images by itself
};

/// Computes the references anew, without looking at a cache, and compares them with the lock; ordered by name. Throws
/// BadInput when there is no lock or it is of another profile.
std::vector<GoldenResult> verifyGolden(const GoldenOptions& options);

/// Computes the references anew and makes them the golden ones; returns how they differ from those before. The images of
/// the standard scenes' last still frame are written, of all others the hashes alone. Nothing is written before all are
/// computed. Throws what computing throws.
std::vector<GoldenResult> acceptGolden(const GoldenOptions& options);

} // namespace shadowbench
