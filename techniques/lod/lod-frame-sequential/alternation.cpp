#include "techniques/lod/lod-frame-sequential/alternation.h"

#include "techniques/lod/transition.h"

namespace shadowbench::techniques {

std::vector<LevelDraw> Alternation::next(std::span<const LodInstance> instances) {
    std::vector<LevelDraw> draws;
    draws.reserve(instances.size());
    std::unordered_map<std::uint32_t, Shown> now;
    for (const LodInstance& instance : instances) {
        const auto& [level, progress] = instance.selection;
        if (!instance.selection.inTransition()) {
            draws.push_back({&instance, level});
            continue;
        }
        const auto before = shown_.find(instance.id);
        const bool goesOn = before != shown_.end() && before->second.pair == level;
        const bool coarser = goesOn ? !before->second.coarser : showsCoarser(progress);
        const TransitionVisibility visibility = transitionVisibility(progress);
        draws.push_back({&instance, coarser ? level + 1 : level,
                         static_cast<float>(coarser ? visibility.coarser : visibility.finer), instance.id});
        now[instance.id] = {level, coarser};
    }
    shown_ = std::move(now);
    return draws;
}

} // namespace shadowbench::techniques
