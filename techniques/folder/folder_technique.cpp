#include "techniques/folder/folder_technique.h"

#include "base/error.h"
#include "techniques/folder/inputs.h"
#include "techniques/folder/pass_program.h"
#include "techniques/gl/api.h"
#include "techniques/shared/light_views/focused_view.h"
#include "techniques/shared/maps/depth_map.h"
#include "techniques/shared/sampling/sampling.h"

#include <algorithm>
#include <fmt/format.h>
#include <functional>
#include <unordered_map>

namespace shadowbench::techniques {
namespace {

double valueOf(const Amount& amount, const Parameters& values) {
    if (const double* number = std::get_if<double>(&amount)) return *number;
    return values.real(std::get<std::string>(amount));
}

/// As long as it lives; everything else draws without.
class Blending {
public:
    explicit Blending(std::optional<Blend> blend) {
        if (!blend) return;
        glEnable(GL_BLEND);
        glBlendFunc(blend == Blend::Multiply ? GL_DST_COLOR : GL_ONE, blend == Blend::Multiply ? GL_ZERO : GL_ONE);
        glBlendEquation(blend == Blend::Min ? GL_MIN : blend == Blend::Max ? GL_MAX : GL_FUNC_ADD);
    }
    ~Blending() {
        glBlendEquation(GL_FUNC_ADD);
        glDisable(GL_BLEND);
    }
    Blending(const Blending&) = delete;
    Blending& operator=(const Blending&) = delete;
};

class Culling {
public:
    explicit Culling(Cull cull) {
        if (cull == Cull::None) return;
        glEnable(GL_CULL_FACE);
        glCullFace(cull == Cull::Front ? GL_FRONT : GL_BACK);
    }
    ~Culling() {
        glCullFace(GL_BACK);
        glDisable(GL_CULL_FACE);
    }
    Culling(const Culling&) = delete;
    Culling& operator=(const Culling&) = delete;
};

class FolderTechnique final : public Technique {
public:
    FolderTechnique(std::shared_ptr<const TechniqueFolder> folder, const Parameters& values)
        : folder_(std::move(folder)), values_(values) {
        for (const FolderPass& pass : folder_->passes) programs_.push_back(programOf(*folder_, pass, values_));
        if (folder_->mapParameters == MapParameters::None) return;
        bias_ = biasFrom(values_);
        followsPlane_ = followsPlane(values_);
    }

    void reset() override {
        historyFrames_ = 0;
        targets_.clear();
    }

    void render(const Frame& frame, const gl::Texture& visibility) override {
        view_ = fit(frame);
        if (imageSize_ != frame.size) reset();
        imageSize_ = frame.size;
        if (targets_.empty()) makeTargets();
        for (std::size_t first = 0; first < folder_->passes.size();) {
            const std::size_t end = endOfGroup(first);
            const int repetitions = static_cast<int>(valueOf(folder_->passes[first].repeat, values_));
            for (repetition_ = 0; repetition_ < repetitions; ++repetition_)
                for (std::size_t i = first; i < end; ++i) {
                    const auto pass = frame.pass(folder_->passes[i].name);
                    draw(folder_->passes[i], programs_[i], frame, visibility);
                }
            first = end;
        }
        for (auto& [name, target] : targets_)
            if (target.before) std::swap(target.now, *target.before);
        ++historyFrames_;
    }

    [[nodiscard]] std::optional<glm::dvec2> mapPoint(const glm::dvec3& world) const override {
        const glm::ivec2 size = mapSize();
        return size.x > 0 ? texelAt(view_, world, size) : std::nullopt;
    }

private:
    struct Target {
        gl::Texture now;
        std::optional<gl::Texture> before = {}; // of a target with a history
    };

    /// Of the first target that casters are drawn into; 0 where there is none.
    [[nodiscard]] glm::ivec2 mapSize() const {
        const auto casters = std::ranges::find(folder_->passes, true, &FolderPass::casters);
        if (casters == folder_->passes.end() || targets_.empty()) return glm::ivec2(0);
        return targets_.at(casters->to.front()).now.size();
    }

    [[nodiscard]] Bias biasOf(const FolderPass& pass) const {
        if (pass.biased) return bias_;
        return {.factor = static_cast<float>(valueOf(pass.slopeOffset, values_)),
                .units = static_cast<float>(valueOf(pass.unitOffset, values_))};
    }

    [[nodiscard]] std::size_t endOfGroup(std::size_t first) const {
        const std::string& group = folder_->passes[first].group;
        std::size_t end = first + 1;
        while (!group.empty() && end < folder_->passes.size() && folder_->passes[end].group == group) ++end;
        return end;
    }

    [[nodiscard]] LightView fit(const Frame& frame) const {
        const bool soft = folder_->entry.answer == Answer::Soft;
        const Light& light = soft ? frame.snapshot.light : frame.hardLight;
        switch (folder_->view) {
        case FolderView::Scene:
            return fitToScene(light, frame.snapshot);
        case FolderView::Focused:
            return fitFocused(frame.hardLight, frame.snapshot, frame.snapshot.camera, frame.aspect());
        case FolderView::Sample:
            const glm::dvec2 at(haltonOf(frame.index, frame.seed, 2), haltonOf(frame.index, frame.seed, 3));
            return fitFromSample(light, light.sample(at), boundingCorners(frame.snapshot));
        }
        throw InternalError("unknown view of a technique folder");
    }

