// Renderers that are not ours, chosen and scored as techniques are: what cells ask of them (harness/foreign).
#pragma once

#include "base/progress.h"
#include "harness/cells/cell.h"
#include "harness/cells/truths.h"
#include "techniques/contract/entry.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace shadowbench {

class ExternalTechniques {
public:
    virtual ~ExternalTechniques() = default;

    /// All of them, by names that begin with `externalPrefix`; valid as long as this object. Their entries make no
    /// technique.
    [[nodiscard]] virtual const std::vector<techniques::Variant>& variants() const = 0;

    /// Why a variant has no cell on the scene; nothing if it has.
    [[nodiscard]] virtual std::optional<std::string> notApplicable(const Scene& scene,
                                                                   const techniques::Variant& variant) const = 0;

    /// The truths that its scores need, frame by frame.
    [[nodiscard]] virtual std::vector<std::pair<Truth, int>> truthsOf(const Scene& scene,
                                                                      const techniques::Variant& variant) const = 0;

    /// Hash of all that its scores depend on and that is known without calling it.
    [[nodiscard]] virtual std::string cellId(const Truths& truths, const Scene& scene,
                                             const techniques::Variant& variant) const = 0;

    /// What is known of a variant before it is called.
    [[nodiscard]] virtual ExternalInfo describe(const techniques::Variant& variant) const = 0;

    /// Renders and scores a variant that applies: fills in its blank record. Throws Inconclusive when the renderer fails or
    /// its images cannot be scored, and what truths throw.
    virtual void score(SceneFrames& frames, const techniques::Variant& variant, Record& record, CellImages& images,
                       const Progress& progress) const = 0;
};

/// Whether somebody else draws the variant.
inline bool isExternal(const techniques::Variant& variant) { return !variant.entry->make && !variant.entry->makeLod; }

} // namespace shadowbench
