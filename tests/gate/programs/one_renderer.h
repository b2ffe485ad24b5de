// A renderer that is not ours, as an option of a gate on stand-ins names it.
#pragma once

#include "harness/cells/external_techniques.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace shadowbench::gate {

/// Renderers of which there is one, "external:copy"; nobody calls it here but the head, by its file.
class OneRenderer : public ExternalTechniques {
public:
    OneRenderer() {
        entry_.id = "external:copy";
        variants_ = {techniques::Variant{&entry_, techniques::Parameters({}), entry_.id}};
    }
    [[nodiscard]] const std::vector<techniques::Variant>& variants() const override { return variants_; }
    [[nodiscard]] std::optional<std::string> notApplicable(const Scene& /*scene*/,
                                                           const techniques::Variant& /*variant*/) const override {
        return {};
    }
    [[nodiscard]] std::vector<std::pair<Truth, int>> truthsOf(const Scene& /*scene*/,
                                                              const techniques::Variant& /*variant*/) const override {
        return {};
    }
    [[nodiscard]] std::string cellId(const Truths& /*truths*/, const Scene& /*scene*/,
                                     const techniques::Variant& /*variant*/) const override {
        return "";
    }
    [[nodiscard]] ExternalInfo describe(const techniques::Variant& /*variant*/) const override { return {}; }
    void score(SceneFrames& /*frames*/, const techniques::Variant& /*variant*/, Record& /*record*/, CellImages& /*images*/,
               const Progress& /*progress*/) const override {}

private:
    techniques::Entry entry_;
    std::vector<techniques::Variant> variants_;
};

} // namespace shadowbench::gate
