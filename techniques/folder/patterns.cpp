#include "techniques/folder/patterns.h"

#include "techniques/shared/sampling/sampling.h"

#include <algorithm>
#include <cmath>

namespace shadowbench::techniques {
namespace {

/// As many points, or the square number below.
std::vector<glm::vec2> pointsOf(PatternKind kind, int count, const Light& light) {
    if (kind == PatternKind::Grid) return gridTaps(static_cast<int>(std::sqrt(count)));
    const bool disk = kind == PatternKind::PoissonDisk || light.kind == LightKind::Disk;
    return keptPoissonTaps(count, disk ? Region::Disk : Region::Square);
}

} // namespace

FolderPatterns::FolderPatterns(const TechniqueFolder& folder, const Parameters& values) {
    std::uint32_t firstSet = 0; // no two tables share a set
    for (const FolderPattern& pattern : folder.patterns) {
        kinds_.emplace(pattern.name, pattern.kind);
        sigmas_.emplace(pattern.name, valueOf(pattern.sigma, values));
        if (pattern.kind != PatternKind::Jitter) continue;
        const int rings = std::max(static_cast<int>(valueOf(pattern.taps, values)) / pattern.sectors, 1);
        tables_.emplace(pattern.name, JitterTable({pattern.sectors, rings}, firstSet));
        firstSet += jitterBlock * jitterBlock;
    }
}

void FolderPatterns::set(gl::Program& program, const std::string& name, const Light& light) const {
    const auto known = kinds_.find(name);
    if (known == kinds_.end()) return;
    if (known->second == PatternKind::Jitter)
        program.set(name, tables_.at(name).texture());
    else if (known->second == PatternKind::Gaussian)
        program.set(name, gaussianPairs(program.elements(name), sigmas_.at(name)));
    else
        program.set(name, pointsOf(known->second, program.elements(name), light));
}

std::string typeOf(PatternKind kind) { return kind == PatternKind::Jitter ? "sampler2D" : "vec2[]"; }

} // namespace shadowbench::techniques
