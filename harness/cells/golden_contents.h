// What the golden references hash to, by key: a truth that has the key of one and other pixels is wrong.
#pragma once

#include <map>
#include <string>

namespace shadowbench {

struct GoldenLock; // harness/cells/golden_lock.h

struct GoldenContent {
    std::string scene, truth; // id; name of the Truth
    int frame = 0;
    std::string content; // groundtruth::contentOf
};

/// By key (groundtruth/contract/reference_key.h), which names camera, light, meshes, size, oracle and versions.
using GoldenContents = std::map<std::string, GoldenContent>;

GoldenContents contentsOf(const GoldenLock& lock);

/// Those of results/reference/lock.json as it was when the program was built.
const GoldenContents& committedContents();

/// Throws Inconclusive, naming scene and remedy, if `golden` has `key` with another content.
void requireGolden(const GoldenContents& golden, const std::string& key, const std::string& content);

} // namespace shadowbench
