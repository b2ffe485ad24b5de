#include "techniques/lod/lod-frame-sequential/alternation.h"

#include "techniques/lod/transition.h"

#include <bitset>

namespace shadowbench::techniques {
namespace {

/// Ids that are taken.
class Ids {
public:
    void take(std::uint32_t id) { taken_.set(id); }

    /// The lowest free one; where there is none, one that is taken.
    std::uint32_t next(std::uint32_t number) {
        std::uint32_t id = 1;
        while (id <= Alternation::ids && taken_.test(id)) ++id;
        if (id > Alternation::ids) return 1 + number % Alternation::ids;
        take(id);
        return id;
    }

private:
    std::bitset<Alternation::ids + 1> taken_;
};

} // namespace

std::vector<LevelDraw> Alternation::next(std::span<const LodInstance> instances) {
    std::vector<LevelDraw> draws;
    draws.reserve(instances.size());
    Ids taken;
    for (const auto& [number, shown] : shown_) taken.take(shown.id);
    std::unordered_map<std::uint32_t, Shown> now;
    for (const LodInstance& instance : instances) {
        const auto& [level, progress] = instance.selection;
        if (!instance.selection.inTransition()) {
            draws.push_back({&instance, level});
            continue;
        }
        const auto before = shown_.find(instance.id);
        const bool goesOn = before != shown_.end() && before->second.pair == level;
        const bool coarser = goesOn || frame_ == 0 ? (instance.id + frame_) % 2 == 0 : showsCoarser(progress);
        const std::uint32_t id = before != shown_.end() ? before->second.id : taken.next(instance.id);
        const TransitionVisibility visibility = transitionVisibility(progress);
        draws.push_back({&instance, coarser ? level + 1 : level,
                         static_cast<float>(coarser ? visibility.coarser : visibility.finer), id});
        now[instance.id] = {level, id};
    }
    shown_ = std::move(now);
    ++frame_;
    return draws;
}

} // namespace shadowbench::techniques
