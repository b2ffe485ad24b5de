#include "gpu/model.h"

#include "base/words.h"

#include <algorithm>
#include <array>
#include <utility>

namespace shadowbench::gpu {
namespace {

constexpr Words<Term, 7> terms{"term",
                               {{{Term::Arithmetic, "arithmetic"},
                                 {Term::Texture, "texture"},
                                 {Term::Output, "output"},
                                 {Term::Geometry, "geometry"},
                                 {Term::Memory, "memory"},
                                 {Term::Fixed, "fixed"},
                                 {Term::Program, "the program"}}}};

/// A target takes what its pixels take or what their bytes take, whichever is more.
double secondsOf(const Written& written, const Card& card) {
    const Rate bytes = written.blends && written.fullFloats ? Rate::BlendedBytes : Rate::OutputBytes;
    return std::max(written.pixels / card[Rate::Output], written.pixels * written.bytes / card[bytes]);
}

/// Work that is shared by all SIMDs, but by no more than there are waves.
double secondsOf(const Shading& shading, const Card& card) {
    const bool narrow = card.lanes == 32;
    return std::max(shading.count / 64 * (narrow ? shading.cycles32 : shading.cycles) / card[Rate::Arithmetic],
                    (narrow ? shading.longest32 : shading.longest) / card[Rate::Clock]);
}

double sumOf(std::span<const PassWork> passes, const Card& card) {
    double sum = 0;
    for (const PassWork& pass : passes) sum += termsOf(pass, card).seconds();
    return sum;
}

} // namespace

std::string_view name(Term term) { return terms.of(term); }

double Terms::seconds() const { return std::max({arithmetic, texture, output, geometry, memory}) + fixed; }

Term Terms::limit() const {
    if (waits) return Term::Program;
    const std::array<std::pair<double, Term>, 6> all{{{arithmetic, Term::Arithmetic},
                                                      {texture, Term::Texture},
                                                      {output, Term::Output},
                                                      {geometry, Term::Geometry},
                                                      {memory, Term::Memory},
                                                      {fixed, Term::Fixed}}};
    return std::ranges::max_element(all, {}, &std::pair<double, Term>::first)->second;
}

Terms termsOf(const PassWork& work, const Card& card) {
    Terms terms;
    double bytes = work.bytes;
    for (const Shading& shading : work.shading) terms.arithmetic += secondsOf(shading, card);
    terms.texture = work.reads / card[Rate::Texture];
    for (const Written& written : work.output) {
        terms.output += secondsOf(written, card);
        bytes += written.pixels * written.bytes * (written.blends ? 2 : 1); // read first
    }
    terms.output += work.depthPixels / card[Rate::Depth] + work.testedPixels / card[Rate::Tested];
    terms.geometry = work.triangles / card[Rate::Geometry];
    terms.memory = bytes / card[Rate::Memory];
    terms.fixed = work.draws / card[Rate::Draws] + work.passes / card[Rate::Passes] +
                  work.dependents / card[Rate::Dependents] + work.readBacks / card[Rate::ReadBacks];
    terms.waits = work.readBacks > 0;
    return terms;
}

FrameTime frameTime(std::span<const PassWork> passes, const Card& card) {
    FrameTime time;
    time.seconds = time.least = time.most = sumOf(passes, card);
    for (std::size_t rate = 0; rate < rateCount; ++rate) {
        Card other = card;
        other.rates.at(rate) = 2 * card.rates.at(rate);
        time.least = std::min(time.least, sumOf(passes, other));
        other.rates.at(rate) = card.rates.at(rate) / 2;
        time.most = std::max(time.most, sumOf(passes, other));
    }
    return time;
}

} // namespace shadowbench::gpu