    void makeTargets() {
        for (const FolderTarget& target : folder_->targets) {
            const int side = static_cast<int>(valueOf(target.side, values_));
            if (!target.ofImage && (side < 1 || side > mostTexelsOfSide))
                throw BadInput(fmt::format("{}: target {} would have {} texels a side; 1 to {} are allowed",
                                           folder_->path.string(), target.name, side, mostTexelsOfSide));
            const glm::ivec2 size = target.ofImage ? imageSize_ : glm::ivec2(side);
            Target made{textureOf(target, size)};
            if (target.history) {
                made.before = textureOf(target, size);
                clear(*made.before);
            }
            targets_.emplace(target.name, std::move(made));
        }
    }

    static gl::Texture textureOf(const FolderTarget& target, glm::ivec2 size) {
        const bool depths = target.format == gl::Format::Depth32F;
        gl::Texture texture(target.format, size, target.linear ? gl::Filter::Linear : gl::Filter::Nearest,
                            depths ? gl::Wrap::BorderFar : gl::Wrap::ClampToEdge,
                            target.mipmaps ? gl::Levels::All : gl::Levels::One);
        if (target.compare) texture.compareDepth();
        return texture;
    }

    static void clear(const gl::Texture& texture) {
        const gl::RenderTarget target({&texture});
        if (texture.format() == gl::Format::Depth32F)
            target.clearDepth(1);
        else
            target.clearColour(0, glm::vec4(0));
    }

    void draw(const FolderPass& pass, gl::Program& program, const Frame& frame, const gl::Texture& visibility) {
        std::vector<const gl::Texture*> attachments;
        for (const std::string& name : pass.to)
            attachments.push_back(name == visibilityTarget ? &visibility : &targets_.at(name).now);
        setInputs(program, frame);
        if (pass.casters)
            drawCasters(pass, program, frame, attachments);
        else
            drawScreen(pass, program, attachments);
        for (const std::string& name : pass.to)
            if (name != visibilityTarget && hasMipmaps(name)) targets_.at(name).now.makeMipmaps();
    }

    [[nodiscard]] bool hasMipmaps(const std::string& name) const {
        return std::ranges::find(folder_->targets, name, &FolderTarget::name)->mipmaps;
    }

    void setInputs(gl::Program& program, const Frame& frame) const {
        const FolderState state{frame, view_, historyFrames_, repetition_, bias_, followsPlane_, mapSize()};
        for (const auto& [name, type] : program.uniformTypes()) {
            const auto input = std::ranges::find(folderInputs(), name, &FolderInput::name);
            if (input != folderInputs().end()) input->set(program, name, state);
            if (const auto target = targets_.find(name); target != targets_.end()) program.set(name, target->second.now);
            if (name.starts_with(historyPrefix))
                if (const auto target = targets_.find(name.substr(historyPrefix.size())); target != targets_.end())
                    program.set(name, *target->second.before);
        }
    }

    static void drawScreen(const FolderPass& pass, const gl::Program& program,
                           const std::vector<const gl::Texture*>& attachments) {
        const gl::RenderTarget target{std::span<const gl::Texture* const>(attachments)};
        if (pass.clear)
            for (std::size_t i = 0; i < attachments.size(); ++i) target.clearColour(static_cast<int>(i), *pass.clear);
        target.bind();
        const Blending blending(pass.blend);
        program.drawScreen();
    }

    /// Where no depths are kept the nearest casters are found in a buffer of the program's own.
    void drawCasters(const FolderPass& pass, gl::Program& program, const Frame& frame,
                     std::vector<const gl::Texture*> attachments) {
        const auto isDepth = [](const gl::Texture* t) { return t->format() == gl::Format::Depth32F; };
        if (pass.depthTest && std::ranges::none_of(attachments, isDepth)) {
            const glm::ivec2 size = attachments.front()->size();
            if (!ownDepths_ || ownDepths_->size() != size) ownDepths_.emplace(gl::Format::Depth32F, size);
            attachments.push_back(&*ownDepths_);
        }
        std::ranges::stable_partition(attachments, std::not_fn(isDepth));
        const gl::RenderTarget target{std::span<const gl::Texture* const>(attachments)};
        const auto colours = std::ranges::count_if(attachments, std::not_fn(isDepth));
        for (int i = 0; i < colours; ++i) target.clearColour(i, *pass.clear);
        if (pass.depthTest) target.clearDepth(1);
        target.bind();
        const CasterPass casters(program, view_, biasOf(pass));
        const Blending blending(pass.blend);
        const Culling culling(pass.cull);
        if (!pass.depthTest) glDisable(GL_DEPTH_TEST); // until the next pass sets it
        frame.scene.draw();
    }

    std::shared_ptr<const TechniqueFolder> folder_;
    Parameters values_;
    std::vector<gl::Program> programs_; // a pass each
    std::unordered_map<std::string, Target> targets_;
    std::optional<gl::Texture> ownDepths_;
    Bias bias_{};
    bool followsPlane_ = true;
    LightView view_;
    glm::ivec2 imageSize_{0};
    int historyFrames_ = 0, repetition_ = 0;
};

} // namespace

Entry folderEntry(TechniqueFolder folder) {
    const auto kept = std::make_shared<const TechniqueFolder>(std::move(folder));
    Entry entry = kept->entry;
    entry.make = [kept](const Parameters& values) { return std::make_unique<FolderTechnique>(kept, values); };
    return entry;
}

} // namespace shadowbench::techniques
